// SPDX-License-Identifier: GPL-3.0-or-later
// The lay of a surface twin, by the angular harmonics of periodograms in elliptic rings, and spectra
// of scans in elliptic rings.
#include "surface/twin_lay.hpp"

#include <fmt/format.h>
#include <gsl/gsl_sf_bessel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>

#include "surface/significance.hpp"
#include "surface/twin_model.hpp"

namespace salebra::twin_detail {

using std::numbers::pi;

double Lay::log_blur(double v, double u_square) const {
  // q² = u²((s + 1/s)/2 + (s − 1/s)/2 cos 2φ), φ from the direction across the lay, and the mean of
  // e^{−x cos 2φ} is the Bessel function I₀(x).
  const double sum = (stretch + 1 / stretch) / 2, difference = (stretch - 1 / stretch) / 2;
  const double x = v * u_square * difference;
  return v * u_square * (difference - sum) + std::log(gsl_sf_bessel_I0_scaled(x));
}

double Lay::log_blur_slope(double v, double u_square) const {
  const double sum = (stretch + 1 / stretch) / 2, difference = (stretch - 1 / stretch) / 2;
  const double x = v * u_square * difference;
  return -v * u_square * sum + x * gsl_sf_bessel_I1_scaled(x) / gsl_sf_bessel_I0_scaled(x);
}

namespace {

constexpr double two_sided = 1.96;
constexpr double largest_step = 0.2;  ///< of ln of the stretch, from a solution that grids show
constexpr double least_log_stretch = 0.03;  ///< smaller ones are errors of instruments
constexpr double of_nyquist = 0.6;  ///< beyond this part of the Nyquist mode, sampling folds power
constexpr double most_blur = 0.5;   ///< greatest q²σ² at which a lens' blur is divided out
constexpr double steepest = 6;      ///< slope of ln P over ln u of a cut-off
/// Independent modes per mode under the Hann window: 0.26 by theory, and less by the scatter of
/// known surfaces.
constexpr double per_mode = 0.17;
constexpr double tolerance = 0.004;  ///< error of a harmonic of a ring from what is not modelled
/// Greatest fourth harmonic of an elliptic spectrum, greatest differences of ln of the stretch between
/// wavelengths and between scans, and the number of standard errors that they must exceed to be
/// refused. Elliptic spectra of known surfaces stay below half of these limits.
constexpr double most_fourth = 0.1, most_trend = 0.25, most_difference = 0.4, clearly = 6;
constexpr double tip_limit = 0.08;  ///< of tip radius times curvature, as in the fit

/// Positive definite matrix with determinant 1, of the elliptic wave number u² = qᵀGq.
struct Ellipse {
  double xx = 1, xy = 0, yy = 1;

  Lay lay() const {
    const double half = (xx + yy) / 2, difference = std::hypot((xx - yy) / 2, xy);
    const double greatest = half + difference;  // the eigenvalue along the lay is s
    if (!(greatest > 1)) return {};
    double angle = std::atan2(2 * xy, xx - yy) / 2;
    if (angle < 0) angle += pi;
    return {greatest, angle};
  }
  /// ln of the stretch that leads from this ellipse to another.
  double distance(const Ellipse& to) const {
    const double trace = yy * to.xx - 2 * xy * to.xy + xx * to.yy;
    return std::acosh(std::max(1.0, trace / 2));
  }
  /// The ellipse moved by a step of the two estimating equations: G' = Aᵀ exp((−δ, η; η, δ)) A, with
  /// rows across and along of A.
  Ellipse moved(double delta, double eta) const {
    const Lay now = lay();
    const double length = std::hypot(delta, eta), c = std::cosh(length),
                 s = length > 0 ? std::sinh(length) / length : 1;
    const double aa = c - delta * s, ab = eta * s, bb = c + delta * s;
    const Lay::Vector x = now.elliptic(1, 0), y = now.elliptic(0, 1);
    const auto product = [&](const Lay::Vector& p, const Lay::Vector& q) {
      return aa * p.across * q.across + ab * (p.across * q.along + p.along * q.across) +
             bb * p.along * q.along;
    };
    return {product(x, x), product(x, y), product(y, y)};
  }
};

/// Sums over the modes of one scan in one ring.
struct Ring {
  double modes = 0, power = 0, log_u = 0;
  double ratio = 0, c2 = 0, s2 = 0, c4 = 0, s4 = 0;  // of power over its mean at this u
  double lattice_c2 = 0, lattice_s2 = 0, lattice_c4 = 0, lattice_s4 = 0;
};

/// A map, as the search for a lay sees it.
struct Map {
  const ScanSpectrum* scan;
  std::size_t number, group;  // of the scan; of its group
  ScanModes modes;
  double blur, noise;  // σ² of the blur, m²; power of the noise
};

/// Harmonics of a ring of a group or of a scan, as estimates of δ and η.
struct Estimate {
  double delta = 0, eta = 0;
  double weight = 0;  // 1/variance of each of the two
  double c4 = 0, s4 = 0, modes = 0;

