// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of `damping`: stresses under an indenter, and W(mu)/W(infinity).
#include "damping_maps.hpp"

#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/result_file.hpp>

#include "figures.hpp"
#include "options.hpp"
#include "results/quantity_group.hpp"

namespace salebra::cli {
namespace {

const IndenterLaw& indenter_of(const DampingAnswer& answer, const std::string& file) {
  const auto* law = dynamic_cast<const IndenterLaw*>(answer.contact.law.get());
  require(law != nullptr, "--stress-map", file, "is of an indenter; give --law with a shape");
  return *law;
}

void write_stress_map(const MapOptions& options, const IndenterLaw& law, double indentation,
                      const Oscillation& motion, Session& session) {
  const StressMap map =
      stress_map(law, indentation, motion, options.phases, options.radii, session.progress());
  ResultFile file(options.stress_map, session.provenance(), session.write_options());
  QuantityGroup group(file.group("stress_map"));
  group.coordinate("angle", map.angle);
  group.coordinate("radial_position", map.radial_position);
  group.dataset("contact_radius", map.contact_radius, {"angle"});
  group.dataset("tangential_force", map.tangential_force, {"angle"});
  group.dataset("shear", map.shear, "angle", "radial_position");
  group.dataset("contact_pressure", map.contact_pressure, "angle", "radial_position");
  if (session.has_plot() && options.friction_map.empty())
    session.plot(stress_figure(law, indentation, motion, map));
  file.commit();
}

void write_friction_map(const MapOptions& options, const ContactLaw& law, double indentation,
                        const EqualFrequency& motion, int steps, Session& session) {
  std::vector<double> numbers = options.friction_numbers, phases;
  if (numbers.empty())
    for (int i = 0; i <= 24; ++i) numbers.push_back(std::pow(10.0, -1 + i / 8.0));
  for (int i = 1; i <= 18; ++i) phases.push_back(std::numbers::pi / 36 * i);
  const FrictionMap map =
      friction_map(law, indentation, motion.normal_amplitude, motion.tangential_amplitude, numbers,
                   phases, {.steps = steps, .on_progress = session.progress()});
  ResultFile file(options.friction_map, session.provenance(), session.write_options());
  QuantityGroup group(file.group("friction_map"));
  group.coordinate("friction_number", numbers);
  group.coordinate("phase", phases);
  group.dataset("loss_ratio", map.loss_ratio, "friction_number", "phase");
  group.dataset("relaxation_ratio", map.relaxation_ratio, "friction_number", "phase");
  group.dataset("slip_ratio", map.slip_ratio, "friction_number", "phase");
  if (session.has_plot()) session.plot(friction_figure(map));
  file.commit();
}

}  // namespace

void MapOptions::add_to(Command& command) {
  const std::string group = "Maps";
  command
      .add_option("--stress-map", stress_map,
                  "HDF5 file for stresses under an indenter over r and phase")
      ->file(FileUse::output)
      ->group(group);
  command
      .add_option("--friction-map", friction_map,
                  "HDF5 file for W(mu)/W(infinity) over M and phase")
      ->file(FileUse::output)
      ->group(group);
  command.add_option("--map-phases", phases, "of the stress map; default 256")
      ->range(8, 100000)
      ->group(group);
  command.add_option("--map-radii", radii, "of the stress map; default 400")
      ->range(8, 100000)
      ->group(group);
  add_values(command, "--friction-numbers", friction_numbers, Dimension::dimensionless,
             "M of the map; default 0.1:100:25")
      ->group(group);
}

void MapOptions::check(const std::vector<Motion>& motions, const Session& session) const {
  for (const auto& [option, path] :
       {std::pair("--stress-map", &stress_map), {"--friction-map", &friction_map}}) {
    if (path->empty()) continue;
    require_output(*path, session.write_options());
    require(motions.size() == 1, option, *path, "is of one motion");
  }
  if (!given()) return;
  const Motion& motion = motions.front();
  require(stress_map.empty() || !std::holds_alternative<TwoFrequencies>(motion), "--stress-map",
          stress_map, "is of a single cycle; use --mode equal-frequency or drag");
  require(friction_map.empty() || std::holds_alternative<EqualFrequency>(motion), "--friction-map",
          friction_map, "is over the phase; use --mode equal-frequency");
}

void MapOptions::write(const DampingAnswer& answer, int steps, Session& session) const {
  const Motion& motion = answer.motions.front();
  const double indentation = answer.results.front().indentation;
  if (!stress_map.empty())
    write_stress_map(*this, indenter_of(answer, stress_map), indentation, *oscillation_of(motion),
                     session);
  if (!friction_map.empty())
    write_friction_map(*this, *answer.contact.law, indentation, std::get<EqualFrequency>(motion),
                       steps, session);
}

}  // namespace salebra::cli
