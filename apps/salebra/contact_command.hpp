// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/contact/normal/adhesive_cycle.hpp>
#include <salebra/contact/normal/flow_factors.hpp>
#include <salebra/contact/sweep.hpp>  // processes that share a surface have this face alone
#include <salebra/results/force_curve_file.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "answers.hpp"
#include "contact_checkpoint.hpp"
#include "options.hpp"
#include "results/columns.hpp"

/// What `contact` was given, and its answers for one operating point, for several, and by the theory of
/// Greenwood and Williamson.
namespace salebra::cli {

struct ContactArguments {
  const Command* command = nullptr;
  SurfaceOptions surface;
  MaterialOptions material;
  std::string model = "bem";

  OperatingPointsOptions at;

  std::string boundary = "periodic", precision = "mixed";
  bool stiffness = false, stick = false;
  bool flow_factors = false;
  std::optional<int> distributions;  ///< bins
  Conduction conduction;
  std::optional<double> work_of_adhesion, adhesion_range;
  std::string potential = "exponential";
  bool cycle = false, force_coarse = false;
  std::optional<double> tolerance, hardness;
  int max_iterations = NormalContactOptions().max_iterations;
  int groups = 0;  ///< 0: as many as memory holds
  DryRunOptions dry_run;

  std::string initial, residual, fields, field_type;
  ContactCheckpoint checkpoint;

  std::optional<double> summit_density, radius, summit_rms;
  std::string distribution = "gaussian";

  /// The number of operating points. Throws InvalidInput unless they are of one kind and, without adhesion, > 0.
  std::size_t count() const;
  /// p, Pa, of pressures and forces, from the lowest; empty for other operating points.
  std::vector<double> pressures_on(double area) const;
  NormalContactOptions contact_options(Session& session) const;
  bool adhesive() const { return work_of_adhesion.has_value(); }
  Adhesion adhesion() const;
  AdhesiveContactOptions adhesive_options(Session& session) const;
  bool wants_stiffness() const { return stiffness || conduction.given(); }
  /// Returns the conductances of a sample of the curve, per nominal area.
  Conductances conductances_of(const ForceSample& sample, double nominal_area) const;
};

/// The state of the surface at one operating point, by boundary elements.
void press_once(const ContactArguments& arguments, Session& session);
/// The force curve of the surface at several pressures, by boundary elements.
void press_often(const ContactArguments& arguments, Session& session);
/// Several operating points with adhesion, each from the one before, and back.
void press_adhesively(const ContactArguments& arguments, Session& session);
/// The force curve of summits, those of the surface or of parameters.
void press_summits(const ContactArguments& arguments, Session& session);

/// One or several conductances, without those that were not asked about.
template <class Found>
Json conductances_json(const Found& found, const Conduction& asked) {
  Json object = json_of(found);
  if (asked.conductivity.empty()) object.erase("thermal_conductance");
  if (asked.resistivity.empty()) object.erase("electrical_conductance");
  return object;
}
inline constexpr const char* flow_failure =
    "contact: flow factors that are null where the gap percolates did not converge, as happens "
    "close to the load at which it closes; the other numbers stand";
/// The flow factors of a converged state; those that did not converge are unknown.
FlowFactors flow_of(const NormalContactState& state, const Grid2D& grid, const Progress& progress);
/// Adds to the columns what was asked about beside the curve, and returns it.
/// flow: of each sample; empty: not asked
std::vector<CurveColumn> add_beside(const ContactArguments& arguments, const ForceCurve& curve,
                                    const std::vector<FlowFactors>& flow, Json& columns);
/// Writes the curve and answers, with the conductances where they were asked about.
/// answer: has the `curve`, and what the command says beside it.
void answer_curve(const ContactArguments& arguments, const ForceCurve& curve, Json answer,
                  Session& session, const std::vector<FlowFactors>& flow = {});

/// A list for each column of ForceSample, without separation and stiffnesses per area where no
/// sample has them.
Json to_json(const ForceCurve& curve);

/// Answers --dry-run.
void estimate_contacts(const ContactArguments& arguments, Session& session);
/// Groups of processes that share the loads of several operating points. Collective.
int contact_groups(const ContactArguments& arguments, Session& session);

}  // namespace salebra::cli