  void add(const Estimate& other) {
    const double sum = weight + other.weight, all = modes + other.modes;
    if (sum > 0) {
      delta = (weight * delta + other.weight * other.delta) / sum;
      eta = (weight * eta + other.weight * other.eta) / sum;
    }
    if (all > 0) {
      c4 = (modes * c4 + other.modes * other.c4) / all;
      s4 = (modes * s4 + other.modes * other.s4) / all;
    }
    weight = sum;
    modes = all;
  }
  double length() const { return std::hypot(delta, eta); }
  double error() const { return weight > 0 ? 1 / std::sqrt(weight) : 1e9; }
};

/// The estimates of the rings of one scan, by wave number.
struct ScanEstimates {
  std::vector<double> wavenumber;  // rad/m, elliptic
  std::vector<Estimate> rings;

  Estimate sum(double from = 0, double to = std::numeric_limits<double>::infinity()) const {
    Estimate total;
    for (std::size_t k = 0; k < rings.size(); ++k)
      if (wavenumber[k] >= from && wavenumber[k] < to) total.add(rings[k]);
    return total;
  }
};

double noise_of(const ScanSpectrum& scan) {
  const double stated = scan.instrument.noise;
  if (!std::isnan(stated)) return stated * stated * scan.grid.cell_area() / (4 * pi * pi);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t bin = scan.psd.size() * 2 / 3; bin < scan.psd.size(); ++bin)
    if (scan.modes[bin] > 0) least = std::min(least, scan.psd[bin]);
  return least / 2;
}

/// −d ln P/d ln q of the power in isotropic rings below a wave number: steep beyond a cut-off, where
/// there is only what the window leaks.
double slope_at(const ScanSpectrum& scan, double wavenumber) {
  constexpr double ratio = 1.6;
  const auto power = [&](double q) {
    const auto above = std::ranges::lower_bound(scan.wavenumber, q) - scan.wavenumber.begin();
    return scan.psd[std::min(static_cast<std::size_t>(above), scan.psd.size() - 1)];
  };
  return std::log(power(wavenumber / ratio) / power(wavenumber)) / std::log(ratio);
}

/// visit(κ_x, κ_y, power, count) of the modes under the Hann window with both |κ| below limits; a
/// mode counts for its conjugate, too.
template <class Visitor>
void for_modes(const ScanSpectrum& scan, const ScanModes& modes, double part, Visitor&& visit) {
  const Grid2D& grid = scan.grid;
  const Index columns = grid.ny / 2 + 1;
  const bool drifts = scan.instrument.drifts();
  const auto last_y =
      std::min(columns - 1, static_cast<Index>(part * static_cast<double>(grid.ny) / 2));
  const auto last_x = static_cast<Index>(part * static_cast<double>(grid.nx) / 2);
  for (Index i = 0; i < grid.nx; ++i) {
    const Index k = 2 * i <= grid.nx ? i : i - grid.nx;
    if (std::abs(k) > last_x || (drifts && std::abs(k) <= drift_modes)) continue;
    for (Index j = 0; j <= last_y; ++j) {
      if (j == 0 && k <= 0) continue;
      visit(static_cast<double>(k) * modes.step_x, static_cast<double>(j) * modes.step_y,
            scan.hann_powers[static_cast<std::size_t>(i * columns + j)]);
    }
  }
}

/// The search for a lay among the maps of a list of scans.
class LaySearch {
 public:
  explicit LaySearch(const std::vector<ScanSpectrum>& scans) : scans_(scans) {
    found_.left_out.assign(scans.size(), false);
    const auto groups = members_of(scans, found_.left_out);
    for (std::size_t group = 0; group < groups.size(); ++group)
      for (const std::size_t scan : groups[group]) {
        const ScanSpectrum& one = scans[scan];
        if (one.profile()) continue;
        require(std::ssize(one.hann_powers) == one.grid.nx * (one.grid.ny / 2 + 1), "scans",
                one.hann_powers.size(),
                "powers of modes do not belong to the grid; use what scan_spectrum() returns");
        const bool lens = one.instrument.kind == Instrument::optical;
        const double sigma =
            lens ? one.instrument.resolution / std::sqrt(8 * std::numbers::ln2) : 0;
        maps_.push_back({&one, scan, group, ScanModes(one.grid), sigma * sigma, noise_of(one)});
      }
    groups_ = groups.size();
  }

