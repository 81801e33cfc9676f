// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace salebra {

struct ModelResult;
namespace detail {
struct ModelWork;
}

/// The contact models of a study, in the order of contact_models().
enum class ContactModel {
  bem,
  gw_moments,
  gw_deterministic,
  gw_monte_carlo,
  gw_interacting,
  persson,
  greenwood_tripp
};

/// A contact model: the name that files, JSON and study files have for it, that of the enumerator;
/// what people call it; what it costs for each cell and pressure, s, on the machine of
/// estimate_cost(); and the function that presses a surface with it. A new model is an enumerator
/// and an entry in src/study/contact_models.cpp.
struct StudyModel {
  ContactModel id;
  const char* name;
  const char* title;
  double seconds_per_cell;
  ModelResult (*press)(detail::ModelWork&);
};

/// All of them.
std::span<const StudyModel> contact_models();

/// Finds a model by its name. Throws InvalidInput "models: …" for another.
ContactModel contact_model(std::string_view name);
std::string_view word_of(ContactModel model);
std::vector<ContactModel> all_contact_models();
/// The models of the names, each once, and the boundary elements, which the others are measured by.
std::vector<ContactModel> contact_models(const std::vector<std::string>& names);

}  // namespace salebra
