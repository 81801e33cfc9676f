// SPDX-License-Identifier: GPL-3.0-or-later
// Skewness and kurtosis of a surface twin, from the moments of the heights of its largest scans.
#include "surface/twin_heights.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/generators/non_gaussian.hpp>

#include "base/fft.hpp"
#include "base/random.hpp"
#include "surface/significance.hpp"
#include "surface/twin_model.hpp"

namespace salebra::twin_detail {
namespace {

using std::numbers::pi;

constexpr Index cells = 48;            ///< of a patch, along each side
constexpr Index patches_per_side = 4;  ///< of the periodic box from which they are cut
constexpr int boxes = 16;
constexpr Index resamples = 1000;
constexpr double least_share = 0.5;  ///< of the side of the largest scan, of a group that is used

/// Means of the third and fourth powers of levelled heights over those powers of their rms.
struct Moments {
  double third = 0, fourth = 3;
};

/// Sums of the second, third and fourth moments over patches.
struct Sums {
  double second = 0, third = 0, fourth = 0;

  void add(const Sums& other) {
    second += other.second;
    third += other.third;
    fourth += other.fourth;
  }
  Moments moments(double count) const {
    const double variance = second / count;
    return {third / count / std::pow(variance, 1.5), fourth / count / (variance * variance)};
  }
};

/// Johnson's transform of a normal variable, tabulated; Gaussian heights have none. A lens shows the
/// mean of the transform over the waves that it does not resolve, which have the share `removed` of
/// the variance.
class Transform {
 public:
  Transform(const HeightShape& shape, double removed) {
    if (shape.skewness == 0 && shape.kurtosis == 3) return;
    const HeightDistribution heights = johnson_heights(shape.skewness, shape.kurtosis);
    double weights = 0, mean = 0, square = 0;
    for (int k = 0; k <= 2 * half; ++k) {
      const double z = (k - half) * step;
      values_.push_back(heights.quantile(std::erfc(-z / std::numbers::sqrt2) / 2));
      const double weight = std::exp(-z * z / 2);
      weights += weight;
      mean += weight * values_.back();
      square += weight * values_.back() * values_.back();
    }
    mean /= weights;
    const double deviation = std::sqrt(square / weights - mean * mean);
    for (double& value : values_) value = (value - mean) / deviation;
    if (!(removed > 1e-3)) return;
    const double scale = std::sqrt(removed);
    std::vector<double> means;
    for (int k = 0; k <= 2 * half; ++k) {
      double sum = 0, all = 0;
      for (double x = -4; x < 4.01; x += 0.25) {
        const double weight = std::exp(-x * x / 2);
        sum += weight * (*this)((k - half) * step + scale * x);
        all += weight;
      }
      means.push_back(sum / all);
    }
    values_ = std::move(means);
  }

  double operator()(double z) const {
    if (values_.empty()) return z;
    const double position = std::clamp(z / step + half, 0.0, 2.0 * half - 1e-9);
    const auto below = static_cast<std::size_t>(position);
    return values_[below] +
           (position - static_cast<double>(below)) * (values_[below + 1] - values_[below]);
  }