  FoundLay run() {
    if (maps_.empty()) return std::move(found_);
    leave_out_turned();
    const Ellipse ellipse = solved(maps_);
    const std::vector<ScanEstimates> at_none = estimates({}, maps_),
                                     at_end = estimates(ellipse, maps_);
    const Lay lay = ellipse.lay();
    const Estimate none = sum_of(at_none), end = sum_of(at_end);
    const bool directed =
        none.length() > detail::significant_length * none.error() * scatter(at_none);
    // What the last step would still change is as uncertain.
    const double error = std::hypot(end.error() * scatter(at_end), end.length()),
                 log_stretch = std::log(lay.stretch);
    const bool significant = directed && log_stretch > detail::significant_length * error &&
                             log_stretch > least_log_stretch;
    refuse_differing_scans(at_end);
    // Without a solution, the rings of a stronger lay are beyond the grids or the cut-off.
    const bool vague = directed && (end.error() > 0.3 || end.length() > largest_step);
    refuse_other_spectra(significant ? ellipse : Ellipse{}, vague);
    if (vague)
      refuse(
          "have a lay, of whose strength their grids show too little; give larger maps of more "
          "points");
    if (end.weight > 0) found_.greatest_stretch = std::exp(log_stretch + two_sided * error);
    if (!significant) return std::move(found_);
    found_.lay = lay;
    found_.log_stretch_error = error;
    found_.angle_error = error / (lay.stretch - 1 / lay.stretch);
    for (std::size_t scan = 0; scan < scans_.size(); ++scan)
      if (scans_[scan].profile())
        leave_out(scan, "is left out: a profile of a surface with a lay depends on its direction");
    return std::move(found_);
  }

 private:
  std::string name(std::size_t scan) const {
    return scans_[scan].name.empty() ? std::to_string(scan + 1) : scans_[scan].name;
  }

  void leave_out(std::size_t scan, const std::string& why) {
    found_.left_out[scan] = true;
    found_.notes.push_back("scan " + name(scan) + " " + why);
  }

  /// Ring sums of a map, without (first pass) or with the mean power by which each mode is divided.
  std::vector<Ring> rings_of(const Map& map, const Lay& lay, const std::vector<double>& limits,
                             const std::vector<double>& positions,
                             const std::vector<double>& logarithms) const {
    std::vector<Ring> rings(limits.size() - 1);
    const double unit = 2 * pi / map.modes.side, blur = map.blur * unit * unit;
    const double first = limits.front() * limits.front(), last = limits.back() * limits.back();
    for_modes(*map.scan, map.modes, of_nyquist, [&](double x, double y, double power) {
      const Lay::Vector u = lay.elliptic(x, y);
      const double square = u.across * u.across + u.along * u.along;
      if (square < first || square >= last) return;
      const double log_u = std::log(square) / 2;
      const auto bin = static_cast<std::size_t>(
          std::ranges::upper_bound(limits, std::sqrt(square)) - limits.begin() - 1);
      Ring& ring = rings[std::min(bin, rings.size() - 1)];
      const double sharp = (power - map.noise) * std::exp(blur * (x * x + y * y));
      ring.modes += 1;
      ring.log_u += log_u;
      ring.power += sharp;
      if (positions.empty()) return;
      // Linear in ln P over ln u between the middles of the rings.
      const auto above =
          std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(positions, log_u) - positions.begin(),
                                     1, std::ssize(positions) - 1);
      const auto at = static_cast<std::size_t>(above);
      const double part = (log_u - positions[at - 1]) / (positions[at] - positions[at - 1]);
      const double mean =
          std::exp(logarithms[at - 1] + part * (logarithms[at] - logarithms[at - 1]));
      const double ratio = sharp / mean;
      const double c2 = (u.across * u.across - u.along * u.along) / square,
                   s2 = 2 * u.across * u.along / square, c4 = 2 * c2 * c2 - 1, s4 = 2 * c2 * s2;
      ring.ratio += ratio;
      ring.c2 += ratio * c2;
      ring.s2 += ratio * s2;
      ring.c4 += ratio * c4;
      ring.s4 += ratio * s4;
      ring.lattice_c2 += c2;
      ring.lattice_s2 += s2;
      ring.lattice_c4 += c4;
      ring.lattice_s4 += s4;
    });
    return rings;
  }

