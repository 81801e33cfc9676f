// SPDX-License-Identifier: GPL-3.0-or-later
// One operating point of `salebra contact` by boundary elements, with or without adhesion.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/normal/distributions.hpp>  // analysis/ has no problem for it
#include <salebra/figures/figures.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/io/write_surface.hpp>

#include "answers.hpp"
#include "contact_command.hpp"
#include "option_words.hpp"
#include "results/describe.hpp"
#include "results/quantity_group.hpp"

namespace salebra::cli {
namespace {

OperatingPoint point_of(const ContactArguments& arguments, const Surface& surface) {
  if (!arguments.at.mean_gap.empty()) return at_mean_gap(arguments.at.mean_gap.front());
  if (!arguments.at.indentation.empty()) return at_indentation(arguments.at.indentation.front());
  return at_pressure(arguments.pressures_on(surface.grid.area()).front());
}

/// Whether cells at the edge of the surface are in contact, in any process.
bool reaches_edge(const Surface& surface, const Field& pressure) {
  const RowPartition partition = surface.partition();
  const Index rows = pressure.rows(), columns = pressure.cols();
  const bool reached =
      pressure.size() > 0 &&
      ((partition.begin() == 0 && (pressure.row(0) > 0).any()) ||
       (partition.end() == partition.rows() && (pressure.row(rows - 1) > 0).any()) ||
       (pressure.col(0) > 0).any() || (pressure.col(columns - 1) > 0).any());
  return !surface.communicator.all_agree(!reached);
}

void write_contact(const ContactArguments& arguments, const Session& session, const Grid2D& grid,
                   const AdhesiveContactState& state, const std::vector<CurveColumn>& beside,
                   const ContactDistributions& distributions) {
  const FieldType type = arguments.field_type == "float" ? FieldType::float32 : FieldType::float64;
  const bool has_pressure = arguments.fields != "none";
  const bool has_gap = has_pressure && arguments.fields != "pressure";
  std::optional<ResultFile> file;
  collectively(session.communicator(), [&] {
    file.emplace(session.output(), session.provenance(), session.write_options(),
                 session.communicator());
    QuantityGroup group(file->group("contact"));
    if (has_pressure) group.axes(grid);
    if (has_pressure) group.dataset("contact_pressure", state.contact_pressure, "x", "y", type);
    if (has_gap) group.dataset("gap", state.gap, "x", "y", type);
    if (has_gap && arguments.adhesive()) group.dataset("tension", state.tension, "x", "y", type);
    group.attribute("pressure", state.mean_pressure);
    for_each_number<NormalContactState>([&](const auto& number, const Quantity& quantity) {
      group.attribute(std::string(quantity.name), number(state));
    });
    for (const auto& [quantity, values] : beside)
      if (quantity.name == "direction" && values.size() > 1) group.coordinate("direction", values);
    for (const auto& [quantity, values] : beside)
      if (values.size() == 1)
        group.plain().attribute(std::string(quantity.name), values.front());
      else if (quantity.name != "direction")
        group.dataset(std::string(quantity.name), values, {"direction"});
    if (arguments.distributions) {
      QuantityGroup densities(file->group("distributions"));
      densities.coordinate("contact_pressure", distributions.contact_pressure);
      densities.dataset("pressure_density", distributions.pressure_density, {"contact_pressure"});
      densities.coordinate("gap", distributions.gap);
      densities.dataset("gap_density", distributions.gap_density, {"gap"});
    }
  });
  file->commit();
}

/// The largest contact pressure over all processes, Pa.
double max_pressure(const Communicator& communicator, const NormalContactState& state) {
  return -communicator.min_of(state.contact_pressure.size() > 0 ? -state.contact_pressure.maxCoeff()
                                                                : 0.0);
}

/// Reads the pressures of a file for the rows of this process.
Field read_initial(const std::string& file, const RowPartition& partition) {
  const ResultReader reader(file);
  const std::string pressure = "contact/contact_pressure";
  if (reader.has("contact") && !reader.has(pressure))
    throw InvalidInput(
        "--initial", file,
        "has no contact pressure; name a file that was written without --fields none");
  return reader.field(pressure, partition);
}

/// The steps from the surface to the answer at one operating point.
class OneContact {
 public:
  OneContact(const ContactArguments& arguments, Session& session)
      : arguments_(arguments),
        session_(session),
        body_(arguments.material.body_of_file()),
        material_(body_ ? Material{} : arguments.material.material()),
        options_(arguments.contact_options(session)),
        surface_(arguments.surface.read(session)) {
    if (arguments.hardness) options_.hardness = *arguments.hardness;
    for (const double pressure : arguments.pressures_on(surface_.grid.area()))
      if (!body_) session.warn_if(warning_of_pressure(pressure, material_.contact_modulus));
  }

