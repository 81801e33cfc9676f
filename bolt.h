/* one
   two */
#ifndef bolt_INCLUDED
#define bolt_INCLUDED
#include <math.h>
#include <stddef.h>

enum { bolt_levels = 42 };
#define bolt_friction HUGE_VAL
/* Where each level ends, F and dF/d(indentation) there, and the tangential stiffness of each. */
static const double bolt_node[bolt_levels] = {
  -0.00012999999999999999, -0.00011886677591613166, -0.0001083174914070144, -9.8321518738544317e-05,
  -8.8849836606694975e-05, -7.9874945879975434e-05, -7.1370789761211211e-05, -6.3312678136853942e-05,
  -5.5677215894183169e-05, -4.8442234998283631e-05, -4.1586730131597012e-05, -3.5090797709190747e-05,
  -2.8935578092686602e-05, -2.3103200835079126e-05, -1.7576732797472912e-05, -1.234012898710627e-05,
  -7.3781859739292169e-06, -2.6764977504902328e-06, 0, 1.7785860930202575e-06,
  6.0000000000000002e-06, 1.0000000000000001e-05, 1.4e-05, 1.8e-05,
  2.2000000000000003e-05, 2.6000000000000002e-05, 3.0000000000000004e-05, 3.4e-05,
  3.8000000000000002e-05, 4.2000000000000004e-05, 4.6e-05, 4.9999999999999996e-05,
  5.4000000000000005e-05, 5.8e-05, 6.2000000000000003e-05, 6.6000000000000005e-05,
  6.9999999999999994e-05, 7.3999999999999996e-05, 7.7999999999999999e-05, 8.1999999999999987e-05,
  8.6000000000000003e-05, 8.9999999999999992e-05};
static const double bolt_force[bolt_levels] = {
  0, 0, 0, 0,
  0, 0, 0, 0,
  0, 0, 0, 0,
  0, 0, 0, 0,
  0, 0, 0, 7.5008820840748481e-08,
  4.6475800154489004e-07, 9.9999999999999995e-07, 1.6565023392678924e-06, 2.4149534156997732e-06,
  3.2631273343220923e-06, 4.192374029115246e-06, 5.1961524227066329e-06, 6.2692902309591629e-06,
  7.4075637020548122e-06, 8.6074386434060647e-06, 9.8659008711825205e-06, 1.1180339887498949e-05,
  1.2548466041712033e-05, 1.3968249711399063e-05, 1.5437875501506028e-05, 1.6955707003837974e-05,
  1.8520259177452129e-05, 2.0130176352928458e-05, 2.1784214468279548e-05, 2.3481226543773213e-05,
  2.5220150673618113e-05, 2.6999999999999999e-05};
static const double bolt_slope[bolt_levels] = {
  0, 0, 0, 0,
  0, 0, 0, 0,
  0, 0, 0, 0,
  0, 0, 0, 0,
  0, 0, 0, 0.063259929728822648,
  0.1161895003862225, 0.14999999999999999, 0.17748239349298844, 0.20124611797498107,
  0.22248595461286991, 0.24186773244895651, 0.25980762113533162, 0.27658633371878666,
  0.29240383034426892, 0.30740852297878796, 0.32171415884290822, 0.33541019662496852,
  0.34856850115866755, 0.36124783736376892, 0.37349698793966202, 0.38535697735995394,
  0.39686269665968854, 0.40804411526206336, 0.41892720131306821, 0.42953463189829061,
  0.43988634895845535, 0.44999999999999996};
static const double bolt_stiffness[bolt_levels] = {
  0, 0, 0, 0,
  0, 0, 0, 0,
  0, 0, 0, 0,
  0, 0, 0, 0,
  0, 0, 0, 0.050607943783058121,
  0.042343656525919877, 0.027048399691022001, 0.02198591479439076, 0.019010979585594119,
  0.016991869310311072, 0.015505422268869268, 0.01435191094910007, 0.013422970066764043,
  0.012653997300385817, 0.012003754107615212, 0.011444508691296214, 0.010956830225648242,
  0.010526643626959238, 0.010143468964081083, 0.0097993204607144582, 0.0094879915362335743,
  0.0092045754397877023, 0.0089451348818998088, 0.008706468840803892, 0.0084859444681779136,
  0.0082813736481318484, 0.0080909208332356642};

/* A contact between two steps: indentation, displacements along x and y, and where the springs of
   each level are anchored. Copy it to come back to it; write it to a file to restart. */
typedef struct {
  double indentation, x, y;
  double anchor_x[bolt_levels], anchor_y[bolt_levels];
} bolt_state;

/* normal: F >= 0. tangential: F_x and F_y, which hold the displaced body. stiffness: the derivatives
   of (F, F_x, F_y), by rows, over (indentation, x, y) at the end of the step. */
