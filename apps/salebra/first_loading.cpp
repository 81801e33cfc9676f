// SPDX-License-Identifier: GPL-3.0-or-later
// Plastic first loading of a surface before a command presses it.
#include "first_loading.hpp"

#include <salebra/base/error.hpp>
#include <salebra/results/columns.hpp>
#include <utility>

namespace salebra::cli {

std::optional<FirstLoading> load_first(Surface& surface, const std::optional<double>& hardness,
                                       double contact_modulus, double nominal_pressure,
                                       NormalContactOptions contact, double normal_amplitude) {
  if (!hardness) return {};
  require_positive(*hardness, "--hardness");
  contact.hardness = *hardness;
  ResidualSurface residual = after_first_loading(std::move(surface), contact_modulus,
                                                 nominal_pressure, contact, normal_amplitude);
  if (residual.interrupted) throw Interrupted("interrupted; nothing was written");
  if (!residual.converged) throw NotConverged("--hardness: the first loading did not converge");
  surface = std::move(residual.surface);
  return residual.first_loading;
}

void add_first_loading(Json& answer, const std::optional<FirstLoading>& loading) {
  if (loading) answer["first_loading"] = json_of(*loading);
}

}  // namespace salebra::cli
