// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <salebra/io/cycle_fields.hpp>
#include <salebra/io/result_file.hpp>

#include "atomic_file.hpp"

namespace salebra {
namespace {

struct FieldName {
  const char* name;
  const char* units;
  const char* text;
};
constexpr std::array field_names{
    FieldName{"contact", "1", "1 in contact"},
    FieldName{"traction_x", "Pa", "shear traction along x"},
    FieldName{"traction_y", "Pa", "shear traction along y"},
    FieldName{"displacement_x", "m", "displacement of cells in contact along x"},
    FieldName{"displacement_y", "m", "displacement of cells in contact along y"},
    FieldName{"pressure", "Pa", "pressure"},
    FieldName{"gap", "m", "gap between the deformed surfaces"}};

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
  for (Index ix = 0; ix < grid_.nx; ++ix) x_.push_back(static_cast<double>(ix) * grid_.dx());
  for (Index iy = 0; iy < grid_.ny; ++iy) y_.push_back(static_cast<double>(iy) * grid_.dy());
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
  mesh.dataset("heights", heights_, "x", "y", "m", "height, a hill is positive");
  file.commit();
}

std::filesystem::path CycleFields::frame_file(int step) const {
  return with_ending(prefix_, fmt::format("-{:04}.h5", step));
}

void CycleFields::write(const CycleState& state, double time, const NormalContactState& normal) {
  const bool pressed = normal.pressure.size() > 0;
  const Field nothing = Field::Zero(grid_.nx, grid_.ny);
  const std::array<Field, field_names.size()> values{
      state.contact.cast<double>(),
      state.traction.x,
      state.traction.y,
      state.displacement.x,
      state.displacement.y,
      pressed ? normal.pressure : nothing,
      pressed ? normal.gap : Field(heights_.maxCoeff() - heights_)};
  ResultFile file(frame_file(state.step), provenance_, {.overwrite = true});
  ResultGroup fields = file.group("fields");
  fields.coordinate("x", x_, "m", "position along x");
  fields.coordinate("y", y_, "m", "position along y");
  for (std::size_t k = 0; k < values.size(); ++k)
    fields.dataset(field_names[k].name, values[k], "x", "y", field_names[k].units,
                   field_names[k].text);
  fields.attribute("step", state.step);
  fields.attribute("time", time);
  file.commit();
  add(state.step, time);
}

void CycleFields::keep(int step, double time) {
  if (std::filesystem::exists(frame_file(step))) add(step, time);
}

void CycleFields::add(int step, double time) {
  std::erase_if(frames_, [&](const Frame& frame) { return frame.step == step; });
  frames_.push_back({step, time});
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
  const auto attribute = [&](const char* name, const std::string& data) {
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
    for (const FieldName& field : field_names)
      attribute(field.name, item(frame_file(frame.step), std::string("/fields/") + field.name, ""));
    attribute("heights", item(mesh, "/mesh/heights", ""));
    text += "   </Grid>\n";
  }
  text += "  </Grid>\n </Domain>\n</Xdmf>\n";
  detail::AtomicFile file(with_ending(prefix_, ".xdmf"), {.overwrite = true});
  file.write(text);
  file.commit();
}

}  // namespace salebra
