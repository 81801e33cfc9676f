// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <salebra/analysis/contact.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/mdr/mdr.hpp>

namespace salebra {

/// The same law, or profile of an IndenterLaw, that throws Interrupted where it is evaluated after
/// the context has said stop.
std::unique_ptr<const ContactLaw> stoppable(std::unique_ptr<const ContactLaw> law,
                                            const Context& context);
std::shared_ptr<const IndenterProfile> stoppable(std::shared_ptr<const IndenterProfile> profile,
                                                 const Context& context);

}  // namespace salebra
