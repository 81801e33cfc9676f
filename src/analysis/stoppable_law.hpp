// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/analysis/contact.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/mdr/mdr.hpp>

namespace salebra {

/// Wraps a law, or the profile of an IndenterLaw. The result has the same values, but throws
/// Interrupted when it is evaluated after Context::stopped() has returned true.
std::unique_ptr<const ContactLaw> stoppable(std::unique_ptr<const ContactLaw> law,
                                            const Context& context);
std::shared_ptr<const IndenterProfile> stoppable(std::shared_ptr<const IndenterProfile> profile,
                                                 const Context& context);

}  // namespace salebra
