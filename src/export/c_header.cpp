// SPDX-License-Identifier: GPL-3.0-or-later
// A contact law as a C header without dependencies: the levels of LawLevels, and ContactElement's step.
#include "c_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <salebra/base/error.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace salebra {
namespace {

// What follows the tables. The names begin with that of the header.
constexpr std::string_view program = R"c(#include <math.h>
#include <stddef.h>

/* A contact between two steps: indentation, displacements along x and y, and where the springs of
   each level are anchored. Copy it to come back to it; write it to a file to restart. */
typedef struct {
  double indentation, x, y;
  double anchor_x[@NAME@_levels], anchor_y[@NAME@_levels];
} @NAME@_state;

/* normal_force: F >= 0. tangential_force: F_x and F_y, which hold the displaced body. stiffness: the derivatives
   of (F, F_x, F_y), by rows, over (indentation, x, y) at the end of the step. */
typedef struct {
  double normal_force, tangential_force[2], stiffness[3][3];
} @NAME@_forces;

/* F, K and K' of the law: a cubic between nodes, the tangent beyond them, 0 where that is below 0. */
static inline void @NAME@_normal(double at, double normal[3]) {
  const double *node = @NAME@_node, *force = @NAME@_force, *slope = @NAME@_slope;
  const int last = @NAME@_levels - 1;
  int low = 0, high = last;
  if (at <= node[0] || at >= node[last]) {
    const int i = at <= node[0] ? 0 : last;
    normal[0] = force[i] + slope[i] * (at - node[i]);
    normal[1] = normal[0] > 0 ? slope[i] : 0;
    normal[2] = 0;
    if (!(normal[0] > 0)) normal[0] = 0;
    return;
  }
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    if (node[middle] <= at) low = middle; else high = middle;
  }
  {
    const double width = node[high] - node[low], t = (at - node[low]) / width;
    const double mean = (force[high] - force[low]) / width - slope[low];
    const double rise = slope[high] - slope[low], b = 3 * mean - rise, c = rise - 2 * mean;
    normal[0] = force[low] + width * t * (slope[low] + t * (b + c * t));
    normal[1] = slope[low] + t * (2 * b + 3 * c * t);
    normal[2] = (2 * b + 6 * c * t) / width;
  }
}

/* Where level i begins; the lowest touches and parts as one, where its force is 0. */
static inline double @NAME@_floor(int i) {
  if (i > 0) return @NAME@_node[i - 1];
  return @NAME@_slope[0] > 0 ? @NAME@_node[0] - @NAME@_force[0] / @NAME@_slope[0] : @NAME@_node[0];
}

/* The stiffness of level i that touches at an indentation, and its derivative. */
static inline double @NAME@_touched(int i, double at, const double normal[3], double *derivative) {
  const double k = @NAME@_stiffness[i];
  double rise, part;
  *derivative = 0;
  if (at <= @NAME@_floor(i)) return 0;
  if (i == 0 || at >= @NAME@_node[i]) return k;
  rise = @NAME@_slope[i] - @NAME@_slope[i - 1];
  if (!(rise > 0)) return k;
  part = (normal[1] - @NAME@_slope[i - 1]) / rise;
  if (!(part > 0)) return 0;
  if (!(part < 1)) return k;
  *derivative = k * normal[2] / rise;
  return k * part;
}

/* Puts the body down with all springs free of stress. */
static inline void @NAME@_start(@NAME@_state *state, double indentation, double x, double y) {
  int i;
  state->indentation = indentation, state->x = x, state->y = y;
  for (i = 0; i < @NAME@_levels; ++i) state->anchor_x[i] = x, state->anchor_y[i] = y;
}

/* The forces at the end of a straight step. The state after it goes to *to, which may be *from, or
   NULL for a step that is only tried. Apart, all forces are 0. */
