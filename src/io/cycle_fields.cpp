// SPDX-License-Identifier: GPL-3.0-or-later
// Pressure, traction and slip fields of chosen steps of a cycle, one file a frame, with a list.
#include <fmt/format.h>

#include <algorithm>
#include <salebra/io/cycle_fields.hpp>
#include <salebra/io/result_file.hpp>

#include "atomic_file.hpp"

namespace salebra {
namespace {

std::filesystem::path with_ending(const std::filesystem::path& prefix, const std::string& ending) {
  std::filesystem::path file = prefix;
  file += ending;
  return file;
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
  require_output(with_ending(prefix_, ".xdmf"), options);
  x_ = positions(grid_.nx, grid_.dx());
  y_ = positions(grid_.ny, grid_.dy());
  std::vector<double> points;
  points.reserve(static_cast<std::size_t>(3 * grid_.points()));
  for (const double x : x_)
    for (const double y : y_) points.insert(points.end(), {x, y, 0.0});
  ResultFile file(with_ending(prefix_, "-mesh.h5"), provenance_, {.overwrite = true});
  ResultGroup mesh = file.group("mesh");
  mesh.coordinate("x", x_, "m", "position along x");
  mesh.coordinate("y", y_, "m", "position along y");
  mesh.labels("component", {"x", "y", "z"}, "component of a point");
  mesh.dataset("points", points, {"x", "y", "component"}, "m", "middles of the cells");
  mesh.dataset("heights", heights_, "x", "y", "m", "height, positive out of the material");
  file.commit();
}

std::filesystem::path CycleFields::frame_file(int step) const {
  return with_ending(prefix_, fmt::format("-{:04}.h5", step));
}

void CycleFields::write(const CycleState& state, double time, const NormalContactState& normal) {
  const bool pressed = normal.pressure.size() > 0;
  write_frame(
      state.step, time,
      {{"contact", "1", "1 in contact", state.contact.cast<double>()},
       {"traction_x", "Pa", "shear traction along x", state.traction.x},
       {"traction_y", "Pa", "shear traction along y", state.traction.y},
       {"displacement_x", "m", "displacement of cells in contact along x", state.displacement.x},
       {"displacement_y", "m", "displacement of cells in contact along y", state.displacement.y},
       {"pressure", "Pa", "pressure",
        pressed ? normal.pressure : Field(Field::Zero(grid_.nx, grid_.ny))},
       {"gap", "m", "gap between the deformed surfaces", gap_of(normal)}});
}

void CycleFields::write(const FrictionalCycleState& state, double time,
                        const NormalContactState& normal) {
  const SlidingState& contact = state.contact;
  write_frame(
      state.step, time,
      {{"contact", "1", "1 in contact", (contact.pressure > 0).cast<double>()},
       {"traction_x", "Pa", "shear traction along x", contact.traction.x},
       {"traction_y", "Pa", "shear traction along y", contact.traction.y},
       {"displacement_x", "m", "displacement of cells in contact along x", contact.displacement.x},
       {"displacement_y", "m", "displacement of cells in contact along y", contact.displacement.y},
       {"pressure", "Pa", "pressure", contact.pressure},
       {"gap", "m", "gap between the deformed surfaces", gap_of(normal)},
       {"loss", "J/m^2", "energy dissipated by unit area since the start of the period",
        (contact.loss - state.loss_at_period_start) / grid_.cell_area()}});
}

Field CycleFields::gap_of(const NormalContactState& normal) const {
  return normal.gap.size() > 0 ? normal.gap : Field(heights_.maxCoeff() - heights_);
}

void CycleFields::write_frame(int step, double time, const std::vector<Values>& values) {
  ResultFile file(frame_file(step), provenance_, {.overwrite = true});
  ResultGroup fields = file.group("fields");
  fields.coordinate("x", x_, "m", "position along x");
  fields.coordinate("y", y_, "m", "position along y");
  std::vector<std::string> names;
  for (const Values& field : values) {
    fields.dataset(field.name, field.values, "x", "y", field.units, field.text);
    names.emplace_back(field.name);
  }
  fields.attribute("step", step);
  fields.attribute("time", time);
  file.commit();
  add(step, time, std::move(names));
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
  // XDMF counts dimensions from the slowest: nx ny for arrays with y contiguous.
  const auto item = [&](const std::filesystem::path& file, const std::string& dataset,
                        const char* components) {
    return fmt::format(
        "<DataItem Dimensions=\"{} {}{}\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">"
        "{}:{}</DataItem>",
        grid_.nx, grid_.ny, components, escaped(file.filename().string()), dataset);
  };
  const std::filesystem::path mesh = with_ending(prefix_, "-mesh.h5");
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
        frame.step, frame.time, grid_.nx, grid_.ny, item(mesh, "/mesh/points", " 3"));
    for (const std::string& name : frame.fields)
      attribute(name, item(frame_file(frame.step), "/fields/" + name, ""));
    attribute("heights", item(mesh, "/mesh/heights", ""));
    text += "   </Grid>\n";
  }
  text += "  </Grid>\n </Domain>\n</Xdmf>\n";
  detail::AtomicFile file(with_ending(prefix_, ".xdmf"), {.overwrite = true});
  file.write(text);
  file.commit();
}

}  // namespace salebra
