// SPDX-License-Identifier: GPL-3.0-or-later
// Reduced maps and spectra of one surface of a study, for the report.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <salebra/generators/spectrum.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/lay.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/spectrum.hpp>
#include <string>
#include <type_traits>

#include "base/special_values.hpp"

namespace salebra {
namespace {

using detail::unknown;

/// The power law C0 q^{−2(1+H)} at the wavenumbers of the spectrum, with the estimated Hurst
/// exponent H. C0 is fitted to the spectrum in the range of the estimate, where every Fourier mode
/// has equal weight.
std::vector<double> power_law(const RadialSpectrum& rings, const HurstEstimate& hurst) {
  std::vector<double> law(rings.wavenumber.size(), unknown);
  if (!hurst.found()) return law;
  const double slope = -2 * (1 + hurst.value);
  const auto inside = [&](double q) {
    return q >= hurst.wavenumber_min * (1 - 1e-9) && q <= hurst.wavenumber_max * (1 + 1e-9);
  };
  double power = 0, unit_power = 0;
  for (std::size_t i = 0; i < law.size(); ++i) {
    const double q = rings.wavenumber[i];
    if (!inside(q)) continue;
    // The fit is to relative deviations, so the weight of a ring is its number of modes, whatever
    // its power.
    law[i] = std::pow(q / hurst.wavenumber_min, slope);
    power += double(rings.modes[i]) * rings.psd[i] / law[i];
    unit_power += double(rings.modes[i]);
  }
  for (double& density : law) density *= power / unit_power;
  return law;
}

std::vector<double> prescribed_law(const RadialSpectrum& rings, const Spectrum& spectrum) {
  // Like the rings, the mean over all directions; an isotropic spectrum needs only one.
  constexpr int directions = 360;
  const bool isotropic = dynamic_cast<const IsotropicSpectrum*>(&spectrum) != nullptr;
  std::vector<double> law;
  for (const double q : rings.wavenumber) {
    double density = isotropic ? spectrum.density(q, 0) : 0;
    for (int k = 0; !isotropic && k < directions; ++k) {
      const double angle = std::numbers::pi * k / directions;
      density += spectrum.density(q * std::cos(angle), q * std::sin(angle)) / directions;
    }
    law.push_back(density > 0 ? density : unknown);
  }
  return law;
}

}  // namespace

bool wants_picture(const StudyConfiguration& configuration, std::uint64_t seed) {
  const auto* generated = std::get_if<GeneratedSurfaces>(&configuration.surfaces);
  return !generated || (!generated->seeds.empty() && generated->seeds.front() == seed);
}

SurfacePicture picture_of(const Surface& surface, const StudyConfiguration& configuration) {
  const Grid2D& grid = surface.grid;
  constexpr Index side = SurfacePicture::picture_side;
  SurfacePicture picture;
  picture.origin = surface.origin;
  picture.stride = (std::max(grid.nx, grid.ny) + side - 1) / side;
  picture.nx = (grid.nx + picture.stride - 1) / picture.stride;
  picture.ny = (grid.ny + picture.stride - 1) / picture.stride;
  picture.step_x = double(picture.stride) * grid.dx();
  picture.step_y = double(picture.stride) * grid.dy();
  const double mean = height_statistics(surface).mean;
  const RowPartition rows = surface.partition(), mapped = picture.rows_of(surface);
  const Field mine = surface.heights(
      Eigen::seqN(mapped.begin() * picture.stride - rows.begin(), mapped.count(), picture.stride),
      Eigen::seqN(0, picture.ny, picture.stride));
  picture.first_load.assign(static_cast<std::size_t>(mine.size()), -1);
  const Field heights = gathered(mapped, mine);
  for (const double height : heights.reshaped<Eigen::RowMajor>())
    picture.heights.push_back(float(height - mean));

  const PowerSpectrum spectrum = power_spectrum(surface);
  const RadialSpectrum rings = radial_spectrum(spectrum, 8);
  // A surface with a lay has no law that is the same in all directions.
  const HurstEstimate hurst =
      surface_lay(surface).found() ? HurstEstimate{} : estimate_hurst(spectrum);
  picture.wavenumber = rings.wavenumber;
  picture.psd = rings.psd;
  picture.hurst = hurst.value;
  picture.hurst_low = hurst.low;
  picture.hurst_high = hurst.high;
  if (const auto* generated = std::get_if<GeneratedSurfaces>(&configuration.surfaces)) {
    picture.law_psd = prescribed_law(rings, *generated->spectrum_of(generated->seeds.front()));
    picture.law = "asked for";
  } else {
    picture.law_psd = power_law(rings, hurst);
    if (hurst.found()) picture.law = "fitted";
  }

  if (!surface.communicator.is_root()) return picture;
  const Grid2D cells{picture.nx, picture.ny, double(picture.nx), double(picture.ny)};
  const HeightHistogram histogram = height_histogram(BearingCurve({cells, heights, false, ""}));
  for (std::size_t i = 0; i < histogram.height.size(); ++i) {
    picture.height.push_back(histogram.height[i] - mean);
    picture.height_density.push_back(histogram.height_density[i]);
  }
  return picture;
}

RowPartition SurfacePicture::rows_of(const Surface& surface) const {
  const RowPartition rows = surface.partition();
  std::vector<Index> begins;
  for (int rank = 0; rank < surface.communicator.size(); ++rank)
    begins.push_back((rows.begin_of(rank) + stride - 1) / stride);
  begins.push_back(nx);
  return {surface.communicator, begins};
}

void SurfacePicture::add_contact(std::int16_t k, const NormalContactState& state,
                                 const Surface& surface) {
  if (k == mapped_load) contact_pressure.clear(), gap.clear();
  std::size_t point = 0;
  for (Index ix = rows_of(surface).begin() * stride - surface.partition().begin();
       ix < state.contact_pressure.rows(); ix += stride) {
    for (Index iy = 0; iy < state.contact_pressure.cols(); iy += stride, ++point) {
      std::int16_t& first = first_load[point];
      if (k == mapped_load) {
        contact_pressure.push_back(float(state.contact_pressure(ix, iy)));
        gap.push_back(float(state.gap(ix, iy)));
      }
      if (state.contact_pressure(ix, iy) > 0 && (first < 0 || k < first)) first = k;
    }
  }
}

void SurfacePicture::gather(const Communicator& communicator) {
  const auto join = [&](auto& values) {
    using Value = std::remove_cvref_t<decltype(values.front())>;
    const std::string mine(reinterpret_cast<const char*>(values.data()),
                           values.size() * sizeof(Value));
    std::string all;
    for (const std::string& part : communicator.gather_all(mine)) all += part;
    if (!communicator.is_root()) return;
    values.resize(all.size() / sizeof(Value));
    std::memcpy(values.data(), all.data(), all.size());
  };
  join(first_load);
  join(contact_pressure);
  join(gap);
}

}  // namespace salebra