  /// Limits of the rings of a map that are whole and in which nothing but the lay and the window
  /// gives the power a direction.
  static std::vector<double> limits_of(const Map& map, const Lay& lay) {
    double highest = of_nyquist * ScanModes(map.scan->grid, lay).nyquist;
    if (map.blur > 0)
      highest = std::min(highest,
                         std::sqrt(most_blur / map.blur / lay.stretch) * map.modes.side / (2 * pi));
    // The window's harmonic, of the order 20s/(24u²), stays below 10 %.
    const double lowest = std::max(8.0, 3 * std::sqrt(lay.stretch));
    std::vector<double> limits;
    for (double limit = lowest; limit <= highest; limit *= 1.15) limits.push_back(limit);
    return limits;
  }

  /// Estimates of the rings of the maps, each group with the mean spectrum of its maps.
  std::vector<ScanEstimates> estimates(const Ellipse& ellipse, const std::vector<Map>& maps) const {
    const Lay lay = ellipse.lay();
    std::vector<ScanEstimates> all(maps.size());
    for (std::size_t group = 0; group < groups_; ++group) {
      std::vector<std::size_t> members;
      for (std::size_t k = 0; k < maps.size(); ++k)
        if (maps[k].group == group) members.push_back(k);
      if (members.empty()) continue;
      const Map& first = maps[members.front()];
      const std::vector<double> limits = limits_of(first, lay);
      if (limits.size() < 4) continue;
      std::vector<Ring> sums(limits.size() - 1);
      for (const std::size_t k : members) {
        const std::vector<Ring> rings = rings_of(maps[k], lay, limits, {}, {});
        for (std::size_t bin = 0; bin < sums.size(); ++bin) {
          sums[bin].modes += rings[bin].modes;
          sums[bin].power += rings[bin].power;
          sums[bin].log_u += rings[bin].log_u;
        }
      }
      // The rings up to the noise, to the cut-off, or to what a tip follows.
      std::vector<double> positions, logarithms;
      const double unit = 2 * pi / first.modes.side, tip = first.scan->instrument.tip_radius;
      double curvature = 0;
      std::size_t used = 0;
      for (; used < sums.size(); ++used) {
        const Ring& ring = sums[used];
        if (ring.modes < 4) break;
        const double mean = ring.power / ring.modes;
        if (!(mean > 3 * first.noise)) break;
        if (slope_at(*first.scan, unit * limits[used] * std::sqrt(lay.stretch)) > steepest) break;
        const double position = ring.log_u / ring.modes, q = unit * std::exp(position);
        if (first.scan->instrument.has_tip()) {
          const double area = pi * unit * unit *
                              (limits[used + 1] * limits[used + 1] - limits[used] * limits[used]);
          curvature += 3.0 / 8 * lay.stretch * lay.stretch * std::pow(q, 4) * mean * area;
          if (tip * std::sqrt(curvature) > tip_limit) break;
        }
        if (used >= 2 && ring.modes > 100 &&
            (logarithms[used - 2] - std::log(mean)) / (position - positions[used - 2]) > steepest) {
          used -= 2;
          break;
        }
        positions.push_back(position);
        logarithms.push_back(std::log(mean));
      }
      if (used < 3) continue;
      positions.resize(used);
      logarithms.resize(used);
      const std::vector<double> inner(limits.begin(),
                                      limits.begin() + static_cast<std::ptrdiff_t>(used) + 1);
      for (const std::size_t k : members) {
        const std::vector<Ring> rings = rings_of(maps[k], lay, inner, positions, logarithms);
        for (std::size_t bin = 0; bin < used; ++bin)
          add_ring(rings[bin], maps[k], lay, positions, logarithms, bin, all[k]);
      }
    }
    return all;
  }

