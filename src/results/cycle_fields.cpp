// SPDX-License-Identifier: GPL-3.0-or-later
// Writes pressure, traction and slip fields at chosen steps of a cycle, one file for each step, and
// an XDMF file that lists these files.
#include "cycle_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <salebra/damping/cycle_state.hpp>
#include <salebra/io/result_file.hpp>

#include "io/atomic_file.hpp"
#include "quantity_group.hpp"

namespace salebra {
namespace {

std::filesystem::path with_ending(const std::filesystem::path& prefix, const std::string& ending) {
  std::filesystem::path file = prefix;
  file += ending;
  return file;
}

std::filesystem::path list_file(const std::filesystem::path& prefix) {
  return with_ending(prefix, ".xdmf");
}

std::filesystem::path mesh_file(const std::filesystem::path& prefix) {
  return with_ending(prefix, "-mesh.h5");
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else
      result += c;
  }
  return result;
}

}  // namespace

CycleFields::CycleFields(std::filesystem::path prefix, const Surface& surface,
                         Provenance provenance, const WriteOptions& options)
    : prefix_(std::move(prefix)),
      grid_(surface.grid),
      heights_(surface.heights),
      provenance_(std::move(provenance)) {
  surface.require_whole("fields of an oscillating contact");
  require_output(list_file(prefix_), options);
  std::vector<double> points;
  points.reserve(static_cast<std::size_t>(3 * grid_.points()));
  for (const double x : positions(grid_.nx, grid_.dx()))
    for (const double y : positions(grid_.ny, grid_.dy())) points.insert(points.end(), {x, y, 0.0});
  ResultFile file(mesh_file(prefix_), provenance_, {.overwrite = true});
  QuantityGroup mesh(file.group("mesh"));
  mesh.axes(grid_);
  mesh.plain().labels("component", {"x", "y", "z"}, "component of a point");
  mesh.dataset("cells", points, {"x", "y", "component"});
  mesh.dataset("heights", heights_);
  file.commit();
}

std::filesystem::path CycleFields::frame_file(const std::filesystem::path& prefix, int step) {
  return with_ending(prefix, fmt::format("-{:04}.h5", step));
}

std::vector<std::filesystem::path> CycleFields::files(const std::filesystem::path& prefix,
                                                      const std::vector<int>& steps) {
  std::vector<std::filesystem::path> names{list_file(prefix), mesh_file(prefix)};
  for (const int step : steps) names.push_back(frame_file(prefix, step));
  return names;
}

void CycleFields::write(const CycleState& state, double time, const NormalContactState& normal) {
  const auto* stuck = std::get_if<StuckState>(&state.body);
  const auto* coupled = std::get_if<CoupledState>(&state.body);
  const SlidingState* sliding =
      coupled ? &coupled->sliding : std::get_if<SlidingState>(&state.body);
  const TangentialField& traction = stuck ? stuck->traction : sliding->traction;
  const TangentialField& displacement = stuck ? stuck->displacement : sliding->displacement;
  Field pressure = sliding ? sliding->contact_pressure : normal.contact_pressure;
  if (pressure.size() == 0) pressure = Field::Zero(grid_.nx, grid_.ny);
  CycleFrame frame{.contact = stuck ? Field(stuck->contact.cast<double>())
                                    : Field((sliding->contact_pressure > 0).cast<double>()),
                   .traction_x = traction.x,
                   .traction_y = traction.y,
                   .displacement_x = displacement.x,
                   .displacement_y = displacement.y,
                   .contact_pressure = std::move(pressure),
                   .gap = coupled ? coupled->gap : gap_of(normal),
                   .loss = {}};
  if (sliding) frame.loss = (sliding->loss - state.loss_at_period_start) / grid_.cell_area();

  ResultFile file(frame_file(state.step), provenance_, {.overwrite = true});
  QuantityGroup fields(file.group("fields"));
  fields.axes(grid_);
  std::vector<std::string> names;
  for_each_column<CycleFrame>([&](const auto& column, const Quantity& quantity) {
    const Field& field = column(frame);
    if (field.size() == 0) return;
    fields.dataset(names.emplace_back(quantity.name), field);
  });
  fields.plain().attribute("step", state.step);
  fields.attribute("time_in_periods", time);
  file.commit();
  add(state.step, time, std::move(names));
}

Field CycleFields::gap_of(const NormalContactState& normal) const {
  return normal.gap.size() > 0 ? normal.gap : Field(heights_.maxCoeff() - heights_);
}

void CycleFields::keep(int step, double time) {
  if (!std::filesystem::exists(frame_file(step))) return;
  std::vector<std::string> names = ResultReader(frame_file(step)).datasets("fields");
  std::erase_if(names, [](const std::string& name) { return name == "x" || name == "y"; });
  add(step, time, std::move(names));
}

void CycleFields::add(int step, double time, std::vector<std::string> fields) {
  std::erase_if(frames_, [&](const Frame& frame) { return frame.step == step; });
  frames_.push_back({step, time, std::move(fields)});
  std::ranges::sort(frames_, {}, &Frame::step);
  write_list();
}

void CycleFields::write_list() const {
  // XDMF lists the dimensions of an array from the slowest index on. y is contiguous in these
  // arrays, so nx comes before ny.
  const auto item = [&](const std::filesystem::path& file, const std::string& dataset,
                        const char* components) {
    return fmt::format(
        "<DataItem Dimensions=\"{} {}{}\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">"
        "{}:{}</DataItem>",
        grid_.nx, grid_.ny, components, escaped(file.filename().string()), dataset);
  };
  const std::filesystem::path mesh = mesh_file(prefix_);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n <Domain>\n"
      "  <Grid Name=\"cycle\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  const auto attribute = [&](const std::string& name, const std::string& data) {
    text += fmt::format(
        "    <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Node\">{}</Attribute>\n",
        name, data);
  };
  for (const Frame& frame : frames_) {
    text += fmt::format(
        "   <Grid Name=\"step {}\" GridType=\"Uniform\">\n    <Time Value=\"{}\"/>\n"
        "    <Topology TopologyType=\"2DSMesh\" Dimensions=\"{} {}\"/>\n"
        "    <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
        frame.step, frame.time, grid_.nx, grid_.ny, item(mesh, "/mesh/cells", " 3"));
    for (const std::string& name : frame.fields)
      attribute(name, item(frame_file(frame.step), "/fields/" + name, ""));
    attribute("heights", item(mesh, "/mesh/heights", ""));
    text += "   </Grid>\n";
  }
  text += "  </Grid>\n </Domain>\n</Xdmf>\n";
  detail::AtomicFile file(list_file(prefix_), {.overwrite = true});
  file.write(text);
  file.commit();
}

}  // namespace salebra
