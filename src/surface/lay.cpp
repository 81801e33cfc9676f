// SPDX-License-Identifier: GPL-3.0-or-later
// The lay of a surface, from the mean products of its gradient.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/base/units.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/crop.hpp>
#include <salebra/surface/lay.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/spectrum.hpp>
#include <span>
#include <vector>

#include "base/printable.hpp"
#include "neighbour_rows.hpp"
#include "significance.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

constexpr double least_ratio = 1.5;    ///< of a lay
constexpr double most_skewness = 0.5;  ///< of heights that count as Gaussian
constexpr double cells_of_wave = 4;    ///< shortest wave, in cells of the coarser axis
constexpr Index least_points = 16;     ///< along each axis
constexpr double two_sided = 1.96;     ///< 95 % limits of a normal variable, in standard deviations

/// Weighted sums over the modes with |q| up to a limit: of the power p, and of q_x²p, q_y²p and
/// q_x q_y p.
struct Gradients {
  double power = 0, xx = 0, yy = 0, xy = 0;
};

/// Sums term(q_x, q_y, p, multiplicity, sums) over the modes of all processes with |q| <= limit.
template <std::size_t count, class Term>
std::array<double, count> sum_modes(const PowerSpectrum& spectrum, double limit, const Term& term) {
  const RowPartition columns = spectrum.columns();
  const std::vector<double> sums =
      parallel::sum_blocks(columns, count, [&](Index begin, Index end, std::span<double> of_block) {
        for (Index i = 0; i < spectrum.grid.nx; ++i) {
          const double qx = spectrum.wavenumber_x(i);
          if (std::abs(qx) > limit) continue;
          for (Index k = begin; k < end; ++k) {
            const Index j = columns.begin() + k;
            const double qy = spectrum.wavenumber_y(j);
            if (qx * qx + qy * qy > limit * limit) continue;
            term(qx, qy, spectrum.psd(i, k) * spectrum.cell(), spectrum.multiplicity(j), of_block);
          }
        }
      });
  std::array<double, count> result;
  std::copy(sums.begin(), sums.end(), result.begin());
  return result;
}

/// ∫ qᵢqⱼ C d²q over the waves of a limit, less the slope of the window.
Gradients gradients(const PowerSpectrum& spectrum, double limit) {
  const auto sums = sum_modes<4>(
      spectrum, limit, [](double qx, double qy, double power, double modes, std::span<double> to) {
        to[0] += modes * power;
        to[1] += modes * qx * qx * power;
        to[2] += modes * qy * qy * power;
        to[3] += modes * qx * qy * power;
      });
  Gradients result{sums[0], sums[1], sums[2], sums[3]};
  if (spectrum.windowed) {
    // ⟨w'²⟩/⟨w²⟩ of Welch's window of the length l is 10/l².
    const auto slope = [](double length) { return 10 / (length * length); };
    result.xx -= result.power * slope(spectrum.grid.lx);
    result.yy -= result.power * slope(spectrum.grid.ly);
  }
  return result;
}

constexpr Index parts_per_side = 6;
constexpr std::size_t part_count = parts_per_side * parts_per_side;
constexpr std::size_t strip_count = 18;

/// Sums of g_x², g_y² and g_x g_y over the cells of regions of a surface, where g is the mean
/// gradient of a cell.
struct Regions {
  std::array<Gradients, part_count> parts;
  /// Strips of equal width at right angles to a direction. A groove that crosses the surface is in
  /// many parts but, if it runs along the lay, in one or two strips.
  std::array<Gradients, strip_count> strips;
};

