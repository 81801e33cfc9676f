// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/mdr/mdr.hpp>

namespace salebra::cli {

/// The same law, or profile of an IndenterLaw, that throws Interrupted where it is evaluated after
/// Ctrl-C: every search and quadrature over it stops, whether or not it reports progress.
std::unique_ptr<ContactLaw> stoppable(std::unique_ptr<ContactLaw> law);
std::shared_ptr<const IndenterProfile> stoppable(std::shared_ptr<const IndenterProfile> profile);

}  // namespace salebra::cli