 private:
  static constexpr int half = 300;
  static constexpr double step = 0.02;
  std::vector<double> values_;
};

/// Gaussian fields of the spectrum on periodic boxes, with the variance of all waves.
class Boxes {
 public:
  /// blur: standard deviation of the blur of a lens, m.
  Boxes(const Grid2D& scan, const SpectrumTable& spectrum, const Lay& lay, double blur,
        std::uint64_t seed) {
    constexpr Index points = cells * patches_per_side, columns = points / 2 + 1;
    const double step_x = 2 * pi / (patches_per_side * scan.lx),
                 step_y = 2 * pi / (patches_per_side * scan.ly);
    Field power(points, columns);
    std::vector<double> logarithms;
    for (const double q : spectrum.wavenumber) logarithms.push_back(std::log(q));
    const auto density = [&](double qx, double qy) {
      const Lay::Vector u = lay.elliptic(qx, qy);
      const double q = std::sqrt(lay.stretch) * std::hypot(u.across, u.along);
      if (q > spectrum.wavenumber.back()) return 0.0;
      const double position = std::log(std::max(q, spectrum.wavenumber.front()));
      const auto above = std::clamp<std::ptrdiff_t>(
          std::ranges::upper_bound(logarithms, position) - logarithms.begin(), 1,
          std::ssize(logarithms) - 1);
      const auto at = static_cast<std::size_t>(above);
      const double part = (position - logarithms[at - 1]) / (logarithms[at] - logarithms[at - 1]);
      return spectrum.psd[at - 1] * std::pow(spectrum.psd[at] / spectrum.psd[at - 1], part) *
             std::exp(-blur * blur * (qx * qx + qy * qy));
    };
    double on_lattice = 0;
    for (Index i = 0; i < points; ++i)
      for (Index j = 0; j < columns; ++j) {
        const double kx = static_cast<double>(2 * i <= points ? i : i - points),
                     ky = static_cast<double>(j);
        // The spectrum varies within the cells of the longest waves.
        const int split = std::hypot(kx, ky) < 5 ? 9 : 1;
        double sum = 0;
        for (int a = 0; a < split; ++a)
          for (int b = 0; b < split; ++b)
            sum += density((kx + (a + 0.5) / split - 0.5) * step_x,
                           (ky + (b + 0.5) / split - 0.5) * step_y);
        power(i, j) = sum / (split * split);
        on_lattice += (j == 0 || 2 * j == points ? 1 : 2) * power(i, j);
      }
    // Points sample all waves, also those between them, whose power is folded.
    const double plateau =
        pi * spectrum.wavenumber.front() * spectrum.wavenumber.front() * spectrum.psd.front();
    double all = plateau, sharp = plateau;  // ∫C d²q with and without the blur
    for (std::size_t k = 1; k < spectrum.wavenumber.size(); ++k) {
      const double a = spectrum.wavenumber[k - 1], b = spectrum.wavenumber[k];
      const double part = pi * (b - a) * (a * spectrum.psd[k - 1] + b * spectrum.psd[k]);
      sharp += part;
      all += part * std::exp(lay.log_blur(blur * blur, a * b / lay.stretch));
    }
    removed_ = 1 - all / sharp;
    const double cell = lay.stretch * step_x * step_y;
    const double folded = std::max(0.0, all / cell - on_lattice) / (points * points);
    power = (power + folded) / std::max(sharp / cell, on_lattice);
    RealFft2D<double> transform(points, points);
    std::vector<std::complex<double>> modes(static_cast<std::size_t>(points * columns));
    for (int box = 0; box < boxes; ++box) {
      Field& field = fields_.emplace_back(points, points);
      for (Index i = 0; i < points; ++i)
        for (Index j = 0; j < columns; ++j) {
          const RandomPair normal =
              gaussian_pair(seed, static_cast<std::int32_t>(i),
                            static_cast<std::int32_t>(j + box * columns), 115);
          modes[static_cast<std::size_t>(i * columns + j)] =
              std::sqrt(power(i, j) / 2) * std::complex<double>(normal.first, normal.second);
        }
      for (const Index j : {Index{0}, points / 2}) {
        for (Index i = 1; i < points / 2; ++i)
          modes[static_cast<std::size_t>((points - i) * columns + j)] =
              std::conj(modes[static_cast<std::size_t>(i * columns + j)]);
        for (const Index i : {Index{0}, points / 2}) {
          auto& mode = modes[static_cast<std::size_t>(i * columns + j)];
          mode = std::numbers::sqrt2 * mode.real();
        }
      }
      transform.backward(modes.data(), field.data());
    }
  }