  void press() {
    start();
    const auto start = std::chrono::steady_clock::now();
    if (arguments_.adhesive()) {
      AdhesiveContactOptions options = arguments_.adhesive_options(session_);
      options.contact.hardness = options_.hardness;
      const Body body = body_ ? *body_ : Body(material_);
      state_ = press_adhesive(surface_, body, point_of(arguments_, surface_), arguments_.adhesion(),
                              options);
      session_.warn_if(warning_of_process_zone(arguments_.adhesion(), surface_.grid, body));
    } else {
      const OperatingPoint point = point_of(arguments_, surface_);
      static_cast<NormalContactState&>(state_) =
          body_ ? salebra::press(surface_, *body_, point, options_)
                : salebra::press(surface_, material_.contact_modulus, point, options_);
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    seconds_ = elapsed.count();
    const bool kept = !state_.converged() && keep();
    if (state_.termination == Termination::interrupted)
      throw Interrupted(kept ? fmt::format("contact: interrupted; continue with --initial {}",
                                           arguments_.checkpoint.file)
                             : "contact: interrupted; nothing was written");
    if (options_.boundary == Boundary::free && reaches_edge(surface_, state_.contact_pressure))
      session_.warn(
          "the contact reaches the edge of the surface, where the surface ends; reduce the load or "
          "use a larger surface");
  }

  void answer() {
    answer_ = json_of(
        ContactPressures{state_.mean_pressure, max_pressure(session_.communicator(), state_)});
    answer_.add(json_of<NormalContactState>(state_));
    if (body_) answer_["datum"] = std::string(name_of(state_.datum));
    if (arguments_.adhesive()) add_adhesion();
    answer_["seconds"] = seconds_;
    if (state_.converged()) add_residual();
    if (state_.converged() && !state_.detached) {
      if (arguments_.wants_stiffness()) add_stiffness();
      if (arguments_.flow_factors) add_flow();
      if (arguments_.distributions) {
        distributions_ = contact_distributions(state_, surface_.grid, *arguments_.distributions);
        answer_["distributions"] = lists_of(distributions_);
      }
    }
    if (state_.converged() && session_.has_output())
      write_contact(arguments_, session_, surface_.grid, state_, beside_, distributions_);
    if (state_.converged() && session_.has_plot()) {
      figures::Figure figure = figures::figure_of(surface_.grid, state_);
      if (arguments_.hardness)
        figure.caption +=
            " Hardness: " + format_quantity(*arguments_.hardness, Dimension::pressure, 3) + ".";
      session_.plot(figure);
    }
    session_.answer(answer_);
    require_convergence();
    arguments_.checkpoint.remove(session_);
  }

 private:
  /// Reads the pressures of an earlier contact as start of the solve, if --initial was given.
  void start() {
    if (arguments_.checkpoint.starts_anew(session_, arguments_.initial)) {
      session_.inform(arguments_.initial +
                      " does not exist yet: the contact starts from the beginning");
    } else if (!arguments_.initial.empty()) {
      collectively(session_.communicator(),
                   [&] { initial_ = read_initial(arguments_.initial, surface_.partition()); });
      options_.initial_pressure = &initial_;
    }
    arguments_.checkpoint.add_to(options_, session_, surface_.grid);
  }

  bool keep() const {
    return arguments_.checkpoint.write(session_, surface_.grid, state_.contact_pressure);
  }

  template <class Found>
  void put_beside(const Found& found) {
    std::ranges::move(columns_beside(std::vector{found}), std::back_inserter(beside_));
  }

  void add_adhesion() {
    const AdhesionOfState& adhesion = state_;
    answer_.add(json_of(adhesion));
    put_beside(adhesion);
    if (body_) return;
    const MeanSummit summit =
        mean_summit(surface_, arguments_.adhesion(), material_.contact_modulus);
    answer_.add(json_of(summit));
    put_beside(summit);
  }

  void add_residual() {
    if (!arguments_.hardness) return;
    const double modulus = material_.contact_modulus;
    const ResidualSurface residual =
        arguments_.adhesive()
            ? residual_surface(surface_, modulus, state_, arguments_.adhesion(), options_)
            : residual_surface(surface_, modulus, state_, options_);
    if (!arguments_.residual.empty())
      write_surface(arguments_.residual, residual.surface, session_.provenance(),
                    session_.write_options());
    add_first_loading(answer_, residual.first_loading);
  }

  void add_stiffness() {
    const double area = surface_.grid.area();
    session_.warn(warnings_of_direction(arguments_, surface_));
    SweepOptions options{.contact = options_, .stick = arguments_.sticks()};
    if (arguments_.adhesive())
      options.contact.hardness = arguments_.adhesion().pressure_bound(options_.hardness);
    const std::vector<double> directions = arguments_.directions_on(surface_);
    const std::vector<ForceSample> samples =
        body_ ? force_samples(state_, surface_, *body_, options, directions)
              : force_samples(state_, surface_, material_, options, directions);
    const ForceSample& sample = samples.front();
    const Json columns = json_of(sample, area), rows = json_of(samples, area);
    for (const char* name : {"normal_stiffness", "normal_stiffness_per_area"}) {
      answer_[name] = columns[name];
      beside_.push_back({find_quantity(name), {columns[name].number()}});
    }
    for (const char* name : {"direction", "tangential_stiffness"}) {
      if (!std::isfinite(material_.tangential_modulus) || !rows.contains(name)) continue;
      answer_[name] = samples.size() == 1 ? columns[name] : rows[name];
      CurveColumn& column = beside_.emplace_back(find_quantity(name));
      for (const Json& value : rows[name].elements()) column.values.push_back(value.number());
    }
    if (!body_) {
      const Conductances found = arguments_.conductances_of(sample, area);
      answer_.add(conductances_json(found, arguments_.conduction));
      put_beside(found);
    }
    if (session_.stopped()) {
      keep();
      throw Interrupted("contact: interrupted; the stiffness was not computed");
    }
  }

  void add_flow() {
    flow_ = flow_of(state_, surface_, session_.progress());
    if (flow_.termination == Termination::interrupted)
      throw Interrupted("contact: interrupted; the flow factors were not computed");
    answer_.add(json_of(flow_));
    put_beside(flow_);
  }

  void require_convergence() const {
    const bool adhesive = arguments_.adhesive();
    if (!state_.converged())
      throw NotConverged(fmt::format("contact: residual {:.3g} after {} {} {}",
                                     adhesive ? state_.adhesion_residual : state_.residual,
                                     adhesive ? state_.outer_iterations : state_.iterations,
                                     adhesive ? "contacts" : "iterations",
                                     in_options(message(state_.termination))));
    if (!flow_.converged()) throw NotConverged(flow_failure);
  }

  const ContactArguments& arguments_;
  Session& session_;
  const std::optional<Body> body_;
  const Material material_;  ///< of a contact without body
  NormalContactOptions options_;
  const Surface surface_;
  Field initial_;
  AdhesiveContactState state_;
  double seconds_ = 0;
  Json answer_;
  std::vector<CurveColumn> beside_;  ///< columns of the file in addition to those of the state
  FlowFactors flow_;
  ContactDistributions distributions_;
};

}  // namespace

void press_once(const ContactArguments& arguments, Session& session) {
  OneContact contact(arguments, session);
  contact.press();
  contact.answer();
}

}  // namespace salebra::cli
