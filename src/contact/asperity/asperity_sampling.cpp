// SPDX-License-Identifier: GPL-3.0-or-later
// Monte Carlo sampling of a summit ensemble: means and confidence intervals of the force curve of
// Greenwood and Williamson's model.
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/asperity/asperity_sampling.hpp>

#include "base/random.hpp"
#include "base/stop_check.hpp"
#include "height_density.hpp"

namespace salebra {
namespace {

// Streams of random numbers for summit heights and positions, so that the height and the position
// of one summit are independent.
constexpr std::uint32_t height_stream = 0x67770001, position_stream = 0x67770002;

}  // namespace

std::vector<Summit> draw_summits(const SummitEnsemble& ensemble, int count, double size,
                                 std::uint64_t seed, int realisation) {
  require(count >= 1, "count", count, "must be >= 1");
  require_positive(size, "size");
  require_positive(ensemble.radius, "radius");
  const detail::HeightDensity heights(ensemble);
  const bool gaussian = ensemble.distribution == SummitDistribution::gaussian;
  std::vector<Summit> summits;
  summits.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const RandomPair position = uniform_pair(seed, i, realisation, position_stream);
    const double height =
        gaussian ? ensemble.summit_rms * gaussian_pair(seed, i, realisation, height_stream).first
                 : heights.quantile(uniform_pair(seed, i, realisation, height_stream).first);
    summits.push_back({.x = size * position.first,
                       .y = size * position.second,
                       .height = height,
                       .curvature1 = 1 / ensemble.radius,
                       .curvature2 = 1 / ensemble.radius});
  }
  return summits;
}

double MonteCarloCurve::interval(double standard_deviation) const {
  return gsl_cdf_tdist_Pinv(0.975, realisations - 1) * standard_deviation /
         std::sqrt(static_cast<double>(realisations));
}

MonteCarloCurve monte_carlo_curve(const SummitEnsemble& ensemble, const Material& material,
                                  double nominal_area, const std::vector<double>& separations,
                                  const MonteCarloOptions& options) {
  require(options.realisations >= 2, "realisations", options.realisations, "must be >= 2");
  const StatisticalSummits statistical(ensemble, material, nominal_area);
  const double expected = std::max(1.0, std::round(ensemble.summit_density * nominal_area));
  require(expected < std::numeric_limits<int>::max(), "nominal_area", nominal_area,
          "holds too many summits to draw; use the statistical ensemble");

  MonteCarloCurve result;
  result.realisations = options.realisations;
  result.summits = static_cast<int>(expected);
  std::vector<double> descending = separations;
  std::ranges::sort(descending, std::ranges::greater{});
  // Indentations and gaps come from the statistical model; the sums over drawn summits replace all
  // other columns of the curve below.
  result.mean = curve_at_separations(statistical, descending);
  result.mean.model = "greenwood-williamson-monte-carlo";

  std::vector<std::vector<AsperityContact>> contacts(
      static_cast<std::size_t>(options.realisations));
  parallel::for_slabs(options.realisations, [&](Index begin, Index end) {
    for (Index realisation = begin; realisation < end; ++realisation) {
      detail::stop_if_asked();
      const DeterministicSummits drawn(
          draw_summits(ensemble, result.summits, std::sqrt(nominal_area), options.seed,
                       static_cast<int>(realisation)),
          material, nominal_area);
      // DeterministicSummits counts separations from the mean of the drawn heights; the statistical
      // ensemble counts them from height z = 0.
      for (const double separation : descending) {
        detail::stop_if_asked();
        contacts[static_cast<std::size_t>(realisation)].push_back(
            drawn.at(separation - drawn.common().mean_height));
      }
    }
  });

  const double count = options.realisations;
  for (std::size_t i = 0; i < descending.size(); ++i) {
    AsperityContact mean, deviation;
    for_each_member<AsperityContact>([&]<class Member>(Member AsperityContact::*sum) {
      if constexpr (std::is_same_v<Member, double>) {
        for (const auto& contact : contacts) mean.*sum += contact[i].*sum / count;
        for (const auto& contact : contacts) {
          const double difference = contact[i].*sum - mean.*sum;
          deviation.*sum += difference * difference / (count - 1);
        }
        deviation.*sum = std::sqrt(deviation.*sum);
      }
    });
    deviation.force_curvature = std::numeric_limits<double>::quiet_NaN();
    ForceSample& sample = result.mean.samples[i];
    sample.force = mean.force;
    sample.pressure = mean.force / nominal_area;
    sample.contact_area_fraction = mean.contact_area / nominal_area;
    sample.normal_stiffness = mean.normal_stiffness;
    sample.tangential_stiffness =
        material.tangential_modulus / material.contact_modulus * mean.normal_stiffness;
    result.deviation.push_back(deviation);
  }
  return result;
}

}  // namespace salebra
