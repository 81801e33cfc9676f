// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/damping/tangential_contact.hpp>
#include <vector>

#include "spring_foundation.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

constexpr double ratio = 0.8;

struct Point {
  double indentation, x;
};

// A paraboloid that touches far from indentation 0, so that its indentations are rounded to 1e-9 of
// what the first springs compress. Counts how often K_t is asked for.
class DistantParaboloid final : public ContactLaw {
 public:
  explicit DistantParaboloid(double touch) : ContactLaw(ratio), touch_(touch) {}
  double force(double d) const override { return std::pow(above(d), 1.5); }
  double normal_stiffness(double d) const override { return 1.5 * std::sqrt(above(d)); }
  double force_curvature(double d) const override { return 0.75 / std::sqrt(above(d)); }
  double tangential_stiffness(double d) const override {
    ++asked;
    return ratio * normal_stiffness(d);
  }
  double first_touch() const override { return touch_; }
  double lowest_indentation() const override { return touch_; }
  double indentation_of(double force) const override { return touch_ + std::pow(force, 2. / 3); }

  mutable int asked = 0;

 private:
  double above(double d) const { return std::max(d - touch_, 0.0); }
  double touch_;
};

// A path with turning points at all depths, and with horizontal and vertical steps.
std::vector<Point> wild_path(double low, double high, double reach, int count) {
  std::mt19937_64 bits(7);
  auto uniform = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
  std::vector<Point> path{{low, 0}};
  for (int i = 1; i < count; ++i) {
    Point next{low + (high - low) * uniform(), reach * (2 * uniform() - 1)};
    if (i % 7 == 0) next.indentation = path.back().indentation;
    if (i % 11 == 0) next.x = path.back().x;
    if (i % 40 == 0) next.indentation = low;
    path.push_back(next);
  }
  return path;
}

// Springs with a friction limit, moved in small substeps: first order in the substep.
class FrictionSprings {
 public:
  FrictionSprings(const ContactLaw& law, double lowest, double highest, int springs,
                  double friction)
      : limit_(friction / law.modulus_ratio()) {
    const double step = (highest - lowest) / springs;
    for (int i = 0; i < springs; ++i)
      springs_.push_back({lowest + (i + 0.5) * step,
                          law.tangential_stiffness(lowest + (i + 1) * step) -
                              law.tangential_stiffness(lowest + i * step),
                          0});
  }
  void start(double indentation, double x) {
    indentation_ = indentation, x_ = x;
    lost_ = 0;
    for (Spring& spring : springs_) spring.anchor = x;
  }
  void move_to(double indentation, double x, int substeps) {
    const Point from{indentation_, x_};
    for (int i = 1; i <= substeps; ++i) {
      const double part = static_cast<double>(i) / substeps;
      indentation_ = from.indentation + part * (indentation - from.indentation);
      x_ = from.x + part * (x - from.x);
      for (Spring& spring : springs_) {
        const double room = std::max(0.0, limit_ * (indentation_ - spring.spring_depth));
        const double anchor = std::clamp(spring.anchor, x_ - room, x_ + room);
        // A spring that opens keeps its anchor with the indenter; it loses nothing then.
        const double before = x_ - spring.anchor, after = x_ - anchor;
        lost_ += 0.5 * spring.stiffness * (before + after) * (anchor - spring.anchor) *
                 (indentation_ > spring.spring_depth ? 1 : 0);
        if (indentation_ <= spring.spring_depth && room == 0 && spring.touched)
          lost_ += 0.5 * spring.stiffness * before * before;
        spring.touched = indentation_ > spring.spring_depth;
        spring.anchor = anchor;
      }
    }
  }
  double lost() const { return lost_; }
  double force() const {
    double force = 0;
    for (const Spring& spring : springs_)
      if (indentation_ > spring.spring_depth) force += spring.stiffness * (x_ - spring.anchor);
    return force;
  }

 private:
  struct Spring {
    double spring_depth, stiffness, anchor;
    bool touched = false;
  };
  std::vector<Spring> springs_;
  double limit_, indentation_ = 0, x_ = 0, lost_ = 0;
};

}  // namespace