  /// Moments of the levelled patches of the transformed fields.
  std::vector<Sums> patches(const HeightShape& shape) const {
    const Transform transform(shape, removed_);
    std::vector<Sums> all;
    Field patch(cells, cells);
    const Eigen::ArrayXd place =
        Eigen::ArrayXd::LinSpaced(cells, -0.5 * (cells - 1), 0.5 * (cells - 1));
    const double square = place.square().sum() * static_cast<double>(cells);
    for (const Field& field : fields_)
      for (Index a = 0; a < patches_per_side; ++a)
        for (Index b = 0; b < patches_per_side; ++b) {
          double mean = 0, along_x = 0, along_y = 0;
          for (Index i = 0; i < cells; ++i)
            for (Index j = 0; j < cells; ++j) {
              const double height = transform(field(a * cells + i, b * cells + j));
              patch(i, j) = height;
              mean += height;
              along_x += height * place[i];
              along_y += height * place[j];
            }
          mean /= static_cast<double>(cells * cells);
          along_x /= square;
          along_y /= square;
          Sums sums;
          for (Index i = 0; i < cells; ++i)
            for (Index j = 0; j < cells; ++j) {
              const double height = patch(i, j) - mean - along_x * place[i] - along_y * place[j];
              sums.second += height * height;
              sums.third += height * height * height;
              sums.fourth += height * height * height * height;
            }
          const double points = static_cast<double>(cells * cells);
          all.push_back({sums.second / points, sums.third / points, sums.fourth / points});
        }
    return all;
  }

 private:
  std::vector<Field> fields_;
  double removed_ = 0;  ///< share of the variance that the blur removes
};

/// One group of scans: what it shows, and boxes to simulate it.
struct Group {
  Index scans;
  double weight;
  Boxes boxes;
};

/// A distribution of moments: its mean, and samples.
struct Simulated {
  Moments mean;
  std::vector<Moments> samples;
};

Simulated simulated(const std::vector<Group>& groups, const HeightShape& shape,
                    std::uint64_t seed) {
  Simulated result{{0, 0}, std::vector<Moments>(resamples, Moments{0, 0})};
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Group& group = groups[g];
    const std::vector<Sums> patches = group.boxes.patches(shape);
    for (Index sample = 0; sample < resamples; ++sample) {
      Sums sums;
      for (Index scan = 0; scan < group.scans; ++scan) {
        const double drawn =
            uniform_pair(seed, static_cast<std::int32_t>(sample), static_cast<std::int32_t>(scan),
                         116 + static_cast<std::uint32_t>(g))
                .first;
        sums.add(patches[std::min(
            patches.size() - 1,
            static_cast<std::size_t>(drawn * static_cast<double>(patches.size())))]);
      }
      const Moments moments = sums.moments(static_cast<double>(group.scans));
      Moments& to = result.samples[static_cast<std::size_t>(sample)];
      to.third += group.weight * moments.third;
      to.fourth += group.weight * moments.fourth;
    }
  }
  for (const Moments& sample : result.samples) {
    result.mean.third += sample.third / static_cast<double>(resamples);
    result.mean.fourth += sample.fourth / static_cast<double>(resamples);
  }
  return result;
}

/// The nearest shape that a smooth distribution has.
HeightShape possible(HeightShape shape) {
  shape.skewness = std::clamp(shape.skewness, -6.0, 6.0);
  shape.kurtosis = std::clamp(shape.kurtosis, 1.3 + 1.1 * shape.skewness * shape.skewness, 200.0);
  return shape;
}

/// Derivatives of the mean moments with respect to skewness and kurtosis.
struct Slopes {
  double third_skewness, third_kurtosis, fourth_skewness, fourth_kurtosis;

  /// The change of shape that changes the moments by this much.
  HeightShape solve(double third, double fourth) const {
    const double determinant = third_skewness * fourth_kurtosis - third_kurtosis * fourth_skewness;
    return {(third * fourth_kurtosis - fourth * third_kurtosis) / determinant,
            (fourth * third_skewness - third * fourth_skewness) / determinant};
  }
};

Slopes slopes_at(const std::vector<Group>& groups, const HeightShape& shape, const Moments& mean,
                 std::uint64_t seed) {
  // Away from the least kurtosis.
  const double toward = shape.skewness > 0 ? -0.1 : 0.1;
  const Moments skew = simulated(groups, {shape.skewness + toward, shape.kurtosis}, seed).mean;
  const Moments steep = simulated(groups, {shape.skewness, shape.kurtosis + 0.3}, seed).mean;
  return {(skew.third - mean.third) / toward, (steep.third - mean.third) / 0.3,
          (skew.fourth - mean.fourth) / toward, (steep.fourth - mean.fourth) / 0.3};
}

}  // namespace

