// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/share.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/study/configuration.hpp>
#include <string>
#include <vector>

namespace salebra {

/// What a reader wants to see of one surface of a study: its heights and where they touch, its
/// spectrum and its distribution. Maps hold every stride-th point along either axis, at most
/// picture_side of them: a sample of the points has the height distribution and, in the mean, the
/// contact area of all of them, which averages over blocks have not.
struct SurfacePicture {
  static constexpr Index picture_side = 512;

  std::string origin;  ///< file, or generator with its seed
  Index stride = 0;    ///< 0: there is no picture
  Index nx = 0, ny = 0;
  double step_x = 0, step_y = 0;  ///< between points of the maps, m
  std::vector<float> heights;     ///< (nx, ny), y contiguous, less the mean of the surface, m
  std::vector<std::int16_t>
      first_load;         ///< number of the least load at which a point touches; −1: none
  Index mapped_load = 0;  ///< number of the load of the next two
  std::vector<float>
      contact_pressure;    ///< (nx, ny), Pa; empty until boundary elements have solved that load
  std::vector<float> gap;  ///< (nx, ny), of the deformed surfaces, m

  std::vector<double> wavenumber, psd;  ///< radial spectrum C, rad/m and m⁴
  std::vector<double> law_psd;          ///< NaN where the law does not reach
  std::string law;                      ///< where the law comes from; empty: there is none
  double hurst = 0, hurst_low = 0,
         hurst_high = 0;  ///< estimated, with its 95 % interval; NaN: no self-affine range

  std::vector<double> height, height_density;  ///< histogram, m and 1/m

  bool empty() const { return stride == 0; }
  /// Marks the points that carry pressure under load number k, and takes the maps of one load. Of a
  /// surface that is spread over processes each has its rows of these maps.
  void add_contact(std::int16_t k, const NormalContactState& state, const Surface& surface);
  /// Hands them to the first process. Collective.
  void gather(const Communicator& ranks);
  /// Rows of the maps, in the processes that hold them.
  Share rows_of(const Surface& surface) const;
};

constexpr void describe(auto&& visit, std::type_identity<SurfacePicture>) {
  using enum Dimension;
  using S = SurfacePicture;
  visit(&S::origin, Quantity{"origin", dimensionless, "file, or generator with its seed"});
  visit(&S::stride, Quantity{"stride", dimensionless, "points from one to the next that is kept"});
  visit(&S::nx, Kept{"nx", "points of the maps along x"});
  visit(&S::ny, Kept{"ny", "points of the maps along y"});
  visit(&S::step_x, Kept{"step_x", "between points of the maps along x", length});
  visit(&S::step_y, Kept{"step_y", "between points of the maps along y", length});
  visit(&S::heights,
        Quantity{"heights", length, "height, positive out of the material, from the mean"});
  visit(
      &S::first_load,
      Quantity{"first_load", dimensionless,
               "number of the lowest pressure of the curve at which the point touches; -1: none"});
  visit(&S::mapped_load,
        Kept{"mapped_load", "number of the pressure of the maps of pressure and gap"});
  visit(&S::contact_pressure, Quantity{"contact_pressure", pressure, "contact pressure"});
  visit(&S::gap, Quantity{"gap", length, "gap of the deformed surfaces"});
  visit(&S::wavenumber, Quantity{"wavenumber", Dimension::wavenumber, "wave number"});
  visit(&S::psd, Quantity{"psd", length_to_the_fourth,
                          "power spectral density C, rms_height^2 = integral of C d^2q"});
  visit(&S::law_psd,
        Quantity{"law_psd", length_to_the_fourth, "power spectral density of the self-affine law"});
  visit(&S::law, Quantity{"law", dimensionless, "where the law comes from"});
  visit(&S::hurst, Quantity{"hurst", dimensionless, "Hurst exponent"});
  visit(&S::hurst_low, Quantity{"hurst_low", dimensionless, "Hurst exponent, lower 95 % limit"});
  visit(&S::hurst_high, Quantity{"hurst_high", dimensionless, "Hurst exponent, upper 95 % limit"});
  visit(&S::height, Quantity{"height", length, "height above the mean, middle of a bin"});
  visit(&S::height_density,
        Quantity{"height_density", inverse_length, "share of the points in a bin over its width"});
}

/// One picture a study: of its first seed, or of the measured surface.
bool wants_picture(const StudyConfiguration& configuration, std::uint64_t seed);

/// Makes the picture, without contact as yet. The law of a generated surface is what was asked for,
/// that of any other a power law through the range in which it is self-affine. The distribution is
/// that of the points of the maps. A surface may be spread over processes; the first one has the
/// picture. Collective. Cost: one FFT.
SurfacePicture picture_of(const Surface& surface, const StudyConfiguration& configuration);

}  // namespace salebra
