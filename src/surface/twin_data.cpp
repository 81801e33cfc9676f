// SPDX-License-Identifier: GPL-3.0-or-later
// Groups of scans, and the bins of each group that a surface twin uses.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/twin_model.hpp"

namespace salebra::twin_detail {
namespace {

using std::numbers::pi;

/// Product of tip radius and rms curvature up to which a tip follows a surface to a few per cent.
constexpr double tip_limit = 0.08;
constexpr double tip_error = 0.06;  ///< relative error of the powers at tip_limit
/// Standard deviations of ln of the noise, if it is stated and if it is found from the data.
constexpr double known_noise = 0.5, found_noise = 1.5;

/// Number of independent modes per mode, from simulations: neighbouring modes of a bin are
/// correlated. It is 0.55 with the sine tapers and 0.25 with the Hann window for a map, and the
/// square root of these numbers for a profile.
double independent(bool tapered, bool profile) {
  const double share = tapered ? 0.55 : 0.25;
  return profile ? std::sqrt(share) : share;
}

std::string instrument_name(const ScanInstrument& instrument) {
  if (!instrument.name.empty()) return instrument.name;
  std::string name(name_of(instrument.kind));
  if (instrument.kind == Instrument::optical)
    name += " " + format_quantity(instrument.resolution, Dimension::length);
  if (instrument.has_tip()) name += " " + format_quantity(instrument.tip_radius, Dimension::length);
  return name;
}

bool alike(const ScanSpectrum& a, const ScanSpectrum& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  const ScanInstrument &s = a.instrument, &t = b.instrument;
  return a.grid == b.grid && s.kind == t.kind && s.resolution == t.resolution &&
         s.tip_radius == t.tip_radius && same(s.noise, t.noise) && s.drifts() == t.drifts() &&
         s.height_calibration == t.height_calibration && s.scan_calibration == t.scan_calibration &&
         s.name == t.name;
}

/// Sums for the scatter of the heights of the scans of a group about their mean, from the
/// logarithms of their powers above the noise.
struct ScanScatter {
  double squares = 0, freedom = 0;

  void add(const std::vector<ScanSpectrum>& scans, const TwinData& group) {
    constexpr double above_noise = 3;
    if (group.scans.size() < 2) return;
    double modes = 0, sum = 0, square = 0;
    const auto used = [&](std::size_t k) {
      return group.bins[k] >= 2 && group.psd[k] > above_noise * group.noise;
    };
    for (std::size_t k = 0; k < group.bins.size(); ++k)
      if (used(k)) modes += group.modes[k];
    if (modes == 0) return;
    const auto count = static_cast<double>(group.scans.size());
    for (const std::size_t scan : group.scans) {
      double logarithm = 0;
      for (std::size_t k = 0; k < group.bins.size(); ++k)
        if (used(k) && scans[scan].psd[group.bins[k]] > 0)
          logarithm +=
              group.modes[k] / modes * std::log(scans[scan].psd[group.bins[k]] / group.psd[k]) / 2;
      sum += logarithm;
      square += logarithm * logarithm;
    }
    // Subtract the random scatter of the powers, which does not come from the heights of the scans;
    // `modes` counts the independent modes of all scans.
    squares += square - sum * sum / count - (count - 1) * count / (4 * modes);
    freedom += count - 1;
  }

