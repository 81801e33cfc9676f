// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assumption_options.hpp"
#include "indenter_options.hpp"
#include "options.hpp"

namespace salebra::cli {

struct ViscoelasticArguments {
  IndenterOptions indenter;
  MaterialOptions material;
  MotionOptions motion;
  OperatingPointOptions point;
  std::string prony, body_file, hold = "auto";
  SurfaceOptions surface;
  std::optional<int> steps, springs;
  std::optional<double> tolerance;
  std::vector<double> creep;  ///< times of a held load, s; empty: a motion
  AssumptionOptions assumptions;
  std::string csv;  ///< table of several surfaces
};

/// `salebra viscoelastic SURFACE --body FILE`: the cycles of a rough contact, or with --creep its
/// contact over the time.
void run_on_surface(const ViscoelasticArguments& arguments, Session& session);
/// The motion for the caption of a figure, without the quantity that varies.
std::string motion_of_caption(const ViscoelasticArguments& arguments);
/// The losses of each of several surfaces under the same pressure.
void lose_of_files(ViscoelasticArguments arguments, const std::vector<std::string>& files,
                   Session& session);

}  // namespace salebra::cli
