// SPDX-License-Identifier: GPL-3.0-or-later
// A contact law as a C header without dependencies: the springs of LawSprings, and the step of
// ContactElement.
#include "c_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <salebra/base/error.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "formats.hpp"

namespace salebra {
namespace {

// The code after the tables. All names begin with that of the header.
constexpr std::string_view program = R"c(#include <math.h>
#include <stddef.h>

/* A contact between two steps: indentation, displacements along x and y, and where the springs
   are anchored. Copy it to come back to it; write it to a file to restart. */
typedef struct {
  double indentation, x, y;
  double anchor_x[@NAME@_springs], anchor_y[@NAME@_springs];
} @NAME@_state;

/* normal_force: F >= 0. tangential_force: F_x and F_y, which hold the displaced body. stiffness: the derivatives
   of (F, F_x, F_y), by rows, over (indentation, x, y) at the end of the step. */
typedef struct {
  double normal_force, tangential_force[2], stiffness[3][3];
} @NAME@_forces;

/* A function that the tables give by values and slopes at the nodes, with its first two derivatives:
   between nodes a cubic, or a power of the distance from one of them where no cubic is convex; the
   tangent beyond them, and 0 where that is below 0. */
static inline void @NAME@_between(const double *value, const double *slope, double at, double result[3]) {
  const double *node = @NAME@_node;
  const int last = @NAME@_springs - 1;
  int low = 0, high = last;
  result[2] = 0;
  if (at <= node[0] || at >= node[last]) {
    const int i = at <= node[0] ? 0 : last;
    result[0] = value[i] + slope[i] * (at - node[i]);
    result[1] = result[0] > 0 ? slope[i] : 0;
    if (!(result[0] > 0)) result[0] = 0;
    return;
  }
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    if (node[middle] <= at) low = middle; else high = middle;
  }
  {
    const double width = node[high] - node[low], t = (at - node[low]) / width;
    const double mean = (value[high] - value[low]) / width - slope[low];
    const double rise = slope[high] - slope[low];
    if (3 * mean < rise && mean > 0) {
      const double power = rise / mean - 1, part = pow(t, power);
      result[0] = value[low] + width * t * (slope[low] + mean * part);
      result[1] = slope[low] + rise * part;
      result[2] = rise * power * pow(t, power - 1) / width;
    } else if (3 * mean > 2 * rise && mean < rise) {
      const double power = rise / (rise - mean) - 1, part = pow(1 - t, power);
      result[0] = value[high] - width * (1 - t) * (slope[high] - (rise - mean) * part);
      result[1] = slope[high] - rise * part;
      result[2] = rise * power * pow(1 - t, power - 1) / width;
    } else {
      const double b = 3 * mean - rise, c = rise - 2 * mean;
      result[0] = value[low] + width * t * (slope[low] + t * (b + c * t));
      result[1] = slope[low] + t * (2 * b + 3 * c * t);
      result[2] = (2 * b + 6 * c * t) / width;
    }
  }
}

/* Where spring i begins; the lowest touches and parts as one, where its force is 0. */
static inline double @NAME@_floor(int i) { return i > 0 ? @NAME@_node[i - 1] : @NAME@_depth[0]; }

/* The stiffness of spring i that touches at an indentation, where all springs have that of held, and
   its derivative. */
static inline double @NAME@_touched(int i, double at, const double held[3], double *derivative) {
  *derivative = 0;
  if (at <= @NAME@_floor(i)) return 0;
  if (i == 0 || at >= @NAME@_node[i]) return @NAME@_stiffness[i];
  *derivative = held[2];
  return held[1] - @NAME@_sum[i - 1];
}

/* Puts the body down with all springs free of stress. */
static inline void @NAME@_start(@NAME@_state *state, double indentation, double x, double y) {
  int i;
  state->indentation = indentation, state->x = x, state->y = y;
  for (i = 0; i < @NAME@_springs; ++i) state->anchor_x[i] = x, state->anchor_y[i] = y;
}

/* The forces at the end of a straight step. The state after it goes to *to, which may be *from, or
   NULL for a step that is only tried. Apart, all forces are 0. */
static inline @NAME@_forces @NAME@_step(const @NAME@_state *from, @NAME@_state *to,
                                        double indentation, double x, double y) {
  @NAME@_forces result = {0, {0, 0}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  const double before = from->indentation, climb = indentation - before;
  const double travel_x = x - from->x, travel_y = y - from->y;
  double normal[3], now[3], then[3], share = 0, share_slope = 0, (*stiffness)[3] = result.stiffness;
  const int full_stick = isinf(@NAME@_friction) != 0;
  int i;
  if (to && to != from) *to = *from;
  @NAME@_between(@NAME@_force, @NAME@_slope, indentation, normal);
  @NAME@_between(@NAME@_held, @NAME@_sum, indentation, now);
  @NAME@_between(@NAME@_held, @NAME@_sum, before, then);
  result.normal_force = normal[0];
  stiffness[0][0] = normal[1];
  if (!full_stick && now[0] > 0) { /* the springs together carry mu F at most */
    share = @NAME@_friction * normal[0] / now[0];
    share_slope = (@NAME@_friction * normal[1] - share * now[1]) / now[0];
  }
  for (i = @NAME@_springs - 1; i >= 0; --i) {
    const double floor = @NAME@_floor(i), top = @NAME@_node[i];
    const double stretch_x = x - from->anchor_x[i], stretch_y = y - from->anchor_y[i];
    const int inside = i > 0 && indentation < top;
    double k, k_before, slope, unused, hold, push_x, push_y, f_x, f_y, bears, bears_slope, size, limit;
    if (indentation <= floor) continue;
    k = @NAME@_touched(i, indentation, now, &slope);
    k_before = @NAME@_touched(i, before, then, &unused);
    bears_slope = k;
    bears = inside ? now[0] - @NAME@_held[i - 1] - @NAME@_sum[i - 1] * (indentation - floor)
                   : k * (indentation - @NAME@_depth[i]);
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
    limit = bears > 0 ? share * bears : 0;
    if (full_stick || size <= limit) {
      stiffness[1][0] += push_x, stiffness[2][0] += push_y;
      stiffness[1][1] += hold, stiffness[2][2] += hold;
    } else {
      const double n_x = f_x / size, n_y = f_y / size, part = limit / size;
      const double along = push_x * n_x + push_y * n_y;
      const double limit_slope = share * bears_slope + share_slope * bears;
      f_x = limit * n_x, f_y = limit * n_y;
      stiffness[1][0] += part * (push_x - along * n_x) + limit_slope * n_x;
      stiffness[2][0] += part * (push_y - along * n_y) + limit_slope * n_y;
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

std::string table(std::string_view name, const std::vector<double>& values, double unit) {
  std::string text = fmt::format("static const double @NAME@_{}[@NAME@_springs] = {{", name);
  for (std::size_t i = 0; i < values.size(); ++i)
    text += fmt::format("{}{:.17g}",
                        i == 0       ? "\n  "
                        : i % 4 == 0 ? ",\n  "
                                     : ", ",
                        values[i] / unit);
  return text + "};\n";
}

}  // namespace

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string c_header(const LawSprings& springs, const CHeaderOptions& options) {
  const std::string& name = options.name;
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  require(!name.empty() && std::ranges::all_of(name, fits) &&
              !std::isdigit(static_cast<unsigned char>(name[0])),
          "name", name, "must be a name of C: letters, digits and _");
  const double stiffness = options.force_unit / options.length_unit;
  std::string text;
  // "/*" within a comment does not end the comment, but compilers warn of it.
  for (const std::string& sentence : options.comment)
    text += detail::comment(sentence, {"  ", {"*/", "/*"}});
  if (!text.empty()) text = "/*" + text.substr(2, text.size() - 3) + " */\n";
  text += "#ifndef @NAME@_INCLUDED\n#define @NAME@_INCLUDED\n";
  std::string_view body = program;
  const std::size_t includes = body.find("\n\n") + 1;
  text += body.substr(0, includes);
  text += fmt::format("\nenum {{ @NAME@_springs = {} }};\n", springs.size());
  text += std::isinf(springs.friction_coefficient())
              ? "#define @NAME@_friction HUGE_VAL\n"
              : fmt::format("#define @NAME@_friction {:.17g}\n", springs.friction_coefficient());
  std::vector<double> held, sum;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const double before = i > 0 ? sum[i - 1] : 0, k = springs.spring_stiffnesses()[i];
    const double width = i > 0 ? springs.nodes()[i] - springs.nodes()[i - 1] : 0;
    held.push_back((i > 0 ? held[i - 1] : 0) + before * width +
                   k * (springs.nodes()[i] - springs.spring_depths()[i]));
    sum.push_back(before + k);
  }
  text +=
      "/* Where each spring ends, F and dF/d(indentation) there; the tangential stiffness of each\n"
      "   spring and the indentation at which it acts; of all springs up to it the stiffness and "
      "its\n"
      "   integral over the indentation. */\n";
  text += table("node", springs.nodes(), options.length_unit);
  text += table("force", springs.forces(), options.force_unit);
  text += table("slope", springs.stiffnesses(), stiffness);
  text += table("stiffness", springs.spring_stiffnesses(), stiffness);
  text += table("depth", springs.spring_depths(), options.length_unit);
  text += table("sum", sum, stiffness);
  text += table("held", held, options.force_unit);
  text += body.substr(includes);
  text += "#endif\n";
  replace_all(text, "@NAME@", name);
  return text;
}

}  // namespace salebra