  /// Standard error of the gain (the factor of the heights) of a scan from this scatter,
  /// overestimated if there are few scans.
  double error() const {
    return freedom < 2
               ? 0
               : std::sqrt(std::max(0.0, squares / freedom * (freedom + 1) / (freedom - 1)));
  }
};

/// Power that a Hann window leaks into each bin from waves more than six modes longer, which the
/// response of the bins above κ = 36 does not include. Along an axis, a wave d modes away leaks the
/// fraction (2/3)(1/2)(πd³)⁻² of its power, and all waves beyond d modes leak 0.007 d⁻⁵. The mean
/// over directions is smaller than this, by a factor of fifteen beyond a sharp cut-off. Elliptic
/// modes are closest along the lay, by the root of its stretch.
std::vector<double> leakage(const std::vector<double>& limits, const std::vector<double>& psd,
                            const std::vector<Index>& modes, const Lay& lay) {
  constexpr double share = 0.007, modelled = 6;
  const auto beyond = [=](double distance) {
    return share / std::pow(std::max(distance / std::sqrt(lay.stretch), +modelled), 5);
  };
  std::vector<double> leaked(psd.size());
  for (std::size_t bin = response_bins(limits); bin < psd.size(); ++bin)
    for (std::size_t from = 0; from < bin; ++from)
      if (modes[from] > 0)
        leaked[bin] += psd[from] * (beyond(limits[bin] - limits[from + 1]) -
                                    beyond(limits[bin] - limits[from]));
  return leaked;
}

/// Whether a bin of a scan has enough modes to be used in the fit.
bool enough(const ScanSpectrum& scan, std::size_t bin) {
  return scan.modes[bin] >= (scan.profile() ? 2 : 4);
}

/// The data of a group that follow from its instrument.
TwinData of_instrument(const ScanInstrument& instrument) {
  TwinData data;
  data.instrument = instrument_name(instrument);
  data.height_calibration = instrument.height_calibration;
  data.scan_calibration = instrument.scan_calibration;
  data.blur = instrument.kind == Instrument::optical
                  ? instrument.resolution / std::sqrt(8 * std::numbers::ln2)
                  : 0;
  data.tip = data.tail = instrument.has_tip();
  return data;
}

/// Weighted mean of the spectra of several scans.
struct MeanSpectrum {
  std::vector<double> psd;
  double weight = 0, squares = 0;

  void add(const ScanSpectrum& scan) {
    weight += scan.weight;
    squares += scan.weight * scan.weight;
    psd.resize(scan.psd.size());
    for (std::size_t bin = 0; bin < psd.size(); ++bin) psd[bin] += scan.weight * scan.psd[bin];
  }
  void divide() {
    for (double& power : psd) power /= weight;
  }
};

/// Sets the noise of a group, and raises the powers to at least their leakage and rounding error.
void set_noise(const ScanSpectrum& first, const std::vector<double>& leaked,
               std::vector<double>& psd, TwinData& data) {
  const double stated = first.instrument.noise;
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (std::size_t bin = 0; bin < psd.size(); ++bin)
    if (enough(first, bin)) {
      greatest = std::max(greatest, psd[bin]);
      if (bin >= psd.size() * 2 / 3) least = std::min(least, psd[bin]);
    }
  if (std::isnan(stated)) {
    data.noise = least / 2;
    data.noise_freedom = found_noise;
  } else {
    data.noise =
        stated * stated *
        (first.profile() ? first.grid.dx() / (2 * pi) : first.grid.cell_area() / (4 * pi * pi));
    data.noise_freedom = known_noise;
  }
  // Without any noise, power in a bin beyond the cut-off would be impossible; rounding provides
  // some.
  constexpr double rounded = 1e-15;
  data.noise = std::max(data.noise, rounded * greatest);
  for (std::size_t bin = 0; bin < psd.size(); ++bin)
    psd[bin] = std::max({psd[bin], leaked[bin], rounded * greatest});
}

void set_cells(const ScanModes& modes, const Response& response, TwinData& data) {
  for (std::size_t cell = 0; cell < response.middle.size(); ++cell) {
    const double high = std::log(modes.wavenumber(response.limits[cell + 1]));
    data.cell_low.push_back(cell == 0 ? high - std::log(1.15) / 3
                                      : std::log(modes.wavenumber(response.limits[cell])));
    data.cell_high.push_back(high);
    data.cell_wavenumber.push_back(modes.wavenumber(response.middle[cell]));
    for (const std::size_t bin : data.bins) data.weights.push_back(response.weight(cell, bin));
  }
}

TwinData group_of(const std::vector<ScanSpectrum>& scans, std::vector<std::size_t> members,
                  const Lay& lay, Responses& responses) {
  const ScanSpectrum& first = scans[members.front()];
  const ScanInstrument& instrument = first.instrument;
  const bool line = first.profile();
  const ScanModes modes(first.grid, lay);
  const std::vector<double> limits = bin_limits(modes.nyquist);
  const std::size_t bins = limits.size() - 1, tapered = tapered_bins(limits);

  TwinData data = of_instrument(instrument);
  data.tail_reference = modes.wavenumber(modes.nyquist / 4);
  MeanSpectrum mean;
  for (const std::size_t member : members) mean.add(scans[member]);
  mean.divide();
  data.mean_scans = mean.weight * mean.weight / mean.squares;
  data.scans = std::move(members);
  std::vector<double>& psd = mean.psd;
  const std::vector<double> leaked = leakage(limits, psd, first.modes, lay);
  set_noise(first, leaked, psd, data);

  double curvature = 0;  // κ_rms², mean square curvature, across the lay
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const double a = modes.wavenumber(limits[bin]), b = modes.wavenumber(limits[bin + 1]);
    const double q = first.wavenumber[bin], excess = std::max(psd[bin] - data.noise, 0.0);
    curvature += (line ? 2 * (b - a) : 3.0 / 8 * pi * (b * b - a * a)) * q * q * q * q * excess *
                 (lay.stretch * lay.stretch);
    if (data.tip && instrument.tip_radius * std::sqrt(curvature) > tip_limit) {
      data.tip_limit = a;
      break;
    }
    if (!enough(first, bin)) continue;
    data.bins.push_back(bin);
    data.leaked.push_back(leaked[bin]);
    data.psd_error.push_back(std::hypot(
        leaked[bin] / psd[bin],
        data.tip ? tip_error / tip_limit * instrument.tip_radius * std::sqrt(curvature) : 0));
    data.wavenumber.push_back(q);
    data.psd.push_back(psd[bin]);
    const bool by_tapers = bin < tapered;
    const double lowest_bins = bin < 2 ? 0.7 : 1;
    data.modes.push_back(std::max(0.1, lowest_bins * independent(by_tapers, line) *
                                           static_cast<double>(first.modes[bin]) / 2 *
                                           mean.weight));
    // The number of independent modes accounts for the correlation between bins; within a single
    // narrow bin the scatter is smaller by this factor.
    data.scatter.push_back(by_tapers ? 0.35 : 0.75);
  }

