// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <salebra/base/units.hpp>
#include <salebra/contact/force_curve.hpp>
#include <salebra/io/provenance.hpp>
#include <string>
#include <string_view>

namespace salebra::detail {

/// A member of ForceSample as it is written in files.
struct CurveQuantity {
  std::string_view name;
  double ForceSample::*member;
  Dimension dimension;
  std::string_view long_name;
};

inline constexpr std::array curve_quantities{
    CurveQuantity{"pressure", &ForceSample::pressure, Dimension::pressure, "nominal pressure"},
    CurveQuantity{"force", &ForceSample::force, Dimension::force, "normal force"},
    CurveQuantity{"indentation", &ForceSample::indentation, Dimension::length,
                  "indentation, larger is closer"},
    CurveQuantity{"mean_gap", &ForceSample::mean_gap, Dimension::length,
                  "mean gap of the deformed surfaces"},
    CurveQuantity{"separation", &ForceSample::separation, Dimension::length,
                  "distance of the smooth plane from the mean plane of the summits"},
    CurveQuantity{"contact_area_fraction", &ForceSample::contact_area_fraction,
                  Dimension::dimensionless, "real over nominal contact area"},
    CurveQuantity{"normal_stiffness", &ForceSample::normal_stiffness, Dimension::stiffness,
                  "normal stiffness"},
    CurveQuantity{"tangential_stiffness", &ForceSample::tangential_stiffness, Dimension::stiffness,
                  "tangential stiffness in full stick"},
};

ForceCurve read_text_curve(const std::filesystem::path& file, std::string_view content);
std::string text_of(const ForceCurve& curve, const Provenance& provenance);

}  // namespace salebra::detail