  static void add_ring(const Ring& ring, const Map& map, const Lay& lay,
                       const std::vector<double>& positions, const std::vector<double>& logarithms,
                       std::size_t bin, ScanEstimates& to) {
    if (!(ring.ratio > 0)) return;
    const std::size_t low = bin < 2 ? 0 : bin - 2, high = std::min(positions.size() - 1, bin + 2);
    const double p = std::clamp(
        (logarithms[low] - logarithms[high]) / (positions[high] - positions[low]), 0.0, 4.5);
    const double u = std::exp(positions[bin]);
    // The Hann window smears the spectrum by step/√3 along each axis, which adds second harmonics.
    const double cosine = std::cos(lay.angle), sine = std::sin(lay.angle);
    const double a = map.modes.step_x * map.modes.step_x / 3,
                 b = map.modes.step_y * map.modes.step_y / 3;
    const double across = (sine * sine * a + cosine * cosine * b) / lay.stretch,
                 along = (cosine * cosine * a + sine * sine * b) * lay.stretch,
                 both = cosine * sine * (b - a);
    const double window = p * (p + 2) / (8 * u * u);
    const double c2 = ring.c2 / ring.ratio - ring.lattice_c2 / ring.modes -
                      window * (across - along),
                 s2 = ring.s2 / ring.ratio - ring.lattice_s2 / ring.modes - 2 * window * both;
    // The modes of the half plane stand for their conjugates.
    const double modes = per_mode * ring.modes * map.scan->weight;
    Estimate one;
    one.modes = 1 / (1 / modes + 2 * tolerance * tolerance);
    one.c4 = ring.c4 / ring.ratio - ring.lattice_c4 / ring.modes;
    one.s4 = ring.s4 / ring.ratio - ring.lattice_s4 / ring.modes;
    if (p > 0.3) {
      one.delta = 4 * c2 / p;
      one.eta = -4 * s2 / p;
      one.weight = one.modes * p * p / 8;
    }
    to.wavenumber.push_back(2 * pi * u / map.modes.side);
    to.rings.push_back(one);
  }

  static Estimate sum_of(const std::vector<ScanEstimates>& all, double from = 0,
                         double to = std::numeric_limits<double>::infinity()) {
    Estimate sum;
    for (const ScanEstimates& one : all) sum.add(one.sum(from, to));
    return sum;
  }

