// SPDX-License-Identifier: GPL-3.0-or-later
// Surface twin: form of the spectrum, whether roll-off and cut-off are seen, bad scans, checks, and
// the result.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/surface/twin.hpp>
#include <set>

#include "base/numerics/dense_systems.hpp"
#include "base/random.hpp"
#include "base/special_values.hpp"
#include "surface/twin_fit.hpp"
#include "surface/twin_heights.hpp"
#include "surface/twin_lay.hpp"

namespace salebra {
namespace twin_detail {
namespace {

using std::numbers::pi;

constexpr double seen_above = 6;     ///< minimum of 2 ln of a likelihood ratio
constexpr double one_sided = 1.353;  ///< half the 90 % quantile of χ² with one degree
/// A scan is bad if its misfit exceeds this value, also relative to the median of its group. The
/// maximum over 495 good scans of 45 Gaussian surfaces (bench/statistics/twin_coverage.cpp) was
/// 2.2; the tail of the distribution reaches 3.5 in one of 6000 scans, or in one of 250 at a
/// skewness of −1. SurfaceTwin::refused_above follows in the same way: misfits of right laws were
/// 1.00 within a factor of e^±0.25, hence one in 1400 is above 2.2, and one in six at a skewness of
/// −1. In that case a table must be better by a fifth to replace the law.
constexpr double bad_scan_above = 3.5;
constexpr double knots_per_decade = 5;
using detail::unknown;

struct Candidate {
  TwinModel model;
  TwinFit fit;

  double misfit() const {
    TwinModel::Misfit sum;
    for (std::size_t group = 0; group < model.data().size(); ++group) {
      const TwinModel::Misfit one = model.misfit(fit.parameters, group);
      sum.deviance += one.deviance;
      sum.expected += one.expected;
    }
    return sum.ratio();
  }
};

std::pair<double, double> range_of(const std::vector<TwinData>& data) {
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (const TwinData& group : data) {
    lowest = std::min(lowest, group.wavenumber.front());
    highest = std::max(highest, group.wavenumber.back());
  }
  return {lowest, highest};
}

Candidate candidate_of(const std::vector<TwinData>& data, SpectrumForm form) {
  const auto [lowest, highest] = range_of(data);
  TwinModel model(data, TwinLaw{form, std::sqrt(lowest * highest), {}});
  TwinFit fit = fitted(model);
  return {std::move(model), std::move(fit)};
}

/// Fits a tabulated spectrum, starting from the best self-affine law.
Candidate table_near(const Candidate& best) {
  const std::vector<TwinData>& data = best.model.data();
  const TwinLaw& near = best.model.law();
  const auto [lowest, highest] = range_of(data);
  TwinLaw law{SpectrumForm::table, near.reference, {}};
  const double decades = std::log10(highest / lowest);
  const int knots_of_law = std::max(5, static_cast<int>(std::ceil(decades * knots_per_decade)) + 1);
  for (int k = 0; k < knots_of_law; ++k)
    law.knots.push_back(std::log(lowest / law.reference) +
                        std::log(highest / lowest) * k / (knots_of_law - 1));
  TwinModel model(data, law);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(model.size());
  std::vector<double> knots, values(law.knots.size());
  for (const double knot : law.knots) knots.push_back(law.reference * std::exp(knot));
  log_density(near, {best.fit.parameters.data(), static_cast<std::size_t>(near.size())},
              LawPoints(near, knots), values);
  start.head(law.cutoff()) =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
  start.tail(model.size() - law.cutoff()) =
      best.fit.parameters.tail(best.model.size() - near.cutoff());
  // As in fitted(), the first fit has a wide tolerance.
  model.set_tolerance(0.3, 0.3, 1);
  TwinFit fit = refitted(model, minimised(model, start).parameters);
  return {std::move(model), std::move(fit)};
}

/// The fit of the spectrum's form with the greater likelihood, and the fit of the other form.
struct Forms {
  Candidate best;
  std::optional<Candidate> other;
  double ratio = 0;
};

Forms forms_of(const std::vector<TwinData>& data, const std::optional<SpectrumForm>& form) {
  if (form && *form != SpectrumForm::table) return {candidate_of(data, *form), {}, 0};
  Candidate corner = candidate_of(data, SpectrumForm::corner),
            smooth = candidate_of(data, SpectrumForm::smooth);
  // The corner and the smooth form can only be compared with the same tolerance near the cut-off.
  Candidate& guide = smooth.fit.cost < corner.fit.cost ? smooth : corner;
  Candidate& follower = &guide == &smooth ? corner : smooth;
  const double cutoff = 2 * pi * std::exp(-guide.fit.parameters[guide.model.law().cutoff()]);
  follower.model.set_tolerance(0.03, 0.5, cutoff);
  follower.fit = minimised(follower.model, follower.fit.parameters);
  const double ratio = 2 * (corner.fit.cost - smooth.fit.cost);
  if (ratio > 0) return {std::move(smooth), std::move(corner), ratio};
  return {std::move(corner), std::move(smooth), -ratio};
}

/// Compares each scan with the fit of all, and leaves out those that are farther from it than
/// `tolerance` times what happens to Gaussian surfaces.
std::vector<TwinScan> judged_scans(const std::vector<ScanSpectrum>& scans, const Candidate& one,
                                   double tolerance, std::vector<bool>& left_out) {
  std::vector<TwinScan> judged;
  for (std::size_t scan = 0; scan < scans.size(); ++scan)
    judged.push_back({scans[scan].name, unknown, unknown, left_out[scan]});
  for (std::size_t group = 0; group < one.model.data().size(); ++group) {
    const TwinData& data = one.model.data()[group];
    double weight = 0;
    for (const std::size_t scan : data.scans) weight += scans[scan].weight;
    std::vector<double> misfits;
    std::vector<bool> far;
    for (const std::size_t scan : data.scans) {
      std::vector<double> psd;
      for (std::size_t k = 0; k < data.bins.size(); ++k)
        psd.push_back(std::max(scans[scan].psd[data.bins[k]], data.leaked[k]));
      const double share = std::min(1 - 1e-9, scans[scan].weight / weight);
      const TwinModel::Misfit misfit = one.model.misfit_of(one.fit.parameters, group, psd, share);
      judged[scan].misfit = misfit.ratio();
      judged[scan].gain = misfit.gain;
      misfits.push_back(misfit.ratio());
      far.push_back(std::abs(std::log(misfit.gain)) > tolerance * std::numbers::ln2);
    }
    std::vector<double> sorted = misfits;
    std::ranges::sort(sorted);
    const double middle = sorted[(sorted.size() - 1) / 2];
    for (std::size_t k = 0; k < data.scans.size(); ++k)
      if (data.scans.size() >= 3 && (far[k] || (misfits[k] > tolerance * bad_scan_above &&
                                                misfits[k] > tolerance * bad_scan_above * middle)))
        left_out[data.scans[k]] = true;
  }
  return judged;
}

/// Whether the likelihood shows the roll-off (longest waves) and the cut-off (shortest waves).
struct Ends {
  double rolloff_ratio = 0, cutoff_ratio = 0;
  TwinFit without_rolloff, without_cutoff;
  std::optional<TwinProfile> rolloffs, cutoffs;  ///< only if not seen