  data.lay = lay;
  set_cells(modes, responses.of(first.grid, instrument.drifts() && !line, lay), data);
  return data;
}

}  // namespace

const Response& Responses::of(const Grid2D& grid, bool drifts, const Lay& lay) {
  const std::tuple key(grid.nx, grid.ny, grid.ny == 1 ? 0 : grid.lx / grid.ly, drifts);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  return known_.emplace(key, response_of(grid, drifts, lay)).first->second;
}

std::vector<std::vector<std::size_t>> members_of(const std::vector<ScanSpectrum>& scans,
                                                 const std::vector<bool>& left_out) {
  std::vector<std::vector<std::size_t>> members;
  for (std::size_t scan = 0; scan < scans.size(); ++scan) {
    if (left_out[scan]) continue;
    const auto group = std::ranges::find_if(members, [&](const std::vector<std::size_t>& some) {
      return alike(scans[some.front()], scans[scan]);
    });
    if (group == members.end())
      members.push_back({scan});
    else
      group->push_back(scan);
  }
  return members;
}

std::vector<TwinData> grouped(const std::vector<ScanSpectrum>& scans,
                              const std::vector<bool>& left_out, const Lay& lay,
                              Responses& responses) {
  std::vector<TwinData> data;
  for (std::vector<std::size_t>& group : members_of(scans, left_out)) {
    TwinData one = group_of(scans, std::move(group), lay, responses);
    if (!one.bins.empty()) data.push_back(std::move(one));
  }
  // Scans of different parts of a surface may differ by more than their calibration error, e.g. if
  // the heights are not Gaussian.
  ScanScatter scatter;
  for (const TwinData& group : data) scatter.add(scans, group);
  for (TwinData& group : data)
    group.scan_calibration = std::max(group.scan_calibration, scatter.error());
  return data;
}

void allow_skew_heights(const std::vector<ScanSpectrum>& scans, std::vector<TwinData>& data) {
  for (TwinData& group : data) {
    group.tail = true;
    ScanScatter scatter;
    scatter.add(scans, group);
    group.scan_calibration = std::max(group.scan_calibration, scatter.error());
  }
}

}  // namespace salebra::twin_detail