Regions gradients_of_regions(const Surface& surface, double across) {
  const Grid2D& grid = surface.grid;
  const detail::NeighbourRows rows(surface);
  const RowPartition partition = surface.partition();
  const double along_x = std::cos(across) * grid.dx(), along_y = std::sin(across) * grid.dy();
  const double width = (std::abs(along_x) * static_cast<double>(grid.nx) +
                        std::abs(along_y) * static_cast<double>(grid.ny)) /
                       static_cast<double>(strip_count);
  const double start = std::min(along_x, 0.0) * static_cast<double>(grid.nx) +
                       std::min(along_y, 0.0) * static_cast<double>(grid.ny);
  const std::vector<double> sums = parallel::sum_blocks(
      partition, 3 * (part_count + strip_count),
      [&](Index begin, Index end, std::span<double> of_block) {
        for (Index ix = begin; ix < end; ++ix) {
          const double *here = rows[ix], *next = rows[ix + 1];
          if (!next) continue;
          const Index row = (partition.begin() + ix) * parts_per_side / grid.nx;
          for (Index iy = 0; iy + 1 < grid.ny; ++iy) {
            const double x = (next[iy] + next[iy + 1] - here[iy] - here[iy + 1]) / (2 * grid.dx());
            const double y = (here[iy + 1] + next[iy + 1] - here[iy] - next[iy]) / (2 * grid.dy());
            const auto part =
                static_cast<std::size_t>(row * parts_per_side + iy * parts_per_side / grid.ny);
            const double distance = (static_cast<double>(partition.begin() + ix) + 0.5) * along_x +
                                    (static_cast<double>(iy) + 0.5) * along_y - start;
            const auto strip = std::min(static_cast<std::size_t>(std::max(distance, 0.0) / width),
                                        strip_count - 1);
            for (const std::size_t region : {part, part_count + strip}) {
              of_block[3 * region] += x * x;
              of_block[3 * region + 1] += y * y;
              of_block[3 * region + 2] += x * y;
            }
          }
        }
      });
  const auto region = [&](std::size_t k) {
    return Gradients{0, sums[3 * k], sums[3 * k + 1], sums[3 * k + 2]};
  };
  Regions regions;
  for (std::size_t k = 0; k < part_count; ++k) regions.parts[k] = region(k);
  for (std::size_t k = 0; k < strip_count; ++k) regions.strips[k] = region(part_count + k);
  return regions;
}

/// Difference of the eigenvalues of the matrix ⟨∂ᵢh ∂ⱼh⟩ over its standard error on a surface whose
/// regions have as strong lays, but a random direction each.
template <std::size_t count>
double significance_of(const std::array<Gradients, count>& regions) {
  double along_x = 0, oblique = 0, squares = 0;
  for (const Gradients& region : regions) {
    const double difference = region.xx - region.yy;
    along_x += difference;
    oblique += 2 * region.xy;
    squares += difference * difference + 4 * region.xy * region.xy;
  }
  return std::hypot(along_x, oblique) / std::sqrt(squares / 2);
}

/// How well the regions of a surface agree about its lay.
struct Scatter {
  double significance = 0;  ///< see significance_of(), the least of parts and of strips
  double log_ratio = 0;     ///< standard error of the logarithm of the quotient of the eigenvalues
  double angle = 0;         ///< standard error of the direction, rad
};

/// The scatter between the parts of a surface, which are taken as independent: right if a part has
/// many hills, of any distribution of heights. across: direction of the steeper slope, rad.
Scatter scatter_of_parts(const Surface& surface, double across) {
  const double c = std::cos(across), s = std::sin(across);
  struct Turned {
    double steep, flat, both;
  };
  std::array<Turned, part_count> parts;
  Turned total{};
  std::size_t k = 0;
  const Regions regions = gradients_of_regions(surface, across);
  for (const Gradients& part : regions.parts) {
    const Turned& turned = parts[k++] = {c * c * part.xx + s * s * part.yy + 2 * c * s * part.xy,
                                         s * s * part.xx + c * c * part.yy - 2 * c * s * part.xy,
                                         c * s * (part.yy - part.xx) + (c * c - s * s) * part.xy};
    total.steep += turned.steep;
    total.flat += turned.flat;
    total.both += turned.both;
  }
  double log_ratio = 0, angle = 0;
  for (const Turned& part : parts) {
    log_ratio += std::pow(part.steep / total.steep - part.flat / total.flat, 2);
    angle +=
        std::pow(part.both - total.both * (part.steep + part.flat) / (total.steep + total.flat), 2);
  }
  const double correction = static_cast<double>(part_count) / static_cast<double>(part_count - 1);
  return {std::min(significance_of(regions.parts), significance_of(regions.strips)),
          std::sqrt(correction * log_ratio),
          std::sqrt(correction * angle) / std::abs(total.steep - total.flat)};
}

}  // namespace

bool SurfaceLay::found() const { return significant && ratio > least_ratio; }

