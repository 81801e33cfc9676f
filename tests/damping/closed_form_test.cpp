// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/closed_form.hpp>

using namespace salebra;
namespace cf = salebra::closed_form;
using std::numbers::pi;

namespace {

const EqualFrequency equal{
    .normal_amplitude = 3e-7, .tangential_amplitude = 2e-7, .phase = 0.7, .angular_frequency = 50};
const Drag drag{.normal_amplitude = 3e-7, .drag_velocity = 1e-4, .angular_frequency = 300};

// Composite Gauss–Legendre rule with six points per panel: an independent method for smooth
// integrands.
double gauss(const std::function<double(double)>& f, double low, double high, int panels) {
  const double node[3] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  const double weight[3] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const double half = 0.5 * (high - low) / panels;
  double sum = 0;
  for (int i = 0; i < panels; ++i) {
    const double middle = low + (2 * i + 1) * half;
    for (int j = 0; j < 3; ++j)
      sum += weight[j] * (f(middle - half * node[j]) + f(middle + half * node[j]));
  }
  return sum * half;
}

}  // namespace

TEST_CASE("The damping constant of case (a) is that of a damper with the same loss",
          "[closed_form]") {
  const double work = 1e-9;
  // An equivalent damper loses γ⟨ẋ²⟩ = γ(u_x ω)²/2.
  const double velocity = equal.tangential_amplitude * equal.angular_frequency;
  CHECK(cf::damping_constant(work, equal) * velocity * velocity / 2 ==
        Approx(cf::power(work, equal)).epsilon(1e-14));
  EqualFrequency unknown_frequency = equal;
  unknown_frequency.angular_frequency = 0;
  CHECK(std::isnan(cf::power(work, unknown_frequency)));
}

TEST_CASE("J(k) has its known values and its three branches join", "[closed_form]") {
  CHECK(cf::drag_integral_scaled(0) == Approx(pi * pi - 4).epsilon(1e-15));
  // e^{−k}J(k) by quadrature with 30 digits; the branches change at 1 and 20.
  const double reference[][2] = {{1e-6, 5.86959606409038587},     {0.3, 3.87024733474871944},
                                 {0.999999, 1.59059470644412307}, {1.0, 1.59059282735721884},
                                 {1.5, 0.91103600386589087},      {3.0, 0.251758397692566097},
                                 {7.0, 0.0430383811195258302},    {19.9, 0.00513861626650823559},
                                 {20.1, 0.00503596566751939218},  {60.0, 0.000558684036572699869},
                                 {500.0, 8.00534188868789947e-6}};
  for (const auto& [k, value] : reference) {
    CAPTURE(k);
    CHECK(cf::drag_integral_scaled(k) == Approx(value).epsilon(1e-14));
  }
  CHECK(std::exp(1.0) * cf::drag_integral_scaled(1) == Approx(4.323679579).epsilon(1e-9));
  CHECK(std::exp(3.0) * cf::drag_integral_scaled(3) == Approx(5.056702593).epsilon(1e-9));
}

TEST_CASE("J(k), I_0(k) and the equal-frequency ratio are the integrals they stand for",
          "[closed_form]") {
  const double k = GENERATE(1e-4, 0.5, 0.9999, 1.0001, 2.0, 10.0, 25.0);
  auto weight = [&](double angle) { return std::exp(k * (std::cos(angle) - 1)); };
  // Six points in each of 100 panels: the error is far below 1e-13 for k up to 25.
  CHECK(cf::drag_integral_scaled(k) ==
        Approx(gauss([&](double t) { return t * t * std::sin(t) * weight(t); }, 0, pi, 100))
            .epsilon(1e-12));
  CHECK(cf::mean_force_ratio_scaled(k) == Approx(gauss(weight, 0, pi, 100) / pi).epsilon(1e-13));
  // s² = 4u_x² sin²φ0 sin²θ in ½∫K_t's²dζ, dζ = −u_z sinθ dθ.
  auto release = [&](double t) { return std::pow(std::sin(t), 3) * weight(t); };
  CHECK(cf::equal_frequency_ratio_scaled(k) ==
        Approx(0.75 * gauss(release, 0, pi, 100)).epsilon(1e-12));
}