typedef struct {
  double normal, tangential[2], stiffness[3][3];
} bolt_forces;

/* F, K and K' of the law: a cubic between nodes, the tangent beyond them, 0 where that is below 0. */
static inline void bolt_normal(double at, double normal[3]) {
  const double *node = bolt_node, *force = bolt_force, *slope = bolt_slope;
  const int last = bolt_levels - 1;
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
static inline double bolt_floor(int i) {
  if (i > 0) return bolt_node[i - 1];
  return bolt_slope[0] > 0 ? bolt_node[0] - bolt_force[0] / bolt_slope[0] : bolt_node[0];
}

/* The stiffness of level i that touches at an indentation, and its derivative. */
static inline double bolt_touched(int i, double at, const double normal[3], double *derivative) {
  const double k = bolt_stiffness[i];
  double rise, part;
  *derivative = 0;
  if (at <= bolt_floor(i)) return 0;
  if (i == 0 || at >= bolt_node[i]) return k;
  rise = bolt_slope[i] - bolt_slope[i - 1];
  if (!(rise > 0)) return k;
  part = (normal[1] - bolt_slope[i - 1]) / rise;
  if (!(part > 0)) return 0;
  if (!(part < 1)) return k;
  *derivative = k * normal[2] / rise;
  return k * part;
}

/* Puts the body down with all springs free of stress. */
static inline void bolt_start(bolt_state *state, double indentation, double x, double y) {
  int i;
  state->indentation = indentation, state->x = x, state->y = y;
  for (i = 0; i < bolt_levels; ++i) state->anchor_x[i] = x, state->anchor_y[i] = y;
}

/* The forces at the end of a straight step. The state after it goes to `to`, which may be `from`, or
   NULL for a step that is only tried. Apart, all forces are 0. */
static inline bolt_forces bolt_step(const bolt_state *from, bolt_state *to,
                                        double indentation, double x, double y) {
  bolt_forces result = {0, {0, 0}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  const double before = from->indentation, climb = indentation - before;
  const double travel_x = x - from->x, travel_y = y - from->y;
  double now[3], then[3], (*stiffness)[3] = result.stiffness;
  int i, sticks = isinf(bolt_friction) != 0;
  if (to && to != from) *to = *from;
  bolt_normal(indentation, now);
  bolt_normal(before, then);
  result.normal = now[0];
  stiffness[0][0] = now[1];
  for (i = bolt_levels - 1; i >= 0; --i) {
    const double floor = bolt_floor(i), top = bolt_node[i];
    const double stretch_x = x - from->anchor_x[i], stretch_y = y - from->anchor_y[i];
    const int inside = i > 0 && indentation < top;
    double k, k_before, slope, unused, hold, push_x, push_y, f_x, f_y, bears, bears_slope, size;
    if (indentation <= floor) continue;
    k = bolt_touched(i, indentation, now, &slope);
    k_before = bolt_touched(i, before, then, &unused);
    bears = now[0], bears_slope = now[1];
    if (!inside) {
      bears = bolt_force[i] + bolt_slope[i] * (indentation - top);
      bears_slope = bolt_slope[i];
    }
    if (i > 0) {
      bears -= bolt_force[i - 1] + bolt_slope[i - 1] * (indentation - floor);
      bears_slope -= bolt_slope[i - 1];
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
    if (sticks || size <= bolt_friction * bears) {
      /* Springs slip from the last level that touches downwards: below one that sticks all do. */
      sticks = sticks || (k == k_before && (i == 0 || (indentation >= top && before >= top)));
      stiffness[1][0] += push_x, stiffness[2][0] += push_y;
      stiffness[1][1] += hold, stiffness[2][2] += hold;
    } else {
      const double n_x = f_x / size, n_y = f_y / size, limit = bolt_friction * bears;
      const double part = limit / size, along = push_x * n_x + push_y * n_y;
      f_x = limit * n_x, f_y = limit * n_y;
      stiffness[1][0] += part * (push_x - along * n_x) + bolt_friction * bears_slope * n_x;
      stiffness[2][0] += part * (push_y - along * n_y) + bolt_friction * bears_slope * n_y;
      stiffness[1][1] += part * hold * n_y * n_y, stiffness[2][2] += part * hold * n_x * n_x;
      stiffness[1][2] -= part * hold * n_x * n_y;
    }
    result.tangential[0] += f_x, result.tangential[1] += f_y;
    if (to && k > 0) to->anchor_x[i] = x - f_x / k, to->anchor_y[i] = y - f_y / k;
  }
  stiffness[2][1] = stiffness[1][2];
  if (to) to->indentation = indentation, to->x = x, to->y = y;
  return result;
}
#endif
