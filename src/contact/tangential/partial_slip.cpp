// SPDX-License-Identifier: GPL-3.0-or-later
// Partial-slip solver on a contact set: tractions for given displacements and friction limits.
#include <cmath>
#include <numbers>
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
  std::vector<double> limits;
  limits.reserve(points.cell.size());
  for (const Index cell : points.cell) limits.push_back(limit.data()[cell]);
  std::vector<double> targets = workspace.gather(displacement, points);
  std::vector<double> tractions(targets.size(), 0.0), gradient;
  if (traction.x.size() > 0) {
    workspace.require_field(traction, "traction");
    tractions = workspace.gather(traction, points);
  }
  PartialSlipReport report;
  if (points.size() == 0) {
    report.termination = Termination::converged;
  } else {
    // K̂ = (2π/q)(c1 + c2 …) lies between the values along and across the wave; 2/(E q) with their
    // mean.
    const Material& material = workspace.material();
    const double stiffness_scale =
        1 / (std::numbers::pi * (material.cerruti_isotropic + material.cerruti_directed / 2));
    detail::DiscProblem problem(system, points, std::move(limits), std::move(targets),
                                stiffness_scale);
    report = problem.solve(options.tolerance * scale, options.max_iterations, options.on_progress,
                           tractions, gradient);
    report.residual /= scale;
    for (std::size_t k = 0; k < points.cell.size(); ++k)
      if (!problem.slips(tractions, gradient, k))
        for (std::size_t i = k; i < gradient.size(); i += points.cell.size()) gradient[i] = 0;
    for (double& value : gradient) value = -value;
  }
  workspace.scatter(tractions, points, traction);
  workspace.scatter(gradient, points, slip);
  return report;
}

ContactSet PartialSlipSolver::prepared() const { return parts_->workspace.prepared(); }

}  // namespace salebra