TEST_CASE("Along any path the stack of turning points is the spring foundation", "[tangential]") {
  const double low = 2e-7, high = 1e-6, reach = 3e-7;
  const PowerLaw law(1e9, GENERATE(1.5, 2.0, 3.0), ratio);
  const auto path = wild_path(low, high, reach, 200);
  TangentialContact contact(law, low, high);
  contact.start(low, 0);
  auto worst = [&](int count) {
    salebra_test::SpringFoundation springs(law, low, high, count);
    springs.start(low, 0);
    contact.start(low, 0);
    double error = 0;
    for (const Point& point : path) {
      springs.move_to(point.indentation, point.x);
      contact.move_to(point.indentation, point.x);
      error = std::max({error,
                        std::abs(springs.force() - contact.tangential_force()) /
                            (law.tangential_stiffness(high) * reach),
                        std::abs(springs.released() - contact.dissipated()) / springs.work(),
                        std::abs(springs.stored() - contact.stored_energy()) / springs.work(),
                        std::abs(springs.work() - contact.external_work()) / springs.work()});
    }
    return error;
  };
  // A step of the path divides the depth step of a spring at random: first order for the force,
  // with constants that scatter.
  const double coarse = worst(500), fine = worst(8000);
  CHECK(fine < 5e-4);
  CHECK(fine < coarse / 4);
}

TEST_CASE("What is put in by F_x is stored or lost", "[tangential]") {
  const double low = 1e-7, high = 1e-6;
  const ExponentialLaw law(1, 2e-7, ratio);
  const double friction = GENERATE(0.1, 0.5, 1e9, INFINITY);
  TangentialContact contact(law, low, high,
                            {.friction_coefficient = friction, .tangential_range = 6e-7});
  const auto path = wild_path(low, high, 3e-7, 60);
  contact.start(low, 0);
  double work = 0, turnover = 0;
  const int substeps = 400;
  for (std::size_t i = 1; i < path.size(); ++i)
    for (int j = 1; j <= substeps; ++j) {
      const double part = static_cast<double>(j) / substeps;
      const double before = contact.tangential_force();
      contact.move_to(
          path[i - 1].indentation + part * (path[i].indentation - path[i - 1].indentation),
          path[i - 1].x + part * (path[i].x - path[i - 1].x));
      const double step =
          0.5 * (before + contact.tangential_force()) * (path[i].x - path[i - 1].x) / substeps;
      work += step;
      turnover += std::abs(step);
    }
  // Trapezoidal rule on a smooth force with kinks: slightly more than (1/400)².
  CHECK(contact.external_work() == Approx(work).margin(2e-5 * turnover));
  CHECK(contact.dissipated() > 0.01 * turnover);
}

TEST_CASE("Straight steps may be cut anywhere", "[tangential]") {
  const double low = 1e-7, high = 1e-6;
  const PowerLaw law(1e9, 1.5, ratio);
  const double friction = GENERATE(0.2, 1.5, INFINITY);
  const TangentialContactOptions options{.friction_coefficient = friction,
                                         .tangential_range = 6e-7};
  TangentialContact whole(law, low, high, options), pieces(law, low, high, options);
  const auto path = wild_path(low, high, 3e-7, 120);
  whole.start(low, 0), pieces.start(low, 0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    whole.move_to(path[i].indentation, path[i].x);
    for (int j = 1; j <= 13; ++j) {
      const double part = j / 13.0;
      pieces.move_to(
          path[i - 1].indentation + part * (path[i].indentation - path[i - 1].indentation),
          path[i - 1].x + part * (path[i].x - path[i - 1].x));
    }
  }
  CHECK(pieces.dissipated() == Approx(whole.dissipated()).epsilon(1e-9));
  CHECK(pieces.dissipated_in_permanent_contact() ==
        Approx(whole.dissipated_in_permanent_contact()).epsilon(1e-9).margin(1e-30));
  CHECK(pieces.tangential_force() ==
        Approx(whole.tangential_force()).margin(1e-9 * law.tangential_stiffness(high) * 3e-7));
}

