// SPDX-License-Identifier: GPL-3.0-or-later
// Partial slip on a contact set: tractions for given displacements and friction limits.
#include <salebra/base/error.hpp>
#include <salebra/contact/tangential/partial_slip.hpp>

#include "disc_problem.hpp"
#include "tangential_workspace.hpp"

namespace salebra {

PartialSlipReport PartialSlipSolver::solve(const Field& limit, const TangentialField& displacement,
                                           double scale, TangentialField& traction,
                                           TangentialField& slip) {
  detail::TangentialWorkspace& workspace = parts_->workspace;
  const StickOptions& options = workspace.options();
  require((limit >= 0).all(), "limit", limit.minCoeff(), "must be >= 0 in every cell");
  const ContactSet contact = limit > 0;
  detail::require_contact(contact, workspace.grid(), options.boundary);
  workspace.require_field(displacement, "displacement");
  require_positive(scale, "scale");
  detail::ContactSystem& system = workspace.system_for(contact);
  const detail::PointList points = system.points(contact);
  std::vector<double> targets = workspace.gather(displacement, points);
  std::vector<double> tractions(targets.size(), 0.0), slips;
  if (traction.x.size() > 0) {
    workspace.require_field(traction, "traction");
    tractions = workspace.gather(traction, points);
  }
  const PartialSlipReport report =
      detail::solve_discs(workspace, system, points, detail::values_at(limit, points),
                          std::move(targets), scale, tractions, slips);
  traction = workspace.scatter(tractions, points.cell);
  slip = workspace.scatter(slips, points.cell);
  return report;
}

}  // namespace salebra