SurfaceLay surface_lay(const Surface& surface) {
  const Grid2D& grid = surface.grid;
  const double slope = surface_moments(surface).rms_slope();
  SurfaceLay lay;
  if (!(slope > 0) || std::min(grid.nx, grid.ny) < least_points) return lay;
  // Welch's window leaves twice as many independent modes as Hann's.
  const PowerSpectrum spectrum =
      power_spectrum(surface, surface.periodic ? Window::none : Window::welch);
  const double limit = 2 * pi / (cells_of_wave * std::max(grid.dx(), grid.dy())) * (1 + 1e-9);
  const Gradients matrix = gradients(spectrum, limit);
  const double trace = matrix.xx + matrix.yy;
  const double difference = std::hypot(matrix.xx - matrix.yy, 2 * matrix.xy);
  if (!(trace > 0)) return lay;

  const double across = std::atan2(2 * matrix.xy, matrix.xx - matrix.yy) / 2;
  const double cosine = std::cos(across), sine = std::sin(across);
  const double steep = (trace + difference) / 2, flat = (trace - difference) / 2;
  // The power of a mode has the variance C², and the mean of its square is 2C². A mode and its
  // conjugate have equal powers, so the variance of a sum Σwp over both is Σw²p², times the number
  // of neighbours that a window makes one variable.
  enum { of_steep, of_flat, of_both };
  auto variances = sum_modes<3>(
      spectrum, limit, [&](double qx, double qy, double power, double modes, std::span<double> to) {
        const double u = cosine * qx + sine * qy, v = cosine * qy - sine * qx;
        const double weight = modes * power * power;
        to[of_steep] += weight * u * u * u * u;
        to[of_flat] += weight * v * v * v * v;
        to[of_both] += weight * u * u * v * v;
      });
  for (double& variance : variances) variance *= spectrum.correlated_modes;
  // On an isotropic surface the component of the difference along x and the one at 45° have equal
  // variances, half of their sum.
  const double by_modes =
      difference /
      std::sqrt((variances[of_steep] + variances[of_flat] + 2 * variances[of_both]) / 2);
  const Scatter parts = scatter_of_parts(surface, across);
  lay.significant = std::min(by_modes, parts.significance) > detail::significant_length;

  const double square = std::max(flat, 0.0) / steep;
  lay.rms_slope_across = slope / std::sqrt(1 + square);
  lay.rms_slope_along = slope * std::sqrt(square / (1 + square));
  lay.ratio = 1 / std::sqrt(square);
  const double flat_error = std::sqrt(variances[of_flat]);
  if (flat > 2 * flat_error) {
    const double log_ratio =
        std::sqrt(variances[of_steep] / (steep * steep) + variances[of_flat] / (flat * flat) -
                  2 * variances[of_both] / (steep * flat));
    const double factor = std::exp(two_sided / 2 * std::hypot(log_ratio, parts.log_ratio));
    lay.ratio_low = lay.ratio / factor;
    lay.ratio_high = lay.ratio * factor;
  } else {
    const double margin = two_sided / 2 * std::sqrt(variances[of_steep]) / steep;
    const double flat_high = std::max(flat, 0.0) + two_sided * flat_error;
    lay.ratio_low = std::sqrt(steep / flat_high) * std::exp(-margin);
    lay.ratio_high = std::numeric_limits<double>::infinity();
  }
  if (!lay.significant) lay.ratio_low = 1;
  lay.ratio_low = std::max(1.0, lay.ratio_low);
  lay.angle = across + pi / 2;
  if (lay.angle >= pi) lay.angle -= pi;
  // A direction of which nothing is known has the scatter of half a turn.
  lay.angle_error = std::min(std::hypot(std::sqrt(variances[of_both]) / difference, parts.angle),
                             pi / std::sqrt(12.0));
  return lay;
}

std::string lay_in_words(const SurfaceLay& lay) {
  if (!lay.found()) return {};
  // The angle may round to 180°, which is the direction of 0°.
  const int degrees = static_cast<int>(std::lround(lay.angle * 180 / pi)) % 180;
  const std::string ratio = std::isinf(lay.ratio_high)
                                ? fmt::format("above {:.2g} to 1", lay.ratio_low)
                                : fmt::format("{:.2g} to 1", lay.ratio);
  return fmt::format("ground-like: lay {}° from x, {}", degrees, ratio);
}