static inline @NAME@_forces @NAME@_step(const @NAME@_state *from, @NAME@_state *to,
                                        double indentation, double x, double y) {
  @NAME@_forces result = {0, {0, 0}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  const double before = from->indentation, climb = indentation - before;
  const double travel_x = x - from->x, travel_y = y - from->y;
  double now[3], then[3], (*stiffness)[3] = result.stiffness;
  int i, sticks = isinf(@NAME@_friction) != 0;
  if (to && to != from) *to = *from;
  @NAME@_normal(indentation, now);
  @NAME@_normal(before, then);
  result.normal_force = now[0];
  stiffness[0][0] = now[1];
  for (i = @NAME@_levels - 1; i >= 0; --i) {
    const double floor = @NAME@_floor(i), top = @NAME@_node[i];
    const double stretch_x = x - from->anchor_x[i], stretch_y = y - from->anchor_y[i];
    const int inside = i > 0 && indentation < top;
    double k, k_before, slope, unused, hold, push_x, push_y, f_x, f_y, bears, bears_slope, size;
    if (indentation <= floor) continue;
    k = @NAME@_touched(i, indentation, now, &slope);
    k_before = @NAME@_touched(i, before, then, &unused);
    bears = now[0], bears_slope = now[1];
    if (!inside) {
      bears = @NAME@_force[i] + @NAME@_slope[i] * (indentation - top);
      bears_slope = @NAME@_slope[i];
    }
    if (i > 0) {
      bears -= @NAME@_force[i - 1] + @NAME@_slope[i - 1] * (indentation - floor);
      bears_slope -= @NAME@_slope[i - 1];
    }
    if (k <= k_before) {
      f_x = k * stretch_x, f_y = k * stretch_y, hold = k;
      push_x = slope * stretch_x, push_y = slope * stretch_y;
    } else { /* springs that touch on the way are anchored where the body was in the middle of them */
      const double start = floor > before ? floor : before;
      const double finish = i == 0 ? start : inside ? indentation : top;
      const double fraction = (0.5 * (start + finish) - before) / climb;
      const double kept = (k - k_before) * (1 - fraction);
      const double push =
          slope * (1 - fraction) - (k - k_before) * ((inside ? 0.5 : 0.0) - fraction) / climb;
      f_x = k_before * stretch_x + kept * travel_x, f_y = k_before * stretch_y + kept * travel_y;
      hold = k_before + kept, push_x = push * travel_x, push_y = push * travel_y;
    }
    size = sqrt(f_x * f_x + f_y * f_y);
    if (sticks || size <= @NAME@_friction * bears) {
      /* Springs slip from the last level that touches downwards: below one that sticks all do. */
      sticks = sticks || (k == k_before && (i == 0 || (indentation >= top && before >= top)));
      stiffness[1][0] += push_x, stiffness[2][0] += push_y;
      stiffness[1][1] += hold, stiffness[2][2] += hold;
    } else {
      const double n_x = f_x / size, n_y = f_y / size, limit = @NAME@_friction * bears;
      const double part = limit / size, along = push_x * n_x + push_y * n_y;
      f_x = limit * n_x, f_y = limit * n_y;
      stiffness[1][0] += part * (push_x - along * n_x) + @NAME@_friction * bears_slope * n_x;
      stiffness[2][0] += part * (push_y - along * n_y) + @NAME@_friction * bears_slope * n_y;
      stiffness[1][1] += part * hold * n_y * n_y, stiffness[2][2] += part * hold * n_x * n_x;
      stiffness[1][2] -= part * hold * n_x * n_y;
    }
    result.tangential_force[0] += f_x, result.tangential_force[1] += f_y;
    if (to && k > 0) to->anchor_x[i] = x - f_x / k, to->anchor_y[i] = y - f_y / k;
  }
  stiffness[2][1] = stiffness[1][2];
  if (to) to->indentation = indentation, to->x = x, to->y = y;
  return result;
}
)c";

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string table(std::string_view name, const std::vector<double>& values, double unit) {
  std::string text = fmt::format("static const double @NAME@_{}[@NAME@_levels] = {{", name);
  for (std::size_t i = 0; i < values.size(); ++i)
    text += fmt::format("{}{:.17g}",
                        i == 0       ? "\n  "
                        : i % 4 == 0 ? ",\n  "
                                     : ", ",
                        values[i] / unit);
  return text + "};\n";
}

}  // namespace

std::string c_header(const LawLevels& levels, const CHeaderOptions& options) {
  const std::string& name = options.name;
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  require(!name.empty() && std::ranges::all_of(name, fits) &&
              !std::isdigit(static_cast<unsigned char>(name[0])),
          "name", name, "must be a name of C: letters, digits and _");
  const double stiffness = options.force_unit / options.length_unit;
  std::string text;
  for (std::string_view rest = options.comment; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    text += fmt::format("{} {}\n", text.empty() ? "/*" : "  ", rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (!text.empty()) text.insert(text.size() - 1, " */");
  text += "#ifndef @NAME@_INCLUDED\n#define @NAME@_INCLUDED\n";
  std::string_view body = program;
  const std::size_t includes = body.find("\n\n") + 1;
  text += body.substr(0, includes);
  text += fmt::format("\nenum {{ @NAME@_levels = {} }};\n", levels.size());
  text += std::isinf(levels.friction_coefficient())
              ? "#define @NAME@_friction HUGE_VAL\n"
              : fmt::format("#define @NAME@_friction {:.17g}\n", levels.friction_coefficient());
  text +=
      "/* Where each level ends, F and dF/d(indentation) there, and the tangential stiffness of "
      "each. */\n";
  text += table("node", levels.nodes(), options.length_unit);
  text += table("force", levels.forces(), options.force_unit);
  text += table("slope", levels.stiffnesses(), stiffness);
  text += table("stiffness", levels.level_stiffnesses(), stiffness);
  text += body.substr(includes);
  text += "#endif\n";
  replace_all(text, "@NAME@", name);
  return text;
}

}  // namespace salebra
