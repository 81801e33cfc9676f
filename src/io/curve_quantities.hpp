// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/io/provenance.hpp>
#include <string>
#include <string_view>

namespace salebra::detail {

/// A member of ForceSample as it is written in files; find_quantity(name) has its unit and meaning.
struct CurveQuantity {
  std::string_view name;
  double ForceSample::*member;
};

inline constexpr std::array curve_quantities{
    CurveQuantity{"pressure", &ForceSample::pressure},
    CurveQuantity{"force", &ForceSample::force},
    CurveQuantity{"indentation", &ForceSample::indentation},
    CurveQuantity{"mean_gap", &ForceSample::mean_gap},
    CurveQuantity{"separation", &ForceSample::separation},
    CurveQuantity{"contact_area_fraction", &ForceSample::contact_area_fraction},
    CurveQuantity{"normal_stiffness", &ForceSample::normal_stiffness},
    CurveQuantity{"tangential_stiffness", &ForceSample::tangential_stiffness},
};

ForceCurve read_text_curve(const std::filesystem::path& file, std::string_view content);
std::string text_of(const ForceCurve& curve, const Provenance& provenance);

}  // namespace salebra::detail
