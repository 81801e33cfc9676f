// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/normal/adhesive_cycle.hpp>
#include <salebra/contact/normal/flow_factors.hpp>
#include <salebra/contact/sweep.hpp>  // analysis/ takes one process only
#include <salebra/results/force_curve_file.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "answers.hpp"
#include "contact_checkpoint.hpp"
#include "options.hpp"
#include "results/columns.hpp"

/// Arguments of `salebra contact`, and its answers for one operating point, for several, and by the
/// theory of Greenwood and Williamson.
namespace salebra::cli {

struct ContactArguments {
  const Command* command = nullptr;
  std::string csv;  ///< table of several surfaces
  SurfaceOptions surface;
  MaterialOptions material;
  std::string model = "bem";

  OperatingPointsOptions at;

  std::string boundary = "periodic", precision = "mixed";
  bool stiffness = false, stick = false;
  std::string direction = "auto";  ///< of K_t
  bool flow_factors = false;
  std::optional<int> distributions;  ///< number of bins of the distributions of pressure and gap
  Conduction conduction;
  std::optional<double> work_of_adhesion, adhesion_range;
  std::string potential = "exponential";
  bool cycle = false, force_coarse = false;
  std::optional<double> tolerance, hardness;
  int max_iterations = NormalContactOptions().max_iterations;
  int groups = 0;  ///< groups of processes that share the loads; 0: as many as memory allows
  DryRunOptions dry_run;

  std::string initial, residual, fields, field_type;
  ContactCheckpoint checkpoint;

  std::optional<double> summit_density, radius, summit_rms;
  std::string distribution = "gaussian";

  /// Number of operating points. Throws InvalidInput unless all are given by the same control
  /// quantity and, without adhesion, are > 0.
  std::size_t count() const;
  /// Nominal pressures, sorted, Pa, if the operating points are pressures or forces; empty
  /// otherwise. area: nominal area, m².
  std::vector<double> pressures_on(double area) const;
  /// Whether K_t is computed in full stick; for a body always, since no ratio of moduli gives it.
  bool sticks() const { return stick || !material.body_file.empty(); }
  NormalContactOptions contact_options(Session& session) const;
  bool adhesive() const { return work_of_adhesion.has_value(); }
  Adhesion adhesion() const;
  AdhesiveContactOptions adhesive_options(Session& session) const;
  bool wants_stiffness() const { return stiffness || conduction.given(); }
  /// Directions of K_t on a surface, rad. Collective.
  std::vector<double> directions_on(const Surface& surface) const;
  /// Returns the conductances of a sample of the curve, per nominal area.
  Conductances conductances_of(const ForceSample& sample, double nominal_area) const;
};

/// Returns a warning if the tangential stiffness is requested without a stick solve and the surface
/// has a lay, on which it depends. Collective.
std::vector<std::string> warnings_of_direction(const ContactArguments& arguments,
                                               const Surface& surface);
/// Answers with the state of the surface at one operating point, by boundary elements.
void press_once(const ContactArguments& arguments, Session& session);
/// Answers with the force curve of the surface at several pressures, by boundary elements.
void press_often(const ContactArguments& arguments, Session& session);
/// Solves contacts with adhesion at several operating points in loading, each from the one before,
/// and then in unloading.
void press_adhesively(const ContactArguments& arguments, Session& session);
/// Answers with the force curve of summits by a Greenwood–Williamson model, with the summits of a
/// surface or from given parameters.
void press_summits(const ContactArguments& arguments, Session& session);

/// JSON of one or several conductances, as far as they were requested.
template <class Found>
Json conductances_json(const Found& found, const Conduction& asked) {
  Json object = json_of(found);
  if (asked.conductivity.empty()) object.erase("thermal_conductance");
  if (asked.resistivity.empty()) object.erase("electrical_conductance");
  return object;
}
inline constexpr const char* flow_failure =
    "contact: flow factors that are null although the gap percolates did not converge, as happens "
    "close to the load at which it closes; the other numbers are valid";
/// Computes the flow factors of a converged state of a surface, also across and along its lay if it
/// has one. Factors whose solve did not converge are unknown.
FlowFactors flow_of(const NormalContactState& state, const Surface& surface,
                    const Progress& progress);
/// Adds the requested quantities to the columns of the JSON answer, and returns them as columns of
/// the file. flow: flow factors of each sample; empty if they were not requested.
std::vector<CurveColumn> add_beside(const ContactArguments& arguments, const ForceCurve& curve,
                                    const std::vector<FlowFactors>& flow, Json& columns);
/// Writes the file of the curve and prints the answer, with the conductances if they were
/// requested. answer: contains the key `curve` and the other results of the command.
void answer_curve(const ContactArguments& arguments, const ForceCurve& curve, Json answer,
                  Session& session, const std::vector<FlowFactors>& flow = {});

/// JSON with a list for each column of ForceSample. Separation and stiffnesses per area are left
/// out if no sample has them.
Json to_json(const ForceCurve& curve);

/// Prints the estimated cost of the contacts, for --dry-run.
void estimate_contacts(const ContactArguments& arguments, Session& session);
/// Number of groups of processes among which the loads are divided. All processes must call.
int contact_groups(const ContactArguments& arguments, Session& session);

}  // namespace salebra::cli