TEST_CASE("The memory holds one descent, not the past", "[tangential]") {
  const PowerLaw law(1e9, 1.5, ratio);
  const double middle = 1e-6, amplitude = 5e-7;
  auto memory_after = [&](int cycles, int steps, double merge_tolerance) {
    TangentialContact contact(law, middle - amplitude, middle + amplitude,
                              {.merge_tolerance = merge_tolerance});
    contact.start(middle - amplitude, 0);
    std::size_t most = 0;
    double lost = 0;
    for (int i = 1; i <= cycles * steps; ++i) {
      const double angle = 2 * pi * (i % steps) / steps;
      contact.move_to(middle - amplitude * std::cos(angle), 2e-7 * std::sin(angle + 0.3));
      most = std::max(most, contact.memory());
      lost = contact.dissipated();
    }
    return std::pair{most, lost / cycles};
  };
  CHECK(memory_after(20, 200, 0).first == memory_after(2, 200, 0).first);
  CHECK(memory_after(2, 200, 0).first <= 102);
  // 100 times the steps take 100 times the memory without merging. With merging the memory stays
  // the same, and W changes by at most the tolerance.
  const auto [merged, merged_loss] = memory_after(2, 20000, 1e-13);
  const auto [kept, kept_loss] = memory_after(2, 20000, 0);
  CHECK(kept > 9000);
  CHECK(merged < kept / 2);
  CHECK(memory_after(2, 80000, 1e-13).first < 1.2 * static_cast<double>(merged));
  CHECK(merged_loss == Approx(kept_loss).epsilon(1e-6));
  // Two rises with a step in x between them, whose ends lie on one line, must not be merged.
  auto force_after = [&](double merge_tolerance) {
    TangentialContact contact(law, 1e-7, 1e-6, {.merge_tolerance = merge_tolerance});
    contact.start(1e-7, 0);
    contact.move_to(4e-7, 0);
    contact.move_to(4e-7, 1e-7);
    contact.move_to(7e-7, 2e-7);
    return contact.tangential_force();
  };
  CHECK(force_after(1e-12) == Approx(force_after(0)).epsilon(1e-9));
}

TEST_CASE("Cattaneo–Mindlin: force, stick and the loop of a paraboloid", "[tangential]") {
  const double indentation = 1e-6, friction = 0.4, coefficient = 1e9;
  const PowerLaw law(coefficient, 1.5, ratio);
  // Gross sliding begins at x = μE*δ/G*.
  const double sliding = friction / ratio * indentation, limit = friction * law.force(indentation);
  TangentialContact contact(law, indentation, indentation,
                            {.friction_coefficient = friction, .tangential_range = 2 * sliding});
  auto exact = [&](double x) { return limit * (1 - std::pow(1 - x / sliding, 1.5)); };
  contact.start(indentation, 0);
  for (const double part : {0.1, 0.37, 0.8, 0.99}) {
    contact.move_to(indentation, part * sliding);
    CHECK(contact.tangential_force() == Approx(exact(part * sliding)).epsilon(1e-9));
  }
  contact.move_to(indentation, 1.5 * sliding);
  CHECK(contact.tangential_force() == Approx(limit).epsilon(1e-10));

  // The loop between ±x by Masing's rule: 8∫_0^x F dx − 4xF(x).
  const double part = GENERATE(0.2, 0.7, 1.0), x = part * sliding;
  const double primitive = limit * (x - sliding * 0.4 * (1 - std::pow(1 - part, 2.5)));
  contact.start(indentation, 0);
  contact.move_to(indentation, x);
  const double before = contact.dissipated();
  contact.move_to(indentation, -x);
  CHECK(contact.tangential_force() == Approx(-exact(x)).epsilon(1e-9));
  contact.move_to(indentation, x);
  CHECK(contact.dissipated() - before == Approx(8 * primitive - 4 * x * exact(x)).epsilon(1e-8));
  CHECK(contact.dissipated_in_permanent_contact() == Approx(contact.dissipated()).epsilon(1e-12));
}