FoundHeights heights_of(const std::vector<ScanSpectrum>& scans, const std::vector<bool>& left_out,
                        const SpectrumTable& spectrum, const Lay& lay, Index draws,
                        std::uint64_t seed) {
  double largest = 0;
  for (const std::vector<std::size_t>& members : members_of(scans, left_out))
    if (const ScanSpectrum& first = scans[members.front()]; !first.profile())
      largest = std::max(largest, std::sqrt(first.grid.area()));
  std::vector<Group> groups;
  Moments seen{0, 0};
  double weights = 0;
  for (const std::vector<std::size_t>& members : members_of(scans, left_out)) {
    const ScanSpectrum& first = scans[members.front()];
    if (first.profile() || first.height_moments.empty() ||
        std::sqrt(first.grid.area()) < least_share * largest)
      continue;
    const auto count = static_cast<double>(members.size());
    Sums sums;
    for (const std::size_t scan : members) {
      const std::vector<double>& of_scan = scans[scan].height_moments;
      sums.add({of_scan[0], of_scan[1], of_scan[2]});
    }
    const Moments moments = sums.moments(count);
    const double weight = count * first.grid.area();
    seen.third += weight * moments.third;
    seen.fourth += weight * moments.fourth;
    weights += weight;
    const double blur = first.instrument.kind == Instrument::optical
                            ? first.instrument.resolution / std::sqrt(8 * std::numbers::ln2)
                            : 0;
    groups.push_back({std::ssize(members), weight, Boxes(first.grid, spectrum, lay, blur, seed)});
  }
  FoundHeights found;
  if (groups.empty()) return found;
  seen.third /= weights;
  seen.fourth /= weights;
  for (Group& group : groups) group.weight /= weights;

  Simulated at = simulated(groups, {}, seed);
  const auto far = [&] {
    double third = 0, fourth = 0;
    for (const Moments& sample : at.samples) {
      third += std::pow(sample.third - at.mean.third, 2) / static_cast<double>(resamples);
      fourth += std::pow(sample.fourth - at.mean.fourth, 2) / static_cast<double>(resamples);
    }
    return std::hypot((seen.third - at.mean.third) / std::sqrt(third),
                      (seen.fourth - at.mean.fourth) / std::sqrt(fourth));
  };
  found.gaussian = far() < detail::significant_length;
  Slopes slopes = slopes_at(groups, found.best, at.mean, seed);
  // Newton's steps, with the slopes of the last one for the errors.
  for (int step = 0; step < 8; ++step) {
    HeightShape change = slopes.solve(seen.third - at.mean.third, seen.fourth - at.mean.fourth);
    const double length = std::max(std::abs(change.skewness), std::abs(change.kurtosis) / 4);
    const double factor = std::min(1.0, 0.7 / std::max(length, 1e-12));
    const HeightShape next = possible({found.best.skewness + factor * change.skewness,
                                       found.best.kurtosis + factor * change.kurtosis});
    const bool there = std::abs(next.skewness - found.best.skewness) < 0.01 &&
                       std::abs(next.kurtosis - found.best.kurtosis) < 0.03;
    found.best = next;
    at = simulated(groups, found.best, seed);
    slopes = slopes_at(groups, found.best, at.mean, seed);
    if (there) break;
  }
  // Johnson's transform of a field of the same spectrum is only one of those that surfaces have.
  constexpr double model_error = 0.04;
  for (Index draw = 0; draw < draws; ++draw) {
    const double factor =
        1 + model_error * gaussian_pair(seed, static_cast<std::int32_t>(draw), 0, 130).first;
    const Moments& sample = at.samples[static_cast<std::size_t>(draw % resamples)];
    const HeightShape error =
        slopes.solve(sample.third - at.mean.third, sample.fourth - at.mean.fourth);
    found.draws.push_back(
        possible({factor * (found.best.skewness - error.skewness),
                  3 + factor * factor * (found.best.kurtosis - error.kurtosis - 3)}));
  }
  return found;
}

}  // namespace salebra::twin_detail
