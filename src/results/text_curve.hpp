// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/io/provenance.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace salebra::detail {

/// A quantity of ForceSample that is stored in files of a single curve.
struct CurveQuantity {
  Quantity quantity;
  double ForceSample::*member;
};

/// All quantities of a curve, the loads (pressure, force) first.
inline std::vector<CurveQuantity> curve_quantities() {
  std::vector<CurveQuantity> all;
  describe(
      [&](auto member, const Quantity& quantity) {
        if constexpr (std::is_same_v<decltype(member), double ForceSample::*>)
          all.push_back({quantity, member});
      },
      std::type_identity<ForceSample>{});
  const auto rank = [](const CurveQuantity& item) {
    return item.member == &ForceSample::pressure ? 0 : item.member == &ForceSample::force ? 1 : 2;
  };
  std::ranges::stable_sort(all, {}, rank);
  return all;
}

ForceCurve read_text_curve(const std::filesystem::path& file, std::string_view content);
std::string text_of(const ForceCurve& curve, const std::vector<CurveColumn>& beside,
                    const Provenance& provenance);

}  // namespace salebra::detail
