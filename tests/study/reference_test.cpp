// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/damping/closed_form.hpp>
#include <sstream>
#include <string>
#include <vector>

using namespace salebra;

namespace {

/// Rows of a table in data/reference, without comments and heading.
std::vector<std::vector<double>> reference(const std::string& name) {
  std::ifstream stream(std::string(SALEBRA_DATA) + "/reference/" + name);
  std::vector<std::vector<double>> rows;
  bool heading = true;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with('#')) continue;
    if (heading) {
      heading = false;
      continue;
    }
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

}  // namespace

TEST_CASE("The drag integral J(k) is that of an independent quadrature", "[reference]") {
  const auto rows = reference("drag_integral.csv");
  REQUIRE(rows.size() == 12);
  for (const auto& row : rows) {
    INFO("k = " << row[0]);
    // The function is accurate to about 1e-15 of e^{−k}J, and e^k has a relative error of k
    // epsilon.
    CHECK(closed_form::drag_integral_scaled(row[0]) * std::exp(row[0]) ==
          Approx(row[1]).epsilon(2e-14).margin(0));
  }
}

TEST_CASE("Greenwood and Williamson's integrals are those of an independent quadrature",
          "[reference]") {
  const SummitEnsemble ensemble{.summit_density = 2e12, .radius = 1e-7, .summit_rms = 3e-8};
  const double modulus = 1e10, area = 1e-9;
  const StatisticalSummits summits(ensemble, Material::of_contact_modulus(modulus), area);
  const auto rows = reference("gaussian_summits.csv");
  REQUIRE(rows.size() == 8);
  for (const auto& row : rows) {
    INFO("h = " << row[0]);
    const AsperityContact contact = summits.at(row[0] * ensemble.summit_rms);
    const double scale = modulus * std::sqrt(ensemble.radius) * ensemble.summit_density * area;
    // The quadrature of the library has an error of 1e-10.
    CHECK(contact.normal_stiffness ==
          Approx(2 * scale * std::sqrt(ensemble.summit_rms) * row[1]).epsilon(1e-10).margin(0));
    CHECK(contact.contact_area == Approx(std::acos(-1) * ensemble.radius * ensemble.summit_density *
                                         area * ensemble.summit_rms * row[2])
                                      .epsilon(1e-10)
                                      .margin(0));
    CHECK(contact.force == Approx(4. / 3. * scale * std::pow(ensemble.summit_rms, 1.5) * row[3])
                               .epsilon(1e-10)
                               .margin(0));
  }
}