  /// The ellipse at which the estimating equations of some maps vanish, with the rings between two
  /// elliptic wave numbers.
  Ellipse solved(const std::vector<Map>& maps, double from = 0,
                 double to = std::numeric_limits<double>::infinity()) const {
    Ellipse ellipse, before, best;
    double delta = 0, eta = 0, shortest = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 60; ++step) {
      const Estimate sum = sum_of(estimates(ellipse, maps), from, to);
      if (sum.weight == 0) {
        // Beyond a lay of which the grids show no ring: half of the last step.
        delta /= 2;
        eta /= 2;
        if (std::hypot(delta, eta) < 1e-3) return std::isfinite(shortest) ? best : before;
        ellipse = before.moved(delta, eta);
        continue;
      }
      before = ellipse;
      const double length = sum.length();
      if (length < shortest) {
        shortest = length;
        best = ellipse;
      }
      // Rings come and go as the ellipse changes, so that full steps may lead around the solution.
      const double longest = step < 20 ? 1 : 0.4;
      const double factor = std::min(longest, 0.7 / std::max(length, 1e-12));
      delta = factor * sum.delta;
      eta = factor * sum.eta;
      ellipse = ellipse.moved(delta, eta);
      if (length < 1e-4) return ellipse;
    }
    return best;
  }

  /// Square root of the scatter of the maps' estimates over what their modes explain, at least 1:
  /// about the mean of all maps or, not to count a trend with the wavelength, about that of each
  /// group.
  double scatter(const std::vector<ScanEstimates>& all, bool of_groups = false) const {
    double squares = 0, freedom = 0;
    for (std::size_t group = 0; group < (of_groups ? groups_ : 1); ++group) {
      Estimate mean;
      std::vector<Estimate> members;
      for (std::size_t k = 0; k < all.size(); ++k)
        if (!of_groups || maps_[k].group == group)
          if (const Estimate one = all[k].sum(); one.weight > 0) {
            members.push_back(one);
            mean.add(one);
          }
      for (const Estimate& one : members)
        squares +=
            one.weight * (std::pow(one.delta - mean.delta, 2) + std::pow(one.eta - mean.eta, 2));
      freedom += 2 * std::max(0.0, static_cast<double>(members.size()) - 1);
    }
    return freedom < 2 ? 1 : std::sqrt(std::max(1.0, squares / freedom));
  }

  /// Leaves out maps whose lay differs from that of most maps of their group.
  void leave_out_turned() {
    std::vector<Ellipse> ellipses;
    std::vector<double> errors;
    for (const Map& map : maps_) {
      ellipses.push_back(solved({map}));
      errors.push_back(estimates(ellipses.back(), {map})[0].sum().error());
    }
    std::vector<bool> turned(maps_.size(), false);
    for (std::size_t group = 0; group < groups_; ++group) {
      std::vector<std::size_t> members;
      for (std::size_t k = 0; k < maps_.size(); ++k)
        if (maps_[k].group == group && errors[k] < 0.3) members.push_back(k);
      if (members.size() < 3) continue;
      const auto differ = [&](std::size_t i, std::size_t j) {
        return ellipses[i].distance(ellipses[j]) >
               std::max(0.4, 8 * std::hypot(errors[i], errors[j]));
      };
      const auto unlike = [&](std::size_t i) {
        return std::ranges::count_if(members, [&](std::size_t j) { return differ(i, j); });
      };
      const std::size_t middle = *std::ranges::min_element(members, {}, unlike);
      if (2 * unlike(middle) >= std::ssize(members)) continue;
      for (const std::size_t k : members) turned[k] = differ(middle, k);
      for (const std::size_t k : members)
        if (turned[k])
          leave_out(maps_[k].number,
                    fmt::format("is left out: its lay is {}, that of the others {}; was it mounted "
                                "turned?",
                                in_words(ellipses[k]), in_words(ellipses[middle])));
    }
    std::vector<Map> kept;
    for (std::size_t k = 0; k < maps_.size(); ++k)
      if (!turned[k]) kept.push_back(maps_[k]);
    maps_ = std::move(kept);
  }

  static std::string in_words(const Ellipse& ellipse) {
    const Lay lay = ellipse.lay();
    if (lay.stretch < 1.1) return "none";
    return fmt::format("{:.2g} to 1 at {:.0f}°", lay.stretch,
                       std::fmod(std::round(lay.angle * 180 / pi), 180.0));
  }

  [[noreturn]] static void refuse(const std::string& why) { throw InvalidInput("scans", why); }

  /// Refuses surfaces whose spectrum is no function of an elliptic wave number. vague: the ellipse
  /// is not known, so that it explains nothing.
  void refuse_other_spectra(const Ellipse& ellipse, bool vague) const {
    const std::vector<ScanEstimates> all = estimates(ellipse, maps_);
    const Estimate sum = sum_of(all);
    const double fourth = std::hypot(sum.c4, sum.s4);
    const bool other =
        fourth > most_fourth &&
        fourth > clearly * scatter(all, true) / std::sqrt(2 * std::max(sum.modes, 1e-9));
    if (other) refuse_crossing();
    refuse_trend(all);
    if (other && !vague)
      refuse(
          fmt::format("have a spectrum that is no function of an elliptic wave number: two "
                      "processes with different lays, of which the twin has only one; its best "
                      "lay would be {}",
                      in_words(solved(maps_))));
  }

  void refuse_differing_scans(const std::vector<ScanEstimates>& all) const;
  void refuse_trend(const std::vector<ScanEstimates>& all) const;
  void refuse_crossing() const;

  const std::vector<ScanSpectrum>& scans_;
  std::vector<Map> maps_;
  std::size_t groups_ = 0;
  FoundLay found_;
};

