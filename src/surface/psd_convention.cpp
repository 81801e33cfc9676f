// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of power spectra to the conventions of other programs.
#include "psd_convention.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>

namespace salebra {
namespace {

using std::numbers::pi;

ConvertedPsd scaled(const std::vector<double>& wavenumber, const std::vector<double>& density,
                    double wavenumber_factor, const std::function<double(double q)>& factor) {
  ConvertedPsd result;
  for (std::size_t k = 0; k < wavenumber.size(); ++k) {
    result.wavenumber.push_back(wavenumber_factor * wavenumber[k]);
    result.psd.push_back(factor(wavenumber[k]) * density[k]);
  }
  return result;
}

ConvertedPsd labelled(ConvertedPsd psd, std::string wavenumber_unit, std::string psd_unit,
                      std::string normalisation) {
  psd.wavenumber_unit = std::move(wavenumber_unit);
  psd.psd_unit = std::move(psd_unit);
  psd.normalisation = std::move(normalisation);
  return psd;
}

void require_equal(double along_x, double along_y, const char* field) {
  require(std::abs(along_x - along_y) <= 1e-9 * along_x, field, along_y / along_x,
          "times the size along x has no wave number in this convention; use one in rad/m");
}

}  // namespace

ConvertedPsd converted(const RadialSpectrum& spectrum, const Grid2D& grid,
                       PsdConvention convention) {
  const auto with = [&](double wavenumber_factor, const std::function<double(double)>& factor) {
    return scaled(spectrum.wavenumber, spectrum.psd, wavenumber_factor, factor);
  };
  const auto constant = [](double value) { return [value](double) { return value; }; };
  switch (convention) {
    case PsdConvention::surface_topography:
      return labelled(with(1, constant(4 * pi * pi)), "rad/m", "m^4",
                      "rms_height^2 = 1/(2 pi) * integral of q C dq");
    case PsdConvention::gwyddion:
      return labelled(with(1, [](double q) { return 2 * pi * q; }), "rad/m", "m^3",
                      "rms_height^2 = integral of W dq");
    case PsdConvention::tamaas: {
      require_equal(grid.lx, grid.ly, "size_y");
      const double mode = 2 * pi / grid.lx;
      return labelled(with(1 / mode, constant(mode * mode)), "1", "m^2",
                      "rms_height^2 = 2 pi * integral of n P dn = sum of P over modes");
    }
    case PsdConvention::rfgen: {
      require_equal(grid.dx(), grid.dy(), "dy");
      const double cycle = 2 * pi / grid.dx();
      return labelled(with(1 / cycle, constant(cycle * cycle)), "1", "m^2",
                      "rms_height^2 = 2 pi * integral of f P df");
    }
    case PsdConvention::salebra:
      break;
  }
  return labelled(with(1, constant(1)), "rad/m", "m^4", "rms_height^2 = 2 pi * integral of q C dq");
}

ConvertedPsd converted(const ProfilePsd& spectrum, PsdConvention convention) {
  const auto with = [&](double factor) {
    return scaled(spectrum.wavenumber, spectrum.psd, 1, [=](double) { return factor; });
  };
  require(convention != PsdConvention::tamaas && convention != PsdConvention::rfgen, "convention",
          "tamaas or rfgen", "has no spectrum of profiles; use another");
  if (convention == PsdConvention::surface_topography)
    return labelled(with(2 * pi), "rad/m", "m^3", "rms_height^2 = 1/pi * integral of C dq, q > 0");
  return labelled(with(1), "rad/m", "m^3", "rms_height^2 = integral of C dq, all q");
}

}  // namespace salebra