TEST_CASE(
    "Cattaneo–Mindlin: the stick radius is a(1 − F_x/μF)^{1/3} under a sphere, ^{1/2} under a cone",
    "[tangential]") {
  const double friction = 0.4, indentation = 1e-6;
  const Material material = Material::of_moduli(1e9, ratio * 1e9);
  const bool sphere = GENERATE(true, false);
  const IndenterLaw law(sphere ? paraboloid_profile(1e-2) : cone_profile(0.1), material);
  const double sliding = friction / ratio * indentation, limit = friction * law.force(indentation);
  const double edge = law.contact_radius(indentation);
  TangentialContact contact(law, indentation, indentation,
                            {.friction_coefficient = friction, .tangential_range = 2 * sliding});
  for (const double part : {0.1, 0.5, 0.9}) {
    const double x = part * sliding, step = 1e-4 * sliding;
    const auto force_at = [&](double shift) {
      contact.start(indentation, 0);
      contact.move_to(indentation, shift);
      return contact.tangential_force();
    };
    // Only springs that stick carry more: dF_x/dx = 2G*c, by central differences of second order in
    // 1e-4/(1 − part).
    const double stick = (force_at(x + step) - force_at(x - step)) / (2 * step) / (2 * ratio * 1e9);
    CHECK(stick ==
          Approx(edge * std::pow(1 - force_at(x) / limit, sphere ? 1.0 / 3 : 0.5)).epsilon(1e-6));
  }
}

TEST_CASE("Varying normal force: the friction stack is springs with a limit", "[tangential]") {
  const double low = 2e-7, high = 1e-6, friction = GENERATE(0.1, 0.4, 2.0);
  const PowerLaw law(1e9, 1.5, ratio);
  const auto path = wild_path(low, high, 3e-7, 40);
  TangentialContact contact(law, low, high,
                            {.friction_coefficient = friction, .tangential_range = 6e-7});
  contact.start(low, 0);
  for (std::size_t i = 1; i < path.size(); ++i) contact.move_to(path[i].indentation, path[i].x);
  struct Outcome {
    double lost, force;
  };
  auto springs_with = [&](int count) {
    FrictionSprings springs(law, 0, high, count, friction);
    springs.start(low, 0);
    for (std::size_t i = 1; i < path.size(); ++i)
      springs.move_to(path[i].indentation, path[i].x, count / 2);
    return Outcome{
        springs.lost() / contact.dissipated() - 1,
        (springs.force() - contact.tangential_force()) / (law.tangential_stiffness(high) * 3e-7)};
  };
  const Outcome coarse = springs_with(200), fine = springs_with(400);
  CHECK(std::abs(fine.force) < 1e-2);
  // First order in depth step and substep: halving both halves the error, and the extrapolation to
  // 0 is of second order.
  CHECK(coarse.lost / fine.lost == Approx(2).margin(0.1));
  CHECK(2 * fine.lost - coarse.lost == Approx(0).margin(5e-4));
  CHECK(2 * fine.force - coarse.force == Approx(0).margin(5e-4));
}

TEST_CASE("A contact parts where its law bears nothing, and touches again where it then is",
          "[tangential]") {
  const PowerLaw law(1e9, 1.5, ratio);
  for (const double friction : {0.3, double(INFINITY)}) {
    const TangentialContactOptions options{.friction_coefficient = friction,
                                           .tangential_range = 1e-7};
    TangentialContact across(law, 0, 1e-7, options), along(across);
    across.start(5e-8, 0), along.start(5e-8, 0);
    // The same straight steps, across first touch and with a stop there.
    across.move_to(-5e-8, 2e-8);
    along.move_to(0, 1e-8);
    CHECK(across.tangential_force() == 0);
    CHECK(across.stored_energy() == 0);
    CHECK(across.dissipated() == Approx(along.dissipated()).epsilon(1e-12));
    across.move_to(-2e-8, 3e-8), along.move_to(0, 3.4e-8);
    across.move_to(3e-8, 4e-8), along.move_to(3e-8, 4e-8);
    across.move_to(3e-8, 3.9e-8), along.move_to(3e-8, 3.9e-8);
    CHECK(across.tangential_force() > 0);
    CHECK(across.tangential_force() == Approx(along.tangential_force()).epsilon(1e-12));
    CHECK(across.dissipated() == Approx(along.dissipated()).epsilon(1e-12));
  }
}