void LaySearch::refuse_differing_scans(const std::vector<ScanEstimates>& all) const {
  for (std::size_t k = 0; k < maps_.size(); ++k) {
    // The mean difference from the other scans at the same wavelengths.
    Estimate mean;
    for (std::size_t ring = 0; ring < all[k].rings.size(); ++ring) {
      const Estimate& own = all[k].rings[ring];
      const double q = all[k].wavenumber[ring];
      Estimate others;
      for (std::size_t other = 0; other < maps_.size(); ++other)
        if (other != k) others.add(all[other].sum(q / 1.1, q * 1.1));
      if (own.weight == 0 || others.weight == 0) continue;
      Estimate difference;
      difference.delta = own.delta - others.delta;
      difference.eta = own.eta - others.eta;
      difference.weight = 1 / (1 / own.weight + 1 / others.weight);
      mean.add(difference);
    }
    if (mean.weight == 0 || mean.length() < std::max(most_difference, clearly * mean.error()))
      continue;
    std::vector<Map> others = maps_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    refuse(
        fmt::format("have different lays at the same wavelengths: that of {} is {}, that of the "
                    "others {}; leave it out, or turn it if it was mounted turned",
                    name(maps_[k].number), in_words(solved({maps_[k]})), in_words(solved(others))));
  }
}

void LaySearch::refuse_trend(const std::vector<ScanEstimates>& all) const {
  struct Band {
    double from, to;
    Estimate sum;
  };
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (const ScanEstimates& scan : all)
    for (const double q : scan.wavenumber) {
      lowest = std::min(lowest, q * 0.999);
      highest = std::max(highest, q * 1.001);
    }
  constexpr double ratio = 1.6;
  const double inflation = scatter(all, true);
  std::vector<Band> bands;
  for (double q = lowest; q < highest; q *= ratio)
    if (const Estimate sum = sum_of(all, q, q * ratio); sum.weight > 0)
      bands.push_back({q, q * ratio, sum});
  const Band *first = nullptr, *second = nullptr;
  double furthest = 0;
  for (std::size_t i = 0; i < bands.size(); ++i)
    for (std::size_t j = i + 1; j < bands.size(); ++j) {
      const Estimate &a = bands[i].sum, &b = bands[j].sum;
      const double off = std::hypot(a.delta - b.delta, a.eta - b.eta);
      const double error = std::hypot(a.error(), b.error()) * inflation;
      if (off < most_trend || off < clearly * error || off < furthest) continue;
      furthest = off;
      first = &bands[i];
      second = &bands[j];
    }
  if (!first) return;
  const Ellipse of_long = solved(maps_, first->from, first->to),
                of_short = solved(maps_, second->from, second->to);
  const auto at = [](const Band& band) {
    return format_quantity(2 * pi / std::sqrt(band.from * band.to), Dimension::length, 3);
  };
  refuse(
      fmt::format("have a lay that depends on the wavelength, {} at {} and {} at {}: two "
                  "processes, of which the twin has only one",
                  in_words(of_long), at(*first), in_words(of_short), at(*second)));
}

