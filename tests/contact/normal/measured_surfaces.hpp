// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <salebra/base/error.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/surface/detrend.hpp>
#include <string>
#include <vector>

namespace salebra::test {

struct MeasuredSurface {
  std::string name;
  Surface surface;         // without its mean plane
  double rms_slope = 0;    // rms of differences along both axes
  bool undefined = false;  // has points without a value, which lie on the mean plane here
};

struct MeasuredSurfaces {
  std::vector<MeasuredSurface> usable;
  std::vector<std::string> unusable;  // files, and the reason for each
};

inline double rms_slope_of(const Surface& surface) {
  const Field& h = surface.heights;
  const Index nx = h.rows(), ny = h.cols();
  const double along_x =
      nx > 1 ? ((h.bottomRows(nx - 1) - h.topRows(nx - 1)) / surface.grid.dx()).square().mean() : 0;
  const double along_y =
      ny > 1 ? ((h.rightCols(ny - 1) - h.leftCols(ny - 1)) / surface.grid.dy()).square().mean() : 0;
  return std::sqrt(along_x + along_y);
}

// Reads every file of a folder that is a surface; of larger surfaces the first `most` × `most`
// points.
inline MeasuredSurfaces measured_surfaces(const std::filesystem::path& folder, Index most) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.is_regular_file() && entry.path().extension() != ".md" &&
          entry.path().extension() != ".json")
        files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  MeasuredSurfaces found;
  for (const auto& file : files) {
    Surface surface;
    try {
      try {
        surface = read_surface(file);
      } catch (const InvalidInput&) {
        // Some files do not state a size.
        ReadOptions options;
        options.size_x = options.size_y = 1e-5;
        surface = read_surface(file, options);
      }
    } catch (const Error& error) {
      found.unusable.push_back(error.what());
      continue;
    }
    const Index nx = std::min(surface.grid.nx, most), ny = std::min(surface.grid.ny, most);
    surface.heights = Field(surface.heights.topLeftCorner(nx, ny));
    surface.grid = {nx, ny, surface.grid.dx() * static_cast<double>(nx),
                    surface.grid.dy() * static_cast<double>(ny)};
    MeasuredSurface measured{file.filename().string(), detrended(surface, Detrend::plane)};
    measured.undefined = measured.surface.undefined_points() > 0;
    measured.surface.heights = measured.surface.heights.isNaN().select(0, measured.surface.heights);
    measured.rms_slope = rms_slope_of(measured.surface);
    // Three points lie on a plane, which has no roughness to press on.
    const double largest = surface.heights.isNaN().select(0, surface.heights).abs().maxCoeff();
    if (measured.surface.heights.abs().maxCoeff() > 1e-12 * largest)
      found.usable.push_back(std::move(measured));
    else
      found.unusable.push_back(file.filename().string() + ": a plane");
  }
  return found;
}

}  // namespace salebra::test