TEST_CASE("Small and large amplitudes of the exponential law have their limits", "[closed_form]") {
  const double force = 2, decay_length = 1e-7, ratio = 0.8;
  auto at = [&](auto motion, double k) {
    motion.normal_amplitude = k * decay_length;
    const double small = cf::work_per_cycle(ratio, force / (decay_length * decay_length), motion);
    return cf::work_per_cycle_exponential(ratio, force, decay_length, motion) / small;
  };
  // 1 + k²/10 + O(k⁴), and 1 − 0.42k + … in case (b), where c_1/c_0 = (−π² + π²/2)/2/(π² − 4) =
  // −0.4203.
  CHECK(at(equal, 1e-2) - 1 == Approx(1e-5).epsilon(1e-4));
  CHECK((at(drag, 1e-5) - 1) / 1e-5 == Approx(-pi * pi / 4 / (pi * pi - 4)).epsilon(1e-4));
  CHECK(1 / at(drag, 0.5) == Approx(1.2).epsilon(0.02));
  EqualFrequency violent = equal;
  violent.normal_amplitude = 600 * decay_length;
  CHECK_THROWS_AS(cf::work_per_cycle_exponential(ratio, force, decay_length, violent),
                  InvalidInput);
  violent.normal_amplitude = 1e6 * decay_length;
  CHECK(std::isfinite(
      cf::work_per_cycle_exponential_held_force(ratio, force, decay_length, violent)));
}

TEST_CASE("Under a dead weight the exponential contact is that of a force lower by I_0(k)",
          "[closed_form]") {
  const double decay_length = 1e-7, ratio = 0.8, k = GENERATE(1e-5, 0.3, 0.9999, 1.0001, 9.0);
  Drag motion = drag;
  motion.normal_amplitude = k * decay_length;
  const double shift = cf::indentation_shift_at_held_force(motion.normal_amplitude, decay_length);
  const double force = std::exp(shift / decay_length);
  CHECK(cf::work_per_cycle_exponential_held_force(ratio, 1, decay_length, motion) ==
        Approx(cf::work_per_cycle_exponential(ratio, force, decay_length, motion)).epsilon(1e-13));
  if (k < 1e-3) CHECK(shift == Approx(-decay_length * k * k / 4).epsilon(1e-9));
}

TEST_CASE("I(r) is the release integral of two frequencies", "[closed_form]") {
  const double ratio = GENERATE(1e-3, 0.1, 0.2499, 0.2501, 0.5, 0.5 + 1e-9, 0.75, 1.0, 2.5);
  // s| = 2u_x |sin(ω_x t_j + φ0) sin(rθ)|: this is the integral without the first sine.
  const double direct =
      gauss([&](double t) { return std::pow(std::sin(ratio * t), 2) * std::sin(t); }, 0, pi, 60);
  CHECK(cf::frequency_ratio_integral(ratio) == Approx(direct).epsilon(1e-11));
}

TEST_CASE("I(r) and S join Eq (12) at r = 1 and the slow drag at r → 0", "[closed_form]") {
  CHECK(cf::frequency_ratio_integral(1) == Approx(4.0 / 3).epsilon(1e-15));
  CHECK(cf::frequency_ratio_integral(1e-5) == Approx((pi * pi - 4) * 1e-10).epsilon(1e-8));
  for (int p = 1; p < 8; ++p) {
    // q = 1: phases φ0 + 2πj/p at the p normal maxima.
    double sum = 0;
    for (int j = 0; j < p; ++j) sum += std::pow(std::sin(0.4 + 2 * pi * j / p), 2);
    CHECK(cf::frequency_ratio_phase_sum(p, 0.4) == Approx(sum).epsilon(1e-13));
  }
}