double significant_skewness(const Surface& surface) {
  if (surface.communicator.size() > 1) return 0;
  const double skewness = height_statistics(surface).skewness;
  if (!(std::abs(skewness) > most_skewness)) return 0;
  // In a map of few hills the correlation is chance too. Every quarter of a skew surface is skew.
  const Grid2D& grid = surface.grid;
  if (std::min(grid.nx, grid.ny) < 4) return 0;
  const double x = grid.lx / 2, y = grid.ly / 2;
  for (const Rectangle& quarter : {Rectangle{0, 0, x, y}, Rectangle{x, 0, grid.lx, y},
                                   Rectangle{0, y, x, grid.ly}, Rectangle{x, y, grid.lx, grid.ly}})
    if (!(height_statistics(cropped(surface, quarter)).skewness * std::copysign(1, skewness) >
          most_skewness / 2))
      return 0;
  const CorrelationMap map = correlation_map(surface);
  const Index origin = map.origin();
  const double variance = map.autocorrelation(origin, 0), points = map.pairs(origin, 0);
  double sum = 0;
  for (Index j = 0; j < map.pairs.cols(); ++j)
    for (Index i = 0; i < map.pairs.rows(); ++i) {
      if (!(map.pairs(i, j) > 0)) continue;
      // The map has only half of the lags, those with y >= 0.
      const double both = j > 0 ? 2 : 1;
      sum += both * std::pow(map.autocorrelation(i, j) / variance, 3) * map.pairs(i, j);
    }
  const double deviation = std::sqrt(6 * std::max(sum, points)) / points;
  return std::abs(skewness) > 3 * deviation ? skewness : 0;
}

namespace {

/// Why a surface has no direction across or along a lay.
std::string why_no_lay(const SurfaceLay& lay) {
  const std::string way = "give an angle instead, such as 30deg";
  if (std::isnan(lay.ratio))
    return fmt::format(
        "needs a lay, which cannot be found on a flat surface or one with fewer than "
        "{} points along a side; {}",
        least_points, way);
  return fmt::format(
      "needs a surface with a lay, a significant ratio of slopes above {}; that of this surface is "
      "{:.3g} ({:.3g} to {:.3g}); {}",
      least_ratio, lay.ratio, lay.ratio_low, lay.ratio_high, way);
}

}  // namespace

std::string direction_in_words(double direction) {
  if (direction == 0) return "along x";
  if (direction == pi / 2) return "along y";
  return fmt::format("at {:.3g}° to x", direction * 180 / pi);
}

DirectionChoice direction_choice(std::string_view text, std::string_view field) {
  if (const auto named = parse_enum<LayDirection>(std::string(text))) return *named;
  const bool number = text.find_first_of("0123456789") != std::string_view::npos;
  require(number, field, fmt::format("'{}'", printable(text)),
          "must be across, along, both, or an angle from the x axis with its unit, such as 30deg");
  const double angle = parse_quantity(text, Dimension::angle, field);
  // 30 without a unit would be 30 rad.
  require(angle == 0 ||
              text.find_first_of("abcdefghijklmnopqrstuvwxyz") != std::string_view::npos ||
              text.find("°") != std::string_view::npos,
          field, fmt::format("'{}'", printable(text)), "needs a unit, such as 30deg or 0.5rad");
  return angle;
}

std::vector<double> directions_of(const DirectionChoice& choice, const SurfaceLay& lay) {
  const auto folded = [](double angle) {
    const double rest = std::fmod(angle, pi);
    return rest < 0 ? rest + pi : rest;
  };
  if (const double* angle = std::get_if<double>(&choice)) {
    require(std::isfinite(*angle), "direction", *angle, "must be finite");
    return {folded(*angle)};
  }
  const LayDirection named = std::get<LayDirection>(choice);
  if (!lay.found()) {
    if (named == LayDirection::automatic) return {0};
    require(false, "direction", name_of(named), why_no_lay(lay));
  }
  const double along = folded(lay.angle), across = folded(lay.angle + pi / 2);
  if (named == LayDirection::across) return {across};
  if (named == LayDirection::along) return {along};
  return {across, along};
}

std::vector<double> directions_of(const DirectionChoice& choice, const Surface& surface) {
  if (std::holds_alternative<double>(choice)) return directions_of(choice, SurfaceLay{});
  // Only a complete surface has a spectrum; the contact calculation will say why it is refused.
  if (choice == DirectionChoice(LayDirection::automatic) && surface.undefined_points() > 0)
    return {0};
  return directions_of(choice, surface_lay(surface));
}

std::vector<std::string> warnings_of_lay(const SurfaceLay& lay, double skewness,
                                         const std::string& by_lay,
                                         const std::string& by_skewness) {
  std::vector<std::string> warnings;
  if (lay.found() && !by_lay.empty()) warnings.push_back(lay_in_words(lay) + ": " + by_lay);
  if (std::abs(skewness) > most_skewness && !by_skewness.empty())
    warnings.push_back(
        fmt::format("the skewness of the heights is {:.2g}: {}", skewness, by_skewness));
  return warnings;
}

}  // namespace salebra