TEST_CASE("A copy of a contact is a state to come back to", "[tangential]") {
  const ExponentialLaw law(10, 1e-7, ratio);
  TangentialContact contact(law, -5e-8, 5e-8,
                            {.friction_coefficient = 0.3, .tangential_range = 2e-7});
  const auto path = wild_path(-5e-8, 5e-8, 5e-8, 60);
  contact.start(0, 0);
  for (int i = 0; i < 30; ++i) contact.move_to(path[i].indentation, path[i].x);
  const TangentialContact saved = contact;
  const auto go_on = [&] {
    for (int i = 30; i < 60; ++i) contact.move_to(path[i].indentation, path[i].x);
    return std::pair(contact.tangential_force(), contact.dissipated());
  };
  const auto first = go_on();
  contact = saved;
  CHECK(go_on() == first);
}

TEST_CASE("A contact refuses motion that it was not made for", "[tangential]") {
  const PowerLaw law(1e9, 1.5, ratio);
  TangentialContact contact(law, 1e-7, 1e-6);
  contact.start(1e-7, 0);
  CHECK_THROWS_WITH(contact.move_to(2e-6, 0), Catch::Contains("indentation"));
  CHECK_THROWS_AS(contact.move_to(1e-8, 0), InvalidInput);
  CHECK_THROWS_AS(contact.move_to(std::nan(""), 0), InvalidInput);
  CHECK_THROWS_AS(contact.move_to(5e-7, INFINITY), InvalidInput);
  CHECK_THROWS_WITH(TangentialContact(law, 0, 1e-6, {.friction_coefficient = -0.1}),
                    Catch::Contains("friction"));
  CHECK_THROWS_WITH(TangentialContact(law, 0, 1e-6, {.friction_coefficient = 0.1}),
                    Catch::Contains("tangential_range"));
  CHECK_THROWS_AS(TangentialContact(law, 1e-6, 0), InvalidInput);
  ForceCurve curve;
  for (int i = 0; i <= 20; ++i)
    curve.samples.push_back({.indentation = 1e-7 * i, .force = std::exp(0.2 * i)});
  const TabulatedLaw table(curve, ratio);
  CHECK_THROWS_WITH(TangentialContact(table, 1e-6, 3e-6),
                    Catch::Contains("the law ends at 2e-06 m"));
  // Slip reaches first touch below the table's first sample: the contact slides as a whole. K_t has
  // an infinite slope at first touch, where its table is less accurate.
  TangentialContact deep(table, 1e-7, 1e-6,
                         {.friction_coefficient = 0.01, .tangential_range = 2e-6});
  deep.start(1e-6, 0);
  deep.move_to(1e-6, 1e-6);
  CHECK(deep.tangential_force() == Approx(0.01 * table.force(1e-6)).epsilon(1e-6));
  // A force at which the contact slides, and slid before. The search then went on for kilometres
  // until rounding met the force.
  TangentialContact slipping(ExponentialLaw(2, 1e-7, ratio), -1e-7, 1e-7,
                             {.friction_coefficient = 0.3, .tangential_range = 4e-7});
  slipping.slide(0, 0, -1);
  slipping.move_to_force(0, -0.599);
  CHECK(slipping.tangential_force() == Approx(-0.599).epsilon(1e-12));
  for (const double force : {-0.601, 0.601})
    CHECK_THROWS_WITH(slipping.move_to_force(0, force),
                      Catch::Contains("0.6 N, at which the contact slides"));
  CHECK(slipping.tangential_force() == Approx(-0.599).epsilon(1e-12));
}

TEST_CASE(
    "The springs of a contact that touches far from indentation 0 are found by few values of K_t",
    "[tangential]") {
  const double touch = -3;
  const DistantParaboloid law(touch);
  const TangentialContact contact(law, touch, touch + 1);
  CHECK(law.asked < 10'000);
  const DistantParaboloid near(0);
  TangentialContact expected(near, 0, 1), found = contact;
  for (TangentialContact* one : {&expected, &found}) {
    const double zero = one == &found ? touch : 0;
    one->start(zero, 0);
    one->move_to(zero + 1, 0.3);
    one->move_to(zero, 0.1);
  }
  CHECK(found.dissipated() == Approx(expected.dissipated()).epsilon(1e-10));
}