  bool sees_rolloff() const { return rolloff_ratio > seen_above; }
  bool sees_cutoff() const { return cutoff_ratio > seen_above; }
};

Ends ends_of(const Candidate& one) {
  const TwinModel& model = one.model;
  const TwinLaw& law = model.law();
  Ends ends;
  const auto held = [&](Index parameter, double value) {
    Eigen::VectorXd start = one.fit.parameters;
    start[parameter] = value;
    TwinFit best = minimised(model, start, {parameter});
    // Without a plateau a lower Hurst exponent may fit better.
    if (!law.table()) {
      start[TwinLaw::hurst] -= 0.1;
      const TwinFit second = minimised(model, start, {parameter});
      if (second.cost < best.cost) best = second;
    }
    return best;
  };
  ends.without_cutoff = held(law.cutoff(), model.lowest()[law.cutoff()] + 1e-3);
  ends.cutoff_ratio = 2 * (ends.without_cutoff.cost - one.fit.cost);
  constexpr int steps = 26;
  if (!ends.sees_cutoff()) {
    const double bottom = model.lowest()[law.cutoff()] + 1e-3,
                 top = std::log(2 * pi / model.finest_wavenumber()) + 1.5;
    std::vector<double> values;
    for (int k = 0; k < steps; ++k) values.push_back(top + (bottom - top) * k / (steps - 1));
    ends.cutoffs = profiled(model, law.cutoff(), values, ends.without_cutoff.parameters);
  }
  if (law.table()) return ends;
  const double top = model.highest()[TwinLaw::rolloff] - 1e-3;
  ends.without_rolloff = held(TwinLaw::rolloff, top);
  ends.rolloff_ratio = 2 * (ends.without_rolloff.cost - one.fit.cost);
  if (!ends.sees_rolloff()) {
    const double bottom =
        std::max(model.lowest()[TwinLaw::rolloff] + 1e-3, std::log(0.1 * model.max_scan()));
    std::vector<double> values;
    for (int k = 0; k < steps; ++k) values.push_back(bottom + (top - bottom) * k / (steps - 1));
    ends.rolloffs = profiled(model, TwinLaw::rolloff, values, ends.without_rolloff.parameters);
  }
  return ends;
}

TwinDraw spectrum_of(const TwinModel& model, const Eigen::VectorXd& parameters) {
  return draw_of(model.law(), {parameters.data(), static_cast<std::size_t>(model.law().size())},
                 2 * pi / model.max_scan());
}

/// Value of a function of the spectrum at a fit, and its standard deviation from the curvature of
/// the likelihood there.
struct Spread {
  double value = 0, deviation = 0;
};

template <class Function>
Spread spread_of(const TwinModel& model, const Eigen::VectorXd& parameters,
                 const Eigen::MatrixXd& covariance, const Function& function) {
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(model.size());
  for (Index p = 0; p < model.law().size(); ++p) {
    Eigen::VectorXd up = parameters, down = parameters;
    up[p] += 1e-4;
    down[p] -= 1e-4;
    slope[p] = (function(spectrum_of(model, up)) - function(spectrum_of(model, down))) / 2e-4;
  }
  return {function(spectrum_of(model, parameters)),
          std::sqrt(std::max(0.0, slope.dot(covariance.lazyProduct(slope))))};
}

double log_height(const TwinDraw& draw) { return std::log(draw.rms_height); }

/// Minimum rms height among the fits with a held roll-off (`profile`) whose likelihood is not too
/// low. The height of each fit may be lower still by as much as the rest of the allowed drop in
/// likelihood permits.
double min_height(const Candidate& one, const TwinProfile& profile) {
  double least = one.fit.cost, lowest = std::numeric_limits<double>::infinity();
  for (const TwinFit& fit : profile.fits) least = std::min(least, fit.cost);
  for (const TwinFit& fit : profile.fits) {
    const double rest = least + one_sided - fit.cost;
    if (rest < 0) continue;
    const Spread height =
        spread_of(one.model, fit.parameters,
                  laplace_covariance(one.model, fit.parameters, {TwinLaw::rolloff}), log_height);
    lowest = std::min(lowest, height.value - std::sqrt(2 * rest) * height.deviation);
  }
  return std::exp(lowest);
}

/// Starting parameters of the walkers that sample the posterior: near the fit, and along the fits
/// with a held roll-off or cut-off if roll-off or cut-off are not seen.
Eigen::MatrixXd ensemble(const Candidate& one, const Ends& ends, std::uint64_t seed) {
  const TwinModel& model = one.model;
  const Index size = model.size(), walkers = std::max<Index>(128, 8 * size);
  const auto factor_of = [&](const Eigen::VectorXd& at, const std::vector<Index>& fixed) {
    const detail::Modes modes = detail::symmetric_modes(laplace_covariance(model, at, fixed));
    Eigen::MatrixXd factor = modes.vectors;
    for (Index k = 0; k < size; ++k)
      factor.col(k) *= 0.8 * std::sqrt(std::max(0.0, modes.values[k]));
    return factor;
  };
  const Eigen::MatrixXd about_fit = factor_of(one.fit.parameters, {});
  const auto allowed = [&](const std::optional<TwinProfile>& profile) {
    std::vector<const TwinFit*> fits;
    if (profile)
      for (const TwinFit& fit : profile->fits)
        if (fit.cost < one.fit.cost + 2) fits.push_back(&fit);
    return fits;
  };
  const std::vector<const TwinFit*> long_ends = allowed(ends.rolloffs),
                                    short_ends = allowed(ends.cutoffs);
  constexpr double margin = 1e-4;
  const Eigen::ArrayXd low = model.lowest().array() + margin,
                       high = model.highest().array() - margin;
  Eigen::MatrixXd start(size, walkers);
  for (Index walker = 0; walker < walkers; ++walker) {
    const auto number = static_cast<std::int32_t>(walker);
    Eigen::VectorXd z(size);
    for (Index p = 0; p < size; ++p)
      z[p] = gaussian_pair(seed, number, static_cast<std::int32_t>(p), 111).first;
    const RandomPair drawn = uniform_pair(seed, number, 0, 112),
                     shift = uniform_pair(seed, number, 1, 112);
    const auto chosen = [](const std::vector<const TwinFit*>& fits, double at) {
      return fits[std::min(fits.size() - 1,
                           static_cast<std::size_t>(at * static_cast<double>(fits.size())))];
    };
    Eigen::VectorXd at = one.fit.parameters;
    if (!long_ends.empty()) at = chosen(long_ends, drawn.first)->parameters;
    Eigen::VectorXd moved = about_fit.lazyProduct(z);
    if (!long_ends.empty()) moved[TwinLaw::rolloff] = 0.2 * (shift.first - 0.5);
    if (!short_ends.empty()) {
      at[model.law().cutoff()] = chosen(short_ends, drawn.second)->parameters[model.law().cutoff()];
      moved[model.law().cutoff()] = 0.2 * (shift.second - 0.5);
    }
    at += moved;
    if (!model.law().table())
      at[TwinLaw::rolloff] = std::max(at[TwinLaw::rolloff], at[model.law().cutoff()] + margin);
    start.col(walker) = at.array().max(low).min(high);
  }
  return start;
}

template <class Function>
std::vector<double> of_draws(const std::vector<TwinDraw>& draws, const Function& function) {
  std::vector<double> values;
  for (const TwinDraw& draw : draws) values.push_back(function(draw));
  std::ranges::sort(values);
  return values;
}

double quantile(const std::vector<double>& sorted, double part) {
  if (sorted.empty()) return unknown;
  const double position = part * static_cast<double>(sorted.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(position), sorted.size() - 1);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

TwinParameter interval(const std::vector<double>& sorted, bool seen) {
  TwinParameter parameter;
  parameter.value = quantile(sorted, 0.5);
  parameter.low = quantile(sorted, 0.025);
  parameter.high = quantile(sorted, 0.975);
  parameter.seen = seen;
  return parameter;
}

std::vector<TwinDraw> draws_of(const Candidate& one, const Ends& ends, Index count,
                               std::uint64_t seed) {
  std::vector<TwinDraw> draws;
  if (count == 0) return draws;
  const Eigen::MatrixXd points =
      sampled_posterior(one.model, ensemble(one, ends, seed), count, seed);
  for (Index draw = 0; draw < count; ++draw)
    draws.push_back(spectrum_of(one.model, points.col(draw)));
  return draws;
}

TwinSpectrum band_of(const std::vector<TwinDraw>& draws, const TwinLaw& law, double lowest,
                     double highest) {
  constexpr int points = 80;
  TwinSpectrum band;
  for (int k = 0; k < points; ++k)
    band.wavenumber.push_back(lowest * std::pow(highest / lowest, k / (points - 1.0)));
  const LawPoints positions(law, band.wavenumber);
  std::vector<std::vector<double>> values(points);
  for (const TwinDraw& draw : draws) {
    for (std::size_t k = 0; k < points; ++k) {
      const double q = band.wavenumber[k];
      double density = 0;
      if (!law.table()) {
        density = draw.density(q);
      } else if (q <= 2 * pi / draw.short_cutoff) {
        const Eigen::Map<const Eigen::VectorXd> heights(draw.log_psd.data(),
                                                        static_cast<Index>(draw.log_psd.size()));
        density = std::exp(positions.basis.row(static_cast<Index>(k)).dot(heights));
      }
      values[k].push_back(density);
    }
  }
  for (std::vector<double>& at : values) {
    std::ranges::sort(at);
    band.psd.push_back(quantile(at, 0.5));
    band.low.push_back(quantile(at, 0.025));
    band.high.push_back(quantile(at, 0.975));
  }
  return band;
}

struct Curved {
  bool sees_rolloff = true, sees_cutoff = true;
  Spread hurst, rolloff, cutoff, height, slope;
};

/// Whether holding a parameter at `held_at` lowers 2 ln of the likelihood by more than
/// `seen_above`.
bool sees(const Candidate& one, Index parameter, double held_at) {
  Eigen::VectorXd held = one.fit.parameters;
  held[parameter] = held_at;
  return 2 * (minimised(one.model, held, {parameter}).cost - one.fit.cost) > seen_above;
}

/// Parameters of a self-affine fit with their deviations from the curvature of the likelihood: the
/// Hurst exponent, and the logarithms of all others.
Curved curved(const Candidate& one) {
  const TwinModel& model = one.model;
  const Index cutoff = model.law().cutoff();
  const Eigen::MatrixXd covariance = laplace_covariance(model, one.fit.parameters, {});
  const auto spread = [&](const auto& function) {
    return spread_of(model, one.fit.parameters, covariance, function);
  };
  return {sees(one, TwinLaw::rolloff, model.highest()[TwinLaw::rolloff] - 1e-3),
          sees(one, cutoff, model.lowest()[cutoff] + 1e-3),
          spread([](const TwinDraw& draw) { return draw.hurst; }),
          spread([](const TwinDraw& draw) { return std::log(draw.rolloff); }),
          spread([](const TwinDraw& draw) { return std::log(draw.short_cutoff); }),
          spread(log_height),
          spread([](const TwinDraw& draw) { return std::log(draw.rms_slope); })};
}

std::vector<TwinWithout> fits_without(const Candidate& all) {
  std::set<std::string> instruments;
  for (const TwinData& group : all.model.data()) instruments.insert(group.instrument);
  std::vector<TwinWithout> results;
  if (instruments.size() < 2) return results;
  const Curved whole = curved(all);
  for (const std::string& instrument : instruments) {
    std::vector<TwinData> rest;
    Index bins = 0;
    for (const TwinData& group : all.model.data())
      if (group.instrument != instrument) {
        rest.push_back(group);
        bins += static_cast<Index>(group.bins.size());
      }
    if (bins < 8) continue;
    TwinModel model(rest, all.model.law());
    Eigen::VectorXd start = Eigen::VectorXd::Zero(model.size());
    start.head(model.law().size()) = all.fit.parameters.head(model.law().size());
    TwinFit fit = refitted(model, start);
    const Candidate one{std::move(model), std::move(fit)};
    const Curved part = curved(one);
    TwinWithout without;
    without.instrument = instrument;
    without.misfit = one.misfit();
    const auto compare = [&](TwinParameter& to, const Spread& now, const Spread& before, bool seen,
                             bool logarithm) {
      const auto back = [&](double value) { return logarithm ? std::exp(value) : value; };
      to.seen = seen;
      to.value = back(now.value);
      to.low = back(now.value - 1.96 * now.deviation);
      to.high = back(now.value + 1.96 * now.deviation);
      // The scans without this instrument are part of all scans, so the variance of the difference
      // between the two fits is the difference of their variances.
      const double variance =
          std::max(now.deviation * now.deviation - before.deviation * before.deviation,
                   now.deviation * now.deviation / 4);
      const double moved = now.value - before.value;
      if (seen && moved * moved > 6.63 * variance) without.agrees = false;
    };
    const bool both_rolloff = part.sees_rolloff && whole.sees_rolloff,
               both_cutoff = part.sees_cutoff && whole.sees_cutoff;
    compare(without.hurst, part.hurst, whole.hurst, true, false);
    compare(without.rolloff, part.rolloff, whole.rolloff, both_rolloff, true);
    compare(without.short_cutoff, part.cutoff, whole.cutoff, both_cutoff, true);
    compare(without.rms_height, part.height, whole.height, both_rolloff, true);
    compare(without.rms_slope, part.slope, whole.slope, both_cutoff, true);
    results.push_back(without);
  }
  return results;
}

std::string length_text(double value) { return format_quantity(value, Dimension::length, 3); }

/// Builds a surface twin from scans, stage by stage.
class TwinRun {
 public:
  /// scans: with bins that are elliptic if a lay is found.
  TwinRun(const std::vector<ScanSpectrum>& scans, const TwinOptions& options, FoundLay found)
      : scans_(scans),
        options_(options),
        found_(std::move(found)),
        left_out_(found_.left_out),
        forms_(forms_of(data_of_all(), options.form)) {}

  SurfaceTwin run() {
    for (std::string& why : found_.notes) note(std::move(why));
    judge(1);
    find_heights();
    name_scans_left_out();
    if (options_.leave_one_out) leave_out_each();
    replace_by_table();
    describe_fit();
    widen();
    const Ends ends = ends_of(forms_.best);
    twin_.rolloff_ratio = ends.rolloff_ratio;
    twin_.cutoff_ratio = ends.cutoff_ratio;
    draw(ends);
    set_band(ends);
    set_lay();
    set_heights();
    set_parameters(ends);
    return std::move(twin_);
  }

 private:
  std::vector<TwinData> data_of_all() {
    std::vector<TwinData> data = grouped(scans_, left_out_, found_.lay, responses_);
    std::size_t bins = 0;
    for (const TwinData& group : data) bins += group.bins.size();
    if (skew_) allow_skew_heights(scans_, data);
    require(bins >= 8, "scans", bins,
            "bins of wavelengths are usable, which is too few; give larger scans or finer tips");
    return data;
  }

  void note(std::string text) { twin_.warnings.push_back(std::move(text)); }

  void judge(double tolerance) {
    twin_.scans = judged_scans(scans_, forms_.best, tolerance, left_out_);
    if (!options_.drop_bad_scans) left_out_ = found_.left_out;
    if (left_out_ == found_.left_out) return;
    forms_ = forms_of(data_of_all(), options_.form);
    // The remaining scans are judged anew by the fit without the bad scans.
    std::vector<bool> final = left_out_;
    std::vector<TwinScan> judged = judged_scans(scans_, forms_.best, tolerance, final);
    for (std::size_t scan = 0; scan < scans_.size(); ++scan)
      if (left_out_[scan])
        twin_.scans[scan].left_out = true;
      else
        twin_.scans[scan] = judged[scan];
  }

  void name_scans_left_out() {
    for (std::size_t scan = 0; scan < scans_.size(); ++scan)
      if (left_out_[scan] && !found_.left_out[scan])
        note("scan " + (scans_[scan].name.empty() ? std::to_string(scan + 1) : scans_[scan].name) +
             " is left out: its spectrum is far from that of the others");
  }

  void leave_out_each() {
    twin_.without = fits_without(forms_.best);
    for (TwinWithout& without : twin_.without) {
      for (TwinParameter* length : {&without.rolloff, &without.short_cutoff})
        scale(*length, across(1));
      scale(without.rms_slope, slope_factor(found_.lay.stretch));
      if (!without.agrees)
        note("without " + without.instrument +
             " the parameters change by more than chance: the description of one instrument is "
             "wrong");
    }
  }

  static void scale(TwinParameter& parameter, double factor) {
    for (double* number : {&parameter.value, &parameter.low, &parameter.high}) *number *= factor;
  }

  /// The wavelength across the lay of a wavelength of elliptic waves, in which the fit is made.
  double across(double elliptic) const {
    return found_.lay.stretch == 1 ? elliptic : elliptic / std::sqrt(found_.lay.stretch);
  }

  /// rms slope over that of the isotropic surface with the same elliptic spectrum: the slopes across
  /// and along the lay grow by √s and 1/√s.
  static double slope_factor(double stretch) {
    return stretch == 1 ? 1 : std::sqrt((stretch + 1 / stretch) / 2);
  }

  void replace_by_table() {
    const double misfit = forms_.best.misfit();
    const bool asked = options_.form == SpectrumForm::table;
    // Scans of skew heights scatter more about their mean spectrum.
    const double limit = (skew_ ? 2 : 1) * SurfaceTwin::refused_above;
    if (!asked && (options_.form || !(misfit > limit))) return;
    // A tabulated spectrum has no roll-off of its own, so the self-affine law decides whether the
    // scans contain a plateau.
    plateau_ =
        sees(forms_.best, TwinLaw::rolloff, forms_.best.model.highest()[TwinLaw::rolloff] - 1e-3);
    Candidate table = table_near(forms_.best);
    const bool better = asked || table.misfit() < 0.8 * misfit;
    if (!asked)
      note(std::string(
               "no self-affine spectrum, with a corner or a smooth roll-off, fits the scans: ") +
           (better ? "a table is fitted"
                   : "no other spectrum fits them either, so they contradict each other, and "
                     "intervals are too narrow"));
    if (better) forms_ = {std::move(table), {}, 0};
  }

  void describe_fit() {
    const Candidate& best = forms_.best;
    const TwinModel& model = best.model;
    twin_.form = model.law().form;
    twin_.form_ratio = forms_.ratio;
    twin_.bins = model.bins();
    twin_.misfit = best.misfit();
    for (std::size_t group = 0; group < model.data().size(); ++group) {
      const TwinData& data = model.data()[group];
      const TwinModel::Misfit of_law = model.misfit(best.fit.parameters, group);
      twin_.chi_square += of_law.deviance;
      twin_.groups.push_back({data.instrument, static_cast<Index>(data.scans.size()),
                              across(2 * pi / data.wavenumber.back()),
                              across(2 * pi / data.wavenumber.front()),
                              static_cast<Index>(data.bins.size()),
                              model.gain(best.fit.parameters, group), of_law.ratio()});
      if (data.tip_limit > 0)
        note(data.instrument + ": waves below " + length_text(across(2 * pi / data.tip_limit)) +
             " are left out, because the tip does not follow them");
    }
  }

  /// Skew heights modulate their short waves, so that powers of neighbouring wavelengths scatter
  /// together, and more than those of Gaussian heights: by the misfit, which the limits follow.
  void widen() {
    const double scatter = forms_.best.misfit();
    if (!skew_ || !(scatter > 1)) return;
    const auto refit = [scatter](Candidate& one) {
      one.model.set_scatter(scatter);
      one.fit = minimised(one.model, one.fit.parameters);
    };
    refit(forms_.best);
    if (!forms_.other) return;
    refit(*forms_.other);
    forms_.ratio = std::max(0.0, 2 * (forms_.other->fit.cost - forms_.best.fit.cost));
  }

  /// Draws parameters from the posterior. If the corner and the smooth form are nearly equally
  /// likely, the draws come from both.
  void draw(const Ends& ends) {
    const double odds = std::exp(-forms_.ratio / 2);
    const bool undecided = forms_.other && ends.sees_rolloff() && forms_.ratio < seen_above;
    const Index of_other = undecided ? static_cast<Index>(std::lround(
                                           static_cast<double>(options_.draws) * odds / (1 + odds)))
                                     : 0;
    twin_.draws = draws_of(forms_.best, ends, options_.draws - of_other, options_.seed);
    if (of_other == 0) return;
    note(
        "a corner and a smooth roll-off are nearly equally likely: draws and intervals include "
        "both");
    std::vector<TwinDraw> others = draws_of(*forms_.other, ends_of(*forms_.other),
                                            std::max<Index>(of_other, 1), options_.seed + 1);
    std::ranges::move(others, std::back_inserter(twin_.draws));
  }

  /// Finds skewness and kurtosis, if the spectrum says how much of the heights the scans show. Skew
  /// heights have waves beyond the cut-off, the sums of shorter and longer waves, so that the
  /// spectrum is fitted once more with such a tail. Places of such a surface differ more.
  void find_heights() {
    const Candidate& best = forms_.best;
    if (best.model.law().table() ||
        !sees(best, TwinLaw::rolloff, best.model.highest()[TwinLaw::rolloff] - 1e-3)) {
      for (std::size_t scan = 0; scan < scans_.size(); ++scan) {
        const std::vector<double>& moments = scans_[scan].height_moments;
        const double skewness = moments.empty() ? 0 : moments[1] / std::pow(moments[0], 1.5);
        if (!(std::abs(skewness) > 1)) continue;
        note(
            "the scans do not show the roll-off, so that the skewness of the surface is unknown; "
            "its heights count as Gaussian, although those of a scan have the skewness " +
            format_quantity(skewness, Dimension::dimensionless, 2));
        break;
      }
      return;
    }
    TwinDraw law = spectrum_of(best.model, best.fit.parameters);
    stretch(law, found_.lay.stretch);
    heights_ = heights_of(scans_, left_out_, tabulated(law, 2 * pi / (20 * law.rolloff)),
                          found_.lay, options_.draws, options_.seed);
    if (heights_.gaussian) return;
    skew_ = true;
    left_out_ = found_.left_out;
    forms_ = forms_of(data_of_all(), options_.form);
    judge(2);
  }

  void set_heights() {
    const FoundHeights& heights = heights_;
    if (heights.draws.empty()) return;
    const auto limits = [&](double HeightShape::*number, double gaussian) {
      std::vector<double> values;
      for (const HeightShape& draw : heights.draws) values.push_back(draw.*number);
      std::ranges::sort(values);
      TwinParameter parameter = interval(values, !heights.gaussian);
      if (!heights.gaussian) return parameter;
      parameter.value = gaussian;
      parameter.low = std::min(parameter.low, gaussian);
      parameter.high = std::max(parameter.high, gaussian);
      return parameter;
    };
    twin_.skewness = limits(&HeightShape::skewness, 0);
    twin_.kurtosis = limits(&HeightShape::kurtosis, 3);
    if (heights.gaussian) return;
    for (std::size_t k = 0; k < twin_.draws.size(); ++k) {
      twin_.draws[k].skewness = heights.draws[k].skewness;
      twin_.draws[k].kurtosis = heights.draws[k].kurtosis;
    }
  }

  std::vector<double> sorted(double TwinDraw::*number) const {
    return of_draws(twin_.draws, [number](const TwinDraw& draw) { return draw.*number; });
  }

  void set_parameters(const Ends& ends) {
    const TwinModel& model = forms_.best.model;
    twin_.rms_height = interval(sorted(&TwinDraw::rms_height), true);
    twin_.rms_slope = interval(sorted(&TwinDraw::rms_slope), ends.sees_cutoff());
    set_cutoff(ends, sorted(&TwinDraw::short_cutoff));
    if (model.law().table())
      set_heights_of_table();
    else
      set_rolloff(ends);
    allow_unseen_lay();
  }

  /// The spectrum across the lay, from the draws in elliptic waves.
  void set_band(const Ends& ends) {
    const TwinModel& model = forms_.best.model;
    double end = model.finest_wavenumber();
    if (ends.sees_cutoff())
      end = std::max(end, 2 * pi / quantile(sorted(&TwinDraw::short_cutoff), 0.5));
    twin_.spectrum = band_of(twin_.draws, model.law(), 2 * pi / model.max_scan(), end);
    if (found_.lay.stretch != 1)
      for (double& q : twin_.spectrum.wavenumber) q *= std::sqrt(found_.lay.stretch);
  }

  /// Turns the law of elliptic waves into that across the lay.
  static void stretch(TwinDraw& draw, double stretch) {
    if (stretch == 1) return;
    const double root = std::sqrt(stretch);
    draw.rolloff /= root;
    draw.short_cutoff /= root;
    draw.reference *= root;
    for (double& knot : draw.knots) knot *= root;
    draw.rms_slope *= slope_factor(stretch);
  }

  /// Gives each draw a lay. In elliptic waves, whose area is that of the true ones, the lay is
  /// independent of the law, to first order.
  void set_lay() {
    const Lay& lay = found_.lay;
    if (lay.stretch == 1) {
      twin_.stretch.value = twin_.stretch.low = 1;
      twin_.stretch.high = found_.greatest_stretch;
      if (found_.greatest_stretch > 1.5)
        note("a lay of up to " +
             format_quantity(found_.greatest_stretch, Dimension::dimensionless, 2) +
             " to 1 is possible, for which the limits have room; give larger maps");
      return;
    }
    std::vector<double> turns;
    for (std::size_t k = 0; k < twin_.draws.size(); ++k) {
      TwinDraw& draw = twin_.draws[k];
      const RandomPair normal = gaussian_pair(options_.seed, static_cast<std::int32_t>(k), 0, 114);
      draw.stretch = std::max(1.0, lay.stretch * std::exp(found_.log_stretch_error * normal.first));
      turns.push_back(found_.angle_error * normal.second);
      draw.lay_angle = std::fmod(lay.angle + turns.back() + 2 * pi, pi);
      stretch(draw, draw.stretch);
    }
    twin_.stretch = interval(sorted(&TwinDraw::stretch), true);
    std::ranges::sort(turns);
    twin_.lay_angle = interval(turns, true);
    for (double* angle : {&twin_.lay_angle.value, &twin_.lay_angle.low, &twin_.lay_angle.high})
      *angle += lay.angle;
  }

  /// Room in the limits for a lay that the scans do not show but allow.
  void allow_unseen_lay() {
    const double stretch = found_.greatest_stretch;
    if (found_.lay.stretch != 1 || !(stretch > 1) || !std::isfinite(stretch)) return;
    const double root = std::sqrt(stretch);
    twin_.rolloff.low /= root;
    twin_.short_cutoff.low /= root;
    twin_.rolloff_along.high *= root;
    twin_.rms_slope.high *= slope_factor(stretch);
  }

  void set_cutoff(const Ends& ends, const std::vector<double>& cutoffs) {
    if (ends.sees_cutoff()) {
      twin_.short_cutoff = interval(cutoffs, true);
      // An ellipse whose ln of the stretch is off by δ smears the end of the spectrum over e^{±δ/2},
      // and the fit finds the shorter waves of it: with 95 % for δ, half of two standard errors.
      twin_.short_cutoff.high *= std::exp(found_.log_stretch_error);
      return;
    }
    const TwinModel& model = forms_.best.model;
    twin_.short_cutoff.high = across(std::exp(ends.cutoffs->limit(forms_.best.fit.cost, one_sided)
                                                  .value_or(ends.cutoffs->values.front())));
    note("the scans do not resolve the short cut-off: it lies below " +
         length_text(twin_.short_cutoff.high) +
         "; the upper limit of the rms slope follows from its prior, from " +
         length_text(across(std::exp(model.lowest()[model.law().cutoff()]))) + " on");
  }

  void set_heights_of_table() {
    note("rms height and slope include only waves below " +
         length_text(across(forms_.best.model.max_scan())));
    if (plateau_) return;
    twin_.rms_height = {};
    twin_.rms_height.low = quantile(sorted(&TwinDraw::rms_height), 0.05);
    note("they show no roll-off, so only a lower limit of the rms height is known");
  }

  void set_rolloff(const Ends& ends) {
    twin_.hurst = interval(sorted(&TwinDraw::hurst), true);
    if (ends.sees_rolloff()) {
      twin_.rolloff = interval(sorted(&TwinDraw::rolloff), true);
      twin_.rolloff_along = interval(
          of_draws(twin_.draws, [](const TwinDraw& draw) { return draw.rolloff_along(); }), true);
      return;
    }
    twin_.rolloff.low = across(std::exp(ends.rolloffs->limit(forms_.best.fit.cost, one_sided)
                                            .value_or(ends.rolloffs->values.front())));
    twin_.rolloff_along.low = found_.lay.stretch * twin_.rolloff.low;
    twin_.rms_height = {};
    twin_.rms_height.low = min_height(forms_.best, *ends.rolloffs);
    note("the scans do not show the roll-off: it lies beyond " + length_text(twin_.rolloff.low) +
         "; only a lower limit of the rms height is known");
  }

  const std::vector<ScanSpectrum>& scans_;
  const TwinOptions& options_;
  FoundLay found_;
  FoundHeights heights_;
  bool skew_ = false;  ///< whether the heights are not Gaussian
  std::vector<bool> left_out_;
  Responses responses_;
  Forms forms_;
  SurfaceTwin twin_;
  bool plateau_ = true;  ///< whether the scans contain a plateau; used if a table is fitted
};

SurfaceTwin twin_of(const std::vector<ScanSpectrum>& scans, const TwinOptions& options) {
  require_that(!scans.empty(), "scans", "none given; give at least one");
  require(options.draws >= 100, "draws", options.draws, "must be >= 100");
  FoundLay found = lay_of(scans);
  if (found.lay.stretch == 1) return TwinRun(scans, options, std::move(found)).run();
  std::vector<ScanSpectrum> elliptic;
  for (const ScanSpectrum& scan : scans)
    elliptic.push_back(scan.profile() ? scan : with_lay(scan, found.lay));
  return TwinRun(elliptic, options, std::move(found)).run();
}

}  // namespace
}  // namespace twin_detail

const TwinDraw& SurfaceTwin::draw(std::uint64_t seed) const {
  require_that(!draws.empty(), "draws", "are missing");
  const double part = uniform_pair(seed, 0, 0, 113).first;
  return draws[std::min(draws.size() - 1,
                        static_cast<std::size_t>(part * static_cast<double>(draws.size())))];
}

SurfaceTwin fit_twin(const std::vector<ScanSpectrum>& scans, const TwinOptions& options) {
  return twin_detail::twin_of(scans, options);
}

}  // namespace salebra