void LaySearch::refuse_crossing() const {
  // Power by direction, over its mean at the same wavelength.
  constexpr std::size_t sectors = 60;
  std::array<double, sectors> power{}, modes{};
  for (const Map& map : maps_) {
    const std::vector<double> limits = limits_of(map, {});
    if (limits.size() < 4) continue;
    std::vector<double> sums(limits.size() - 1), counts(limits.size() - 1);
    const auto visit = [&](const auto& take) {
      for_modes(*map.scan, map.modes, of_nyquist, [&](double x, double y, double of_mode) {
        const double kappa = std::hypot(x, y);
        if (kappa < limits.front() || kappa >= limits.back()) return;
        const auto bin =
            static_cast<std::size_t>(std::ranges::upper_bound(limits, kappa) - limits.begin() - 1);
        take(bin, of_mode, x, y);
      });
    };
    visit([&](std::size_t bin, double of_mode, double, double) {
      sums[bin] += of_mode;
      counts[bin] += 1;
    });
    visit([&](std::size_t bin, double of_mode, double x, double y) {
      double angle = std::atan2(y, x);
      if (angle < 0) angle += pi;
      const auto sector = static_cast<std::size_t>(angle / pi * sectors) % sectors;
      power[sector] += of_mode * counts[bin] / sums[bin];
      modes[sector] += 1;
    });
  }
  // Maxima of the profile, smoothed over five sectors, and the lowest power between them.
  std::array<double, sectors> profile{};
  const auto around = [](std::size_t sector, int shift) {
    return (sector + sectors + static_cast<std::size_t>(shift + static_cast<int>(sectors))) %
           sectors;
  };
  for (std::size_t k = 0; k < sectors; ++k)
    for (int shift = -2; shift <= 2; ++shift)
      profile[k] += power[around(k, shift)] / std::max(1.0, modes[around(k, shift)]) / 5;
  std::vector<std::size_t> maxima;
  for (std::size_t k = 0; k < sectors; ++k) {
    bool highest = true;
    for (int shift = -4; shift <= 4; ++shift) highest &= profile[k] >= profile[around(k, shift)];
    if (highest) maxima.push_back(k);
  }
  std::ranges::sort(maxima, std::greater(), [&](std::size_t k) { return profile[k]; });
  if (maxima.size() < 2) return;
  const std::size_t a = std::min(maxima[0], maxima[1]), b = std::max(maxima[0], maxima[1]);
  const auto lowest = [&](std::size_t from, std::size_t to) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = from; k <= to; ++k) least = std::min(least, profile[k % sectors]);
    return least;
  };
  // A lay of its own, and no bump of the profile of another.
  const double upper = profile[maxima[0]], lower = profile[maxima[1]],
               range = upper - std::ranges::min(profile);
  if (lower < upper - 0.7 * range ||
      std::max(lowest(a, b), lowest(b, a + sectors)) > lower - 0.05 * range)
    return;
  const auto direction = [](std::size_t sector) {
    // The lay is at right angles to the wave vectors.
    return std::fmod((static_cast<double>(sector) + 0.5) * 180 / sectors + 90, 180.0);
  };
  const double apart = std::abs(std::remainder(direction(a) - direction(b), 180.0));
  refuse(
      fmt::format("have two lays that cross at {:.0f}°, at {:.0f}° and {:.0f}° from x; the twin "
                  "has only one",
                  apart, direction(a), direction(b)));
}

}  // namespace

FoundLay lay_of(const std::vector<ScanSpectrum>& scans) { return LaySearch(scans).run(); }

ScanSpectrum with_lay(const ScanSpectrum& scan, const Lay& lay) {
  if (lay.stretch == 1) return scan;
  const ScanModes modes(scan.grid, lay);
  const std::vector<double> limits = bin_limits(modes.nyquist);
  const std::size_t bins = limits.size() - 1, tapered = tapered_bins(limits);
  std::vector<double> power(bins), count(bins);
  const auto add = [&](double x, double y, double of_mode, std::size_t first, std::size_t last) {
    const Lay::Vector u = lay.elliptic(x, y);
    const double kappa = std::hypot(u.across, u.along);
    if (kappa < limits[first] || kappa >= limits[last]) return;
    const auto bin =
        static_cast<std::size_t>(std::ranges::upper_bound(limits, kappa) - limits.begin()) - 1;
    power[bin] += of_mode;
    count[bin] += 2;
  };
  const Index count_x = tapered_modes(scan.grid.nx, modes.step_x),
              count_y = tapered_modes(scan.grid.ny, modes.step_y);
  for (Index k = -count_x; k <= count_x; ++k) {
    if (scan.instrument.drifts() && std::abs(k) <= drift_modes) continue;
    for (Index j = 0; j <= count_y; ++j) {
      if (j == 0 && k <= 0) continue;
      add(static_cast<double>(k) * modes.step_x, static_cast<double>(j) * modes.step_y,
          scan.tapered_powers[static_cast<std::size_t>((count_x + k) * (count_y + 1) + j)], 0,
          tapered);
    }
  }
  for_modes(scan, modes, 1,
            [&](double x, double y, double of_mode) { add(x, y, of_mode, tapered, bins); });
  ScanSpectrum elliptic = scan;
  elliptic.tapered_powers.clear();
  elliptic.hann_powers.clear();
  elliptic.wavenumber.clear();
  elliptic.psd.clear();
  elliptic.modes.clear();
  for (std::size_t bin = 0; bin < bins; ++bin) {
    elliptic.wavenumber.push_back(modes.wavenumber(std::sqrt(limits[bin] * limits[bin + 1])));
    elliptic.psd.push_back(count[bin] > 0 ? power[bin] / count[bin] * 2 : 0);
    elliptic.modes.push_back(static_cast<Index>(count[bin]));
  }
  return elliptic;
}

}  // namespace salebra::twin_detail
