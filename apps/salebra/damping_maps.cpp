// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of `salebra damping`: stresses under an indenter, and the loss with friction divided by the
// loss without slip.
#include "damping_maps.hpp"

#include <salebra/base/error.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/result_file.hpp>

#include "options.hpp"
#include "results/quantity_group.hpp"

namespace salebra::cli {
namespace {

const IndenterLaw& indenter_of(const DampingSolution& answer, const std::string& file) {
  const auto* law = dynamic_cast<const IndenterLaw*>(answer.contact.law.get());
  require(law != nullptr, "--stress-map", file, "needs an indenter; give --law with a shape");
  return *law;
}

void write_stress_map(const MapOptions& options, const DampingSolution& answer, Session& session) {
  const IndenterLaw& law = indenter_of(answer, options.stress_map);
  const StressMap map = stress_map_of(answer, options.phases, options.radii, session.context());
  ResultFile file(options.stress_map, session.provenance(), session.write_options());
  QuantityGroup group(file.group("stress_map"));
  group.coordinate("angle", map.angle);
  group.coordinate("radial_position", map.radial_position);
  group.dataset("contact_radius", map.contact_radius, {"angle"});
  group.dataset("tangential_force", map.tangential_force, {"angle"});
  group.dataset("shear", map.shear, "angle", "radial_position");
  group.dataset("contact_pressure", map.contact_pressure, "angle", "radial_position");
  if (session.has_plot() && options.friction_map.empty())
    session.plot(figures::figure_of(law, answer.results.front().indentation,
                                    *oscillation_of(answer.motions.front()), map));
  file.commit();
}

void write_friction_map(const MapOptions& options, const DampingSolution& answer, int steps,
                        Session& session) {
  const FrictionMap map =
      friction_map_of(answer, options.friction_numbers, steps, session.context());
  ResultFile file(options.friction_map, session.provenance(), session.write_options());
  QuantityGroup group(file.group("friction_map"));
  group.coordinate("friction_number", map.friction_number);
  group.coordinate("phase", map.phase);
  group.dataset("loss_ratio", map.loss_ratio, "friction_number", "phase");
  group.dataset("relaxation_ratio", map.relaxation_ratio, "friction_number", "phase");
  group.dataset("slip_ratio", map.slip_ratio, "friction_number", "phase");
  if (session.has_plot()) session.plot(figures::figure_of(map));
  file.commit();
}

}  // namespace

void MapOptions::add_to(Command& command) {
  const std::string group = "Maps";
  command
      .add_option("--stress-map", stress_map,
                  "HDF5 file for the stresses under an indenter over r and phase")
      ->file(FileUse::output)
      ->group(group);
  command
      .add_option("--friction-map", friction_map,
                  "HDF5 file for W(mu)/W(infinity) over M and phase")
      ->file(FileUse::output)
      ->group(group);
  command.add_option("--map-phases", phases, "number of phases in the stress map; default 256")
      ->range(8, 100000)
      ->group(group);
  command.add_option("--map-radii", radii, "number of radii in the stress map; default 400")
      ->range(8, 100000)
      ->group(group);
  add_values(command, "--friction-numbers", friction_numbers, Dimension::dimensionless,
             "values of M in the friction map; default 0.1:100:25")
      ->group(group);
}

void MapOptions::check(const std::vector<Motion>& motions, const Session& session) const {
  for (const auto& [option, path] :
       {std::pair("--stress-map", &stress_map), {"--friction-map", &friction_map}}) {
    if (path->empty()) continue;
    require_output(*path, session.write_options());
    require(motions.size() == 1, option, *path, "needs a single motion");
  }
  if (!given()) return;
  const Motion& motion = motions.front();
  require(stress_map.empty() || !std::holds_alternative<TwoFrequencies>(motion), "--stress-map",
          stress_map, "needs a single period; use --mode equal-frequency or drag");
  require(friction_map.empty() || std::holds_alternative<EqualFrequency>(motion), "--friction-map",
          friction_map, "is a map over the phase; use --mode equal-frequency");
}

void MapOptions::write(const DampingSolution& answer, int steps, Session& session) const {
  if (!stress_map.empty()) write_stress_map(*this, answer, session);
  if (!friction_map.empty()) write_friction_map(*this, answer, steps, session);
}

}  // namespace salebra::cli
