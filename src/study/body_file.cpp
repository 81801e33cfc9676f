// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a linear body from a TOML file.
#include <algorithm>
#include <array>
#include <cmath>
#include <salebra/base/enum_names.hpp>
#include <salebra/study/body_file.hpp>
#include <string>
#include <utility>
#include <vector>

#include "body_table.hpp"
#include "io/input_file.hpp"
#include "toml_reader.hpp"

namespace salebra {
namespace {

using detail::TomlTable;
using enum Dimension;

ElasticBody read_elastic(TomlTable& table) {
  return {table.required_quantity("young", pressure),
          table.required_quantity("poisson", dimensionless)};
}

Body read_layers(TomlTable& root, std::vector<TomlTable> tables) {
  std::vector<ElasticLayer> layers;
  for (TomlTable& table : tables) {
    const double thickness = table.required_quantity("thickness", length);
    const auto [young, poisson] = read_elastic(table);
    layers.push_back({thickness, young, poisson});
    table.require_no_other_keys();
    table.located([&] { Body::layered({layers.back()}); });
  }
  auto base = root.table("base");
  if (!base) return Body::layered(layers);
  const ElasticBody material = read_elastic(*base);
  base->check(material.young > 0, "young", "must be > 0; a rigid base of layers is left out");
  base->require_no_other_keys();
  return base->located([&] {
    return layers.empty() ? Body::half_space(material) : Body::layered(layers, material);
  });
}

Body read_graded(TomlTable table) {
  const GradedHalfSpace body{table.required_quantity("modulus", pressure),
                             table.required_quantity("depth", length),
                             table.required_quantity("exponent", dimensionless),
                             table.required_quantity("poisson", dimensionless)};
  table.require_no_other_keys();
  return table.located([&] { return Body::graded(body); });
}

std::array<double, 3> read_direction(TomlTable& table, const char* key) {
  const std::vector<double> given = table.values(key, dimensionless);
  table.check(given.size() == 3, key, "must be three numbers, such as [1, 1, 0]");
  return {given[0], given[1], given[2]};
}

Body read_anisotropic(TomlTable table) {
  const auto modulus = [&](const char* key) {
    table.check(table.has(key), key,
                "is missing; a cubic body needs c11, c12 and c44, a transversely isotropic one "
                "c11, c33, c13, c44 and c66, any other stiffness");
    return table.required_quantity(key, pressure);
  };
  const bool matrix = table.has("stiffness");
  if (!matrix && (table.has("c33") || table.has("c13") || table.has("c66"))) {
    table.check(
        !table.has("c12"), "c12",
        "is of a cubic body, but c33, c13 and c66 are of a transversely isotropic one; give "
        "one of them, the latter with c66 = (c11 - c12)/2");
    const TransverseStiffness stiffness{modulus("c11"), modulus("c33"), modulus("c13"),
                                        modulus("c44"), modulus("c66")};
    table.require_no_other_keys();
    return table.located([&] { return Body::transversely_isotropic(stiffness); });
  }
  AnisotropicStiffness stiffness;
  if (matrix) {
    const auto rows = table.rows("stiffness", pressure);
    const auto of_six = [](const std::vector<double>& row) { return row.size() == 6; };
    table.check(rows.size() == 6 && std::ranges::all_of(rows, of_six), "stiffness",
                "must be 6 rows of 6 numbers, in the order xx, yy, zz, yz, xz, xy");
    for (std::size_t i = 0; i < 6; ++i) std::ranges::copy(rows[i], stiffness.c[i].begin());
  } else {
    stiffness = AnisotropicStiffness::cubic(modulus("c11"), modulus("c12"), modulus("c44"));
  }
  if (table.has("normal") || table.has("x")) {
    for (const auto& [given, other] : {std::pair("normal", "x"), {"x", "normal"}})
      table.check(table.has(other), given,
                  std::string("is given without ") + other +
                      "; give both, such as normal = [1, 1, 0] and x = [0, 0, 1]");
    const auto normal = read_direction(table, "normal"), x = read_direction(table, "x");
    stiffness = table.located([&] { return stiffness.of_surface(normal, x); });
  }
  table.require_no_other_keys();
  return table.located([&] { return Body::anisotropic(stiffness); });
}

PronySeries read_relaxation(std::vector<TomlTable> tables) {
  PronySeries series{.relaxed_modulus = 1, .terms = {}};
  for (TomlTable& table : tables) {
    const double weight = table.required_quantity("weight", dimensionless),
                 duration = table.required_quantity("time", Dimension::time);
    for (const auto& [key, value] : {std::pair("weight", weight), {"time", duration}})
      table.check(std::isfinite(value) && value > 0, key, "must be > 0; leave the term out");
    table.require_no_other_keys();
    series.terms.push_back({weight, duration});
  }
  return series;
}

TomlTable parse(const std::filesystem::path& file) {
  constexpr std::uint64_t most = 4 << 20;
  return TomlTable::parse(detail::InputFile(file).content(most), file.string());
}

Body read_elastic_keys(TomlTable& root) {
  const auto chosen = root.choice("datum", names_of<Datum>());
  const Datum datum = chosen ? EnumNames<Datum>::values[*chosen].first : Datum::mean_plane;
  const bool layered = root.has("layer") || root.has("base");
  const bool graded = root.has("graded"), anisotropic = root.has("anisotropic");
  root.check(layered + graded + anisotropic == 1,
             graded        ? "graded"
             : anisotropic ? "anisotropic"
                           : "layer",
             "a file describes one body; give [[layer]] with an optional [base], [base] alone, "
             "[graded] or [anisotropic]");
  const Body body = graded        ? read_graded(root.required_table("graded"))
                    : anisotropic ? read_anisotropic(root.required_table("anisotropic"))
                                  : read_layers(root, root.tables("layer"));
  root.require_no_other_keys();
  return root.located([&] { return body.measured_from(datum); });
}

Body read_elastic_body(TomlTable& root) {
  root.check(!root.has("relaxation"), "relaxation",
             "an elastic body is needed here, and this one relaxes; leave [[relaxation]] out, or "
             "compute a viscoelastic contact");
  return read_elastic_keys(root);
}

}  // namespace

Body read_body(const std::filesystem::path& file) {
  TomlTable root = parse(file);
  return read_elastic_body(root);
}

Body detail::read_body_table(TomlTable& table, const std::filesystem::path& folder) {
  const auto file = table.text("file");
  if (!file) return read_elastic_body(table);
  for (const char* key : {"datum", "layer", "base", "graded", "anisotropic"})
    table.check(!table.has(key), key, "belongs into the file of `file`; move it there");
  table.require_no_other_keys();
  try {
    return read_body(folder / *file);
  } catch (const InvalidInput& error) {
    table.fail("file", error);
  }
}

ViscoelasticBody read_viscoelastic_body(const std::filesystem::path& file) {
  TomlTable root = parse(file);
  PronySeries relaxation = read_relaxation(root.tables("relaxation"));
  return {read_elastic_keys(root), std::move(relaxation)};
}

}  // namespace salebra
