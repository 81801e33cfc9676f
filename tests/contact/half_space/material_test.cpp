// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/material.hpp>

using namespace salebra;

TEST_CASE("Eqs (1), (2): composite moduli of one and of two elastic bodies", "[material]") {
  const double young = 210e9, poisson = 0.3;
  const Material one = Material::of_bodies({young, poisson});
  CHECK(one.contact_modulus == Approx(young / (1 - poisson * poisson)).epsilon(1e-14));
  CHECK(one.modulus_ratio() == Approx(2 * (1 - poisson) / (2 - poisson)).epsilon(1e-14));
  const Material two = Material::of_bodies({young, poisson}, {young, poisson});
  CHECK(two.contact_modulus == Approx(one.contact_modulus / 2).epsilon(1e-14));
  CHECK(two.tangential_modulus == Approx(one.tangential_modulus / 2).epsilon(1e-14));
  CHECK(two.cerruti_isotropic == Approx(2 * one.cerruti_isotropic).epsilon(1e-14));
}

TEST_CASE("The three ways to name one elastic body agree", "[material]") {
  const double poisson = GENERATE(-0.5, 0.0, 0.3, 0.5);
  const Material body = Material::of_bodies({1e9, poisson});
  const Material ratio = Material::of_contact_modulus(body.contact_modulus, poisson);
  const Material moduli = Material::of_moduli(body.contact_modulus, body.tangential_modulus);
  for (const Material& other : {ratio, moduli}) {
    CHECK(other.tangential_modulus == Approx(body.tangential_modulus).epsilon(1e-13));
    CHECK(other.cerruti_isotropic == Approx(body.cerruti_isotropic).epsilon(1e-12));
    CHECK(other.cerruti_directed == Approx(body.cerruti_directed).epsilon(1e-12).margin(1e-24));
  }
}

TEST_CASE("A missing tangential modulus is an error where it is needed, never a default",
          "[material]") {
  const Material normal_only = Material::of_contact_modulus(1e9);
  CHECK_THROWS_WITH(normal_only.modulus_ratio(), Catch::Contains("tangential_modulus"));
  CHECK_THROWS_AS(Material::of_bodies({1e9, 0.6}), InvalidInput);
  CHECK_THROWS_AS(Material::of_bodies({-1, 0.3}), InvalidInput);
  CHECK_THROWS_AS(Material::of_bodies({}), InvalidInput);
  CHECK_THROWS_AS(Material::of_contact_modulus(std::nan("")), InvalidInput);
}

TEST_CASE("A pressure above a tenth of E* is doubted", "[material]") {
  CHECK_FALSE(warning_of_pressure(0.1e9, 1e9));
  CHECK(warning_of_pressure(0.2e9, 1e9)
            .value()
            .starts_with("a nominal pressure of 200 MPa is 0.2 times E* = 1 GPa"));
  CHECK(warning_of_pressure(1e6, 115).value().starts_with(
      "a nominal pressure of 1 MPa is 8696 times E* = 115 Pa"));
}
