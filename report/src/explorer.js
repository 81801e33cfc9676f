// SPDX-License-Identifier: GPL-3.0-or-later
// The loss of a motion that the reader enters, from the mean curve of the study. The formulas are those of the library: contact/hermite.cpp,
// contact/law/law.cpp, damping/spring_loss.cpp, and damping/assumptions.cpp.
"use strict";

const mean = (values) => values.filter(known).reduce((a, b) => a + b, 0) / values.filter(known).length;

/** A monotone cubic through points, x ↦ {value, slope}. Without given slopes it uses those of the cubic through four neighbours. */
function monotoneCubic(x, y, given) {
  const count = x.length;
  const estimated = (at) => {
    const compact = at >= 2 && at + 2 < count && x[at] - x[at - 2] < x[at + 2] - x[at];
    const first = compact ? at - 2 : Math.min(Math.max(at - 1, 0), count - 4), nodes = [0, 1, 2, 3].map((j) => first + j);
    return nodes.filter((j) => j !== at).reduce((sum, j) =>
      sum + (y[j] - y[at]) * nodes.reduce((weight, k) => (k === j || k === at ? weight : weight * (x[at] - x[k]) / (x[j] - x[k])), 1 / (x[j] - x[at])), 0);
  };
  const slopes = given ?? x.map((_, i) => estimated(i));
  for (let i = 0; i + 1 < count; ++i) {
    const secant = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    for (const j of [i, i + 1]) slopes[j] = slopes[j] * secant <= 0 ? 0 : Math.sign(secant) * Math.min(Math.abs(slopes[j]), 3 * Math.abs(secant));
  }
  return (at) => {
    let i = 0;
    while (i + 2 < count && x[i + 1] <= at) ++i;
    const width = x[i + 1] - x[i], t = (at - x[i]) / width, rise = y[i + 1] - y[i], m0 = slopes[i] * width, m1 = slopes[i + 1] * width;
    const quadratic = 3 * rise - 2 * m0 - m1, cubic = m0 + m1 - 2 * rise;
    return {value: y[i] + t * (m0 + t * (quadratic + t * cubic)), slope: (m0 + t * (2 * quadratic + 3 * t * cubic)) / width};
  };
}

/**
 * Force and tangential stiffness over the indentation −‹ū›, from the means over the surfaces. Below the lowest load the contact opens like a sphere at first touch, as
 * TabulatedLaw in contact/law/law.hpp, or, to see what this changes, never opens (`exponential`). `half` leaves out every second load. Above the highest load the law is an exponential. Null if fewer than four loads are known.
 */
function lawOf(point, {exponential = false, half = -1} = {}) {
  const of = (name) => point.curve?.[name]?.bem?.mean ?? [], gap = of("mean_gap"), ratio = point.damping.modulus_ratio;
  const force = forces(point);
  let least = Infinity;
  const all = force.map((_, k) => k).filter((k) => { const falls = known(gap[k]) && gap[k] < least; if (falls) least = gap[k]; return falls; });
  const loads = all.filter((_, i) => i === 0 || i === all.length - 1 || i % 2 !== half);
  if (loads.length < 4) return null;
  const positive = (values) => loads.every((k) => values[k] > 0);
  const x = loads.map((k) => -gap[k]), normal = of("normal_stiffness"), tangential = of("tangential_stiffness");
  const logForce = monotoneCubic(x, loads.map((k) => Math.log(force[k])), positive(normal) ? loads.map((k) => normal[k] / force[k]) : undefined);
  const logStiffness = positive(tangential) ? monotoneCubic(x, loads.map((k) => Math.log(tangential[k]))) : null;
  const forceIn = (at) => Math.exp(logForce(at).value), stiffnessIn = (at) => (logStiffness ? Math.exp(logStiffness(at).value) : ratio * forceIn(at) * logForce(at).slope);
  const [low, high] = [x[0], x.at(-1)].map((at) => ({at, length: 1 / logForce(at).slope}));
  // K_t/‹K›, which decides when springs slip: from the curve if it has its own ‹K›_t; beyond the curve the value at its end.
  const ratioAt = (at) => { const inside = Math.min(high.at, Math.max(low.at, at)); return logStiffness ? stiffnessIn(inside) / (forceIn(inside) * logForce(inside).slope) : ratio; };
  const touch = exponential ? -Infinity : low.at - 1.5 * low.length;
  const continued = (inside, power) => (at) => {
    if (at < low.at && !exponential) return inside(low.at) * Math.max(0, (at - touch) / (low.at - touch)) ** power;
    const end = at < low.at ? low : at > high.at ? high : null;
    return end ? inside(end.at) * Math.exp((at - end.at) / end.length) : inside(at);
  };
  // Only e^{-21} = 1e-9 of the stiffness of an exponential lies more than 21 decay lengths below its end.
  return {low: low.at, high: high.at, touch, deepest: exponential ? low.at - 21 * low.length : touch, force: continued(forceIn, 1.5), stiffness: continued(stiffnessIn, 0.5), ratio: ratioAt, indentation: (k) => (all.includes(k) ? -gap[k] : NaN),
    load: (k) => force[k], nodes: x, normal: (at) => forceIn(at) * logForce(at).slope};
}

/** Half of the phases of a normal cycle at which the contact is closed. */
const closedHalf = (law, middle, amplitude) => Math.acos(Math.min(1, Math.max(-1, (law.touch - middle) / amplitude)));

/** Mean normal force of a cycle. */
function meanForce(law, middle, amplitude) {
  const half = closedHalf(law, middle, amplitude), forces = Array.from({length: 90}, (_, i) => law.force(middle + amplitude * Math.cos(half * (i + 0.5) / 90)));
  return half / Math.PI * forces.reduce((a, b) => a + b) / 90;
}

/** What the oscillation holds: hold_of() of the library. */
const holdOf = (law, k, set) => (set.hold !== "auto" ? set.hold : law.indentation(k) - set.normal_amplitude < law.touch ? "force" : "indentation");

/** The mean indentation: that of the load, or, if the mean force is held, the one at which the mean force of the cycle is the load. */
function meanIndentation(law, k, set) {
  const rest = law.indentation(k), force = law.load(k), amplitude = set.normal_amplitude, range = amplitude + law.high - law.low;
  if (holdOf(law, k, set) !== "force") return rest;
  let low = rest - range, high = rest + range;
  for (let i = 0; i < 60; ++i) { const middle = (low + high) / 2; if (meanForce(law, middle, amplitude) > force) high = middle; else low = middle; }
  return low;
}

/** ∮s dx of one spring of 1 N/m with Coulomb friction in the last of the periods; it touches at phases from −half to half. */
function springLoss(motion, level, half, periods) {
  const steps = 360, limitAt = (angle) => Math.max(0, motion.stretch * (motion.amplitude * Math.cos(angle) - level));
  let work = 0, stretch = 0;
  for (let period = 0; period < periods; ++period) {
    work = 0;
    let x = motion.place(-half), limit = limitAt(-half);
    for (let i = 1; i <= steps; ++i) {
      const angle = half * (2 * i / steps - 1), next = motion.place(angle), nextLimit = limitAt(angle), way = next - x, stuck = stretch + way;
      if (Math.abs(stuck) <= nextLimit) {
        work += (stretch + stuck) / 2 * way;
        stretch = stuck;
      } else {
        const side = Math.sign(stuck), share = (limit - side * stretch) / (side * way - (nextLimit - limit)), slips = stretch + share * way, end = side * nextLimit;
        work += way * (share * (stretch + slips) + (1 - share) * (slips + end)) / 2;
        stretch = end;
      }
      [x, limit] = [next, nextLimit];
    }
  }
  return work;
}

/** Mean of (m − δ_min)/u_z over a period at the velocity ratio v/v_c, as Period::mean_rise() in damping/steady_sliding.cpp. */
function meanRise(ratio) {
  if (ratio >= 1) return 1;
  const from = Math.asin(ratio);
  let low = Math.PI - from, high = 2 * Math.PI - from;
  for (let i = 0; i < 50; ++i) { const middle = (low + high) / 2; if (Math.cos(from) - Math.cos(middle) > ratio * (middle - from)) low = middle; else high = middle; }
  const stuck = low - from;
  return (2 * Math.PI - stuck - (Math.sin(from) - Math.sin(low)) + 2 * Math.sin(from / 2) ** 2 * stuck + ratio * stuck * stuck / 2) / (2 * Math.PI);
}

/** Loss of springs that never open, over an excursion between turning points at random phases, as SlidingSprings in damping/spring_loss.hpp. */
function slidingSprings({amplitude, stretch, speed, excursion}) {
  const swing = stretch * amplitude, rise = swing * meanRise(speed / swing), phases = 240, step = 2 * Math.PI * speed / phases, place = [];
  let last = 0, back = 0, lowest = Infinity;
  for (let i = 0; i < 3 * phases; ++i) {
    last = Math.min(swing * (1 - Math.cos(2 * Math.PI * i / phases)), last + step);
    if (i >= phases) place.push(last + (i - phases) * step);
  }
  for (let i = place.length - 1; i >= 0; --i) {
    lowest = Math.min(lowest, place[i]);
    if (i < phases) back += (place[i] - lowest) / phases;
  }
  const linear = excursion - 4 * rise + 2 * back, rest = rise * (excursion - 2 * rise + 4 / 3 * back);
  return {
    turningShare: (2 * rise - 4 / 3 * back) / excursion,
    deepest: (linear + Math.sqrt(linear * linear + 8 * Math.max(0, rest))) / 4,
    lossOfWay: (least) => Math.max(0, (least + rise) * (excursion - 2 * (least + rise)) + (2 * least + 4 / 3 * rise) * back),
  };
}

/** The motion about a mean indentation, from the numbers that the reader enters. */
function motionOf(law, middle, set) {
  const omega = 2 * Math.PI * set.frequency, speed = set.drag_velocity / omega;
  const drag = known(set.drag_velocity);
  return {...set, amplitude: set.normal_amplitude, drag, omega, speed, way: drag ? 2 * Math.PI * speed : 0, stretch: set.friction_coefficient / law.ratio(middle),
    place: drag ? (angle) => speed * angle : (angle) => set.tangential_amplitude * Math.cos(angle + set.phase),
    perWork: set.frequency / (drag ? set.drag_velocity ** 2 : (omega * set.tangential_amplitude) ** 2 / 2)};
}

/** ∫K_t' w dζ over spring depths from the first to the last. */
function overSprings(law, levels, loss) {
  let sum = 0, above = law.stiffness(levels[0]);
  for (let i = 1; i < levels.length; ++i) {
    const below = law.stiffness(levels[i]);
    sum += (above - below) * loss((levels[i - 1] + levels[i]) / 2);
    above = below;
  }
  return sum;
}

/** Losses of a normal cycle, J: without slip, and with slip those of springs that open and of springs that stay closed. */
function losses(law, middle, motion) {
  const {amplitude, stretch} = motion, cells = 240;
  const closed = closedHalf(law, middle, amplitude), opening = Array.from({length: cells + 1}, (_, i) => middle + amplitude * Math.cos(closed * i / cells));
  const half = (level) => Math.acos((level - middle) / amplitude);
  const stick = overSprings(law, opening, (level) => (motion.place(half(level)) - motion.place(-half(level))) ** 2 / 2);
  if (!known(stretch)) return {stick, opened: NaN, relaxation: NaN, slip: NaN};
  const opened = overSprings(law, opening, (level) => springLoss(motion, level - middle, half(level), 1));
  const taken = motion.drag && known(motion.excursion) ? 1.5 * costOfTurning(law, middle, amplitude) * slidingSprings(motion).turningShare : 0;
  return {stick, opened, relaxation: opened * Math.max(0, 1 - taken), slip: slipLoss(law, middle, motion)};
}

/** The loss missing at a turning point of a slow motion, in losses of one normal cycle of springs that open. */
function costOfTurning(law, middle, amplitude) {
  const angles = Array.from({length: 360}, (_, i) => Math.PI * (i + 0.5) / 360), closed = law.stiffness(middle - amplitude);
  const opening = angles.map((angle) => law.stiffness(middle + amplitude * Math.cos(angle)) - closed);
  return angles.reduce((sum, angle, i) => sum + angle * angle * opening[i], 0) / (Math.PI * angles.reduce((sum, angle, i) => sum + angle * opening[i], 0));
}

/** The loss by slip of springs that stay closed, J. */
function slipLoss(law, middle, motion) {
  const {amplitude, stretch, excursion, way} = motion, cells = 256, bottom = middle - amplitude, depth = bottom - Math.max(slipsDownTo(middle, motion), law.deepest);
  if (!(depth > 0)) return motion.drag && !known(excursion) ? NaN : 0;
  const levels = Array.from({length: cells + 1}, (_, i) => bottom - depth * i / cells);
  if (motion.drag) {
    const {lossOfWay} = slidingSprings(motion);
    return overSprings(law, levels, (level) => lossOfWay(stretch * (bottom - level)) * way / excursion);
  }
  return overSprings(law, levels, (level) => springLoss(motion, level - middle, Math.PI, 2));
}

/** The depth of the deepest springs that slip. Deeper ones stick: one anchor is within their friction limit of x at all times. */
function slipsDownTo(middle, motion) {
  if (motion.drag) return middle - motion.amplitude - slidingSprings(motion).deepest / motion.stretch;
  const angles = Array.from({length: 360}, (_, i) => 2 * Math.PI * i / 360), limit = (angle) => motion.stretch * motion.amplitude * Math.cos(angle);
  return middle - (Math.max(...angles.map((angle) => motion.place(angle) - limit(angle))) - Math.min(...angles.map((angle) => motion.place(angle) + limit(angle)))) / (2 * motion.stretch);
}

/** Whether all springs slip except those that carry less than 5 % of the mean normal force. */
function slides(law, middle, motion, loss) {
  const bottom = middle - motion.amplitude, stuck = 0.05 * meanForce(law, middle, motion.amplitude), fast = motion.speed >= motion.stretch * motion.amplitude;
  if (bottom <= law.touch) return motion.drag ? fast : law.force(middle + motion.amplitude - motion.tangential_amplitude / motion.stretch) <= stuck;
  // Below the velocity at which opening springs never stick, they may lose more than sliding ones.
  return law.force(motion.drag ? bottom - motion.excursion / motion.stretch / 2 : slipsDownTo(middle, motion)) <= stuck && (!motion.drag || fast || loss.slip >= loss.stick);
}

/** The regime, as Assumptions::regime in the library. */
function regimeOf(law, middle, motion, loss) {
  if (!known(motion.stretch) || (motion.drag && !(motion.excursion >= motion.way))) return "unknown";
  const bottom = middle - motion.amplitude, changed = (slipping, stick) => !(Math.abs(slipping / stick - 1) <= 0.05);
  // The effects of slip in opening and in closed springs may cancel, so smaller motions are checked too.
  const ladder = [];
  if (!motion.drag) for (let part = 1; motion.tangential_amplitude * part > 0.01 * motion.stretch * motion.amplitude; part /= 1.2) ladder.push(part);
  const slips = motion.drag ? changed(loss.opened, loss.stick) || !(loss.slip <= 0.05 * loss.stick)
    : ladder.some((part) => { const one = losses(law, middle, {...motion, place: (angle) => part * motion.place(angle)}); return changed(one.opened + one.slip, one.stick); });
  const opens = bottom < law.touch;
  if (slips && slides(law, middle, motion, loss)) return "sliding";
  return opens ? "lifts off" : slips ? "partial slip" : "no slip";
}

const VERDICTS = ["holds", "doubtful", "broken", "unknown"];
const RANKS = ["broken", "doubtful", "unknown", "holds"];
const VALIDITY = {broken: "not valid", doubtful: "valid with care", unknown: "not checked", holds: "valid"};

/** The assumptions of this loss at load k, in the words of the library. Assumptions that do not depend on the motion are taken from the study. */
function verdictsOf(point, k, law, middle, motion, loss) {
  const judge = (value, five, twenty) => (!known(value) ? "unknown" : value > twenty ? "broken" : value > five ? "doubtful" : "holds");
  const found = [], add = (name, verdict, value, limit, needs) => {
    const words = point.assumptions[name];
    if (verdict === "holds" && !known(value)) return;
    const fill = (text, number) => text.replace("{}", quantity(number, words.unit, 3));
    found.push({name, verdict, assumption: name === "plasticity" && limit === 1 ? "elastic again: loads below the largest of the first loading" : known(limit) ? fill(words.assumption, limit) : words.assumption.split(": ")[0], here: verdict === "unknown" ? (needs ? `\`${needs}\` not given` : "not known for this motion") : fill(words.here, value), remedy: ["broken", "doubtful"].includes(verdict) ? words.remedy : ""});
  };
  // As verdicts_of() of the library does for a loss with slip.
  if (regimeOf(law, middle, motion, loss) === "sliding") found.push({name: "regime", verdict: "broken", assumption: "a damper: the contact does not slide as a whole", here: motion.drag ? "γ = µF/v: Coulomb friction, not a damper" : "γ = 4µF/(πωu_x): Coulomb friction, not a damper", remedy: motion.drag ? "use `salebra sliding`" : "use the energy dissipated in a cycle"});
  if (!known(motion.friction_coefficient)) for (const name of ["slip_of_opening_springs", "slip_of_closed_springs"]) add(name, "unknown", null, null, "friction_coefficient");
  if (motion.drag) {
    const cost = costOfTurning(law, middle, motion.amplitude), cycles = motion.excursion / motion.way, [five, twenty] = [0.05, 0.2].map((share) => Math.max(1, cost / share));
    add("slow_motion", known(cycles) ? judge(-cycles, -five, -twenty) : "unknown", cycles, five, "excursion");
  }
  const stored = (name, column = "value", at = k) => point.assumptions[name][column][at];
  // Pressures are those of the load at which the motion of the study reaches the largest force of this motion most closely. The share of the largest force of an earlier loading needs no such detour.
  const studied = studiedMotion(point), peak = law.force(middle + motion.amplitude), peakOf = (at) => law.force(meanIndentation(law, at, studied) + studied.normal_amplitude);
  const off = point.pressure.map((_, at) => (known(stored("plasticity", "value", at)) ? Math.abs(Math.log(peakOf(at) / peak)) : NaN)), near = off.indexOf(Math.min(...off.filter(known))), onset = stored("plasticity", "onset");
  const flow = onset === 1 ? stored("plasticity") * peak / peakOf(k) : near < 0 ? null : stored("plasticity", "value", near);
  add("plasticity", !known(flow) || !known(onset) ? "unknown" : flow > 1 + (onset === 1 ? 0.02 : 0) ? "broken" : flow > onset + (onset === 1 ? 0.02 : 0) ? "doubtful" : "holds", flow, onset, "hardness");
  const waves = stored("inertia") * motion.omega / point.damping.angular_frequency, radiation = 0.58;
  const whole = 2 * point.damping.modulus_ratio * point.damping.contact_modulus * Math.max(point.surface.size_x, point.surface.size_y), stiffness = law.stiffness(middle + motion.amplitude);
  const [five, twenty] = [0.05, 0.2].map((share) => Math.min(Math.sqrt((1 + share) ** 2 - 1) / radiation,
    motion.drag || !(loss.stick > 0) ? Infinity : share * loss.stick / motion.tangential_amplitude ** 2 / (Math.PI * radiation * stiffness * Math.min(1, stiffness / whole))));
  add("inertia", known(stored("inertia")) ? judge(waves, five, twenty) : "unknown", waves, five, "density");
  add("coupling", VERDICTS[stored("coupling", "verdict")] ?? "unknown", stored("coupling"), stored("coupling") === null ? null : 0.05);
  return found;
}

/**
 * One more assumption: the loss from the curve between loads agrees with that from contacts that the study solved within its own oscillation, up to their error.
 * Null if the study solved none. If a few spots carry the load, the curve may be far from the contacts.
 */
function curveVerdict(point, k, law) {
  const contacts = point.solution?.damping_constant;
  if (!contacts?.error?.some(known)) return null;
  const studied = studiedMotion(point), middle = meanIndentation(law, k, studied), motion = motionOf(law, middle, studied), slips = point.slip_followed === "yes";
  const loss = middle + motion.amplitude <= law.high ? losses(law, middle, motion) : {}, curve = (slips ? loss.relaxation + loss.slip : loss.stick) * motion.perWork;
  const off = curve / contacts.mean[k] - 1, error = contacts.error[k] / contacts.mean[k], beyond = Math.max(0, Math.abs(off) - error);
  const verdict = !known(beyond) ? "unknown" : beyond > 0.2 ? "broken" : beyond > 0.05 ? "doubtful" : "holds";
  return {name: "curve", verdict, assumption: `curve between loads: within 5${NARROW}% of contacts solved in the oscillation`, remedy: verdict === "holds" ? "" : "run `study` with this motion to solve them",
    here: known(off) ? `${quantity(curve, "N s/m", 3)} by the curve and ${quantity(contacts.mean[k], "N s/m", 3)} ± ${errorPercent(error)} by contacts, in the motion of the study` : "not known at this load"};
}

/** Scatter of the slope of ln ‹K› about a motion narrower than the distance of two loads, as scatter_of_slope() in damping/table_error.cpp. */
function scatterOfSlope({nodes, normal}, middle, amplitude) {
  if (nodes.length < 6 || middle < nodes[0] || middle > nodes.at(-1)) return 0;
  const found = nodes.findIndex((node) => node > middle), above = found < 0 ? nodes.length : found, end = Math.min(above, nodes.length - 1);
  if (amplitude > nodes[end] - nodes[end - 1]) return 0;
  const begin = Math.max(0, Math.min(above - 3, nodes.length - 6)), five = [0, 1, 2, 3, 4].map((i) => nodes.slice(begin + i, begin + i + 2)), mean = (values) => values.reduce((a, b) => a + b) / 5;
  const slope = five.map(([low, high]) => Math.log(normal(high) / normal(low)) / (high - low)), at = five.map(([low, high]) => (low + high) / 2 - middle);
  const rise = mean(at.map((a, i) => (a - mean(at)) * slope[i])) / mean(at.map((a) => (a - mean(at)) ** 2)), rest = slope.map((s, i) => s - mean(slope) - rise * (at[i] - mean(at)));
  return Math.sqrt(5 * mean(rest.map((r) => r * r)) / 3) / Math.abs(mean(slope) - rise * mean(at));
}

/**
 * What the curve does not tell about a motion, as error_of_table() in damping/table_error.cpp: the change of a loss by another continuation below the lowest load, and by half of the
 * loads, relative to the loss. `total` picks the loss, and `lowest` is the depth that it reaches.
 */
function errorOfCurve(point, law, k, set, loss, middle, total, lowest) {
  const change = (other) => {
    const about = meanIndentation(other, k, {...set, hold: holdOf(law, k, set)});
    return Math.abs(total(losses(other, about, motionOf(other, about, set))) / total(loss) - 1);
  };
  const below = lowest < law.low ? change(lawOf(point, {exponential: true})) : 0, halves = law.nodes.length < 7 ? [] : [1, 0].map((half) => lawOf(point, {half})).filter(Boolean);
  return {below, error: Math.hypot(below, Math.max(0, ...halves.map(change)), scatterOfSlope(law, middle, set.normal_amplitude))};
}

/** The numbers of the program for a motion at load k of the mean curve. Numbers that it does not give are NaN, and `why` states the reason. */
function explore(point, k, set) {
  const law = lawOf(point), middle = meanIndentation(law, k, set), motion = motionOf(law, middle, set), top = middle + motion.amplitude;
  const nothing = (why) => ({max_force: NaN, mean_force: NaN, contact_time: NaN, work_per_cycle: NaN, damping_constant: NaN, damping_constant_without_slip: NaN, relaxation_share: NaN, slip_share: NaN, regime: "unknown", validity: "not checked", verdicts: [], why});
  for (const name of ["normal_amplitude", "frequency", motion.drag ? "drag_velocity" : "tangential_amplitude"]) if (!(set[name] > 0)) return nothing(`\`${name}\` must be > 0.`);
  for (const name of ["friction_coefficient", "excursion"]) if (set[name] <= 0) return nothing(`\`${name}\` must be > 0.`);
  if (!known(middle)) return nothing("The contact at this load did not converge.");
  if (top > law.high) return nothing(`\`normal_amplitude\` presses up to about ${quantity(law.force(top), "N", 3)}, but the curve ends at ${quantity(law.force(law.high), "N", 3)}; extend the curve to this load, or reduce the amplitude.`);
  const loss = losses(law, middle, motion), slips = known(motion.friction_coefficient);
  const doubt = (total, lowest) => errorOfCurve(point, law, k, set, loss, middle, total, lowest);
  const stuck = doubt((one) => one.stick, middle - motion.amplitude), slid = slips ? doubt((one) => one.relaxation + one.slip, Math.min(middle - motion.amplitude, slipsDownTo(middle, motion))) : stuck;
  if (stuck.below > 0.2 || slid.below > 0.2) return nothing(`The springs below the lowest load of the curve, ${quantity(law.force(law.low), "N", 3)}, decide on the loss; extend the curve to lower loads, or change the motion.`);
  const curve = curveVerdict(point, k, law), verdicts = [...(curve ? [curve] : []), ...verdictsOf(point, k, law, middle, motion, loss)].sort((a, b) => RANKS.indexOf(a.verdict) - RANKS.indexOf(b.verdict)), worst = verdicts.find((one) => one.name !== "coupling" || one.verdict !== "unknown");
  const why = motion.drag && slips && !known(motion.excursion) ? "The loss depends on `excursion`, which is not given." : motion.drag && motion.excursion < motion.way ? "The motion is not slow: one normal cycle covers the excursion."
    : slid.error > 1 ? "The loads of the curve are too far apart for this motion: the error of the loss is larger than the loss." : curve?.verdict === "broken" ? "The curve between loads does not resolve this contact; run `study` with this motion." : "";
  const work = why ? NaN : slips ? loss.relaxation + loss.slip : loss.stick, mean = meanForce(law, middle, motion.amplitude), growth = mean / law.force(law.indentation(k));
  return {max_force: law.force(top), mean_force: mean, contact_time: closedHalf(law, middle, motion.amplitude) / Math.PI, work_per_cycle: work, damping_constant: work * motion.perWork, damping_constant_without_slip: curve?.verdict === "broken" || stuck.error > 1 ? NaN : loss.stick * motion.perWork, relaxation_share: loss.relaxation / work, slip_share: loss.slip / work, regime: regimeOf(law, middle, motion, loss),
    validity: VALIDITY[worst?.verdict ?? "holds"], verdicts, why: why || (holdOf(law, k, set) === "indentation" && growth > 2 ? `Holding the mean indentation raises the mean force ${number(growth, 3)} times; a preloaded machine holds the mean force.`
      : Math.min(middle - motion.amplitude, slips ? slipsDownTo(middle, motion) : Infinity) < law.low ? "Some of the loss is in parts of the contact that touch below the lowest load of the study, where the curve is continued down to first touch." : "")};
}

/** The motion of the study, with its coefficient of friction and excursion if known. */
function studiedMotion(point) {
  const {normal_amplitude, drag_velocity, tangential_amplitude, phase, angular_frequency, friction_coefficient} = point.damping, frequency = angular_frequency / (2 * Math.PI);
  const excursion = point.assumptions.slip_of_closed_springs.value.find(known) ?? NaN;
  return {normal_amplitude, frequency, hold: point.damping.hold ?? "indentation", ...(drag_velocity === undefined ? {tangential_amplitude, phase} : {drag_velocity, excursion}), friction_coefficient: friction_coefficient ?? NaN};
}

const CONTROLS = {normal_amplitude: ["normal amplitude ‹u›_{z}", "m"], frequency: ["frequency", "Hz"], drag_velocity: ["velocity ‹v›", "m/s"], tangential_amplitude: ["tangential amplitude ‹u›_{x}", "m"], phase: ["phase", "rad"],
  excursion: ["excursion ‹X› from one turning point to the other", "m"], friction_coefficient: ["friction coefficient ‹μ›", "1"]};

const HOLDS = {auto: "the mean force where it lifts off", indentation: "the mean indentation", force: "the mean force"};

function explorer(body, point) {
  const studied = studiedMotion(point), set = {...studied}, panel = h("div", {class: "answer", "aria-live": "polite"});
  const result = () => explore(point, shownLoad(point), set);
  let pending = 0;
  const soon = () => { cancelAnimationFrame(pending); pending = requestAnimationFrame(update); };
  const control = (name) => {
    const [label, unit] = CONTROLS[name], {factor, label: shown} = scaleFor([known(studied[name]) ? studied[name] : unit === "m" ? studied.normal_amplitude : 1], unit);
    return h("label", {for: `explore-${name}`}, h("span", {}, rich(label), shown ? `, ${shown}` : ""), h("input", {type: "number", id: `explore-${name}`, min: name === "phase" ? null : 0, step: "any", value: known(studied[name]) ? Number((studied[name] * factor).toPrecision(6)) : "",
      oninput: (event) => { set[name] = event.target.value === "" ? NaN : Number(event.target.value) / factor; soon(); }}));
  };
  const update = () => {
    const answer = result();
    const share = (value) => (known(value) ? `${number(100 * value, 3)}${NARROW}%` : "n/a");
    const rows = [["damping constant ‹γ›", quantity(answer.damping_constant, "N s/m", 3)], ["work per cycle ‹W›", quantity(answer.work_per_cycle, "J", 3)], ["by relaxation", share(answer.relaxation_share)], ["by slip", share(answer.slip_share)],
      ["‹γ› without slip", quantity(answer.damping_constant_without_slip, "N s/m", 3)], ["mean force", quantity(answer.mean_force, "N", 3)], ["largest force", quantity(answer.max_force, "N", 3)], ["contact time", share(answer.contact_time)], ["regime", answer.regime], ["validity", answer.validity]];
    panel.replaceChildren(h("dl", {}, rows.map(([name, value]) => h("div", {}, h("dt", {}, rich(name)), h("dd", {}, value)))),
      answer.why ? h("p", {class: "why"}, coded(answer.why)) : "",
      h("ul", {class: "verdicts"}, answer.verdicts.map((one) => h("li", {class: one.verdict}, h("strong", {}, `${one.verdict}: `), coded(one.assumption), one.here ? [one.verdict === "unknown" || one.name === "curve" ? "; " : "; here ", coded(one.here)] : "", one.remedy ? [" – ", coded(one.remedy)] : ""))));
    map?.redraw();
  };
  body.append(h("form", {class: "explorer card", onsubmit: (event) => event.preventDefault()},
    h("div", {class: "controls"}, loadChooser(point, "explore-load"), Object.keys(CONTROLS).filter((name) => name in studied).map(control),
      h("label", {for: "explore-hold"}, h("span", {}, "the oscillation holds"), h("select", {id: "explore-hold", oninput: (event) => { set.hold = event.target.value; soon(); }},
        Object.entries(HOLDS).map(([value, text]) => h("option", {value, selected: value === studied.hold ? "" : null}, text)))),
      h("button", {type: "button", onclick: () => { for (const name of Object.keys(studied)) { const input = document.getElementById(`explore-${name}`); input.value = input.defaultValue ?? studied[name]; } Object.assign(set, studied); soon(); }}, "Motion of the study")), panel));
  const map = known(studied.drag_velocity) ? regimeMap(body, point, set) : null;
  onLoad.push(soon);
  update();
}

/** Regimes of the slow motion over velocity and excursion, with the borders of regime_map() of the library, and the entered motion. */
function regimeMap(parent, point, set) {
  const borders = () => {
    const law = lawOf(point), middle = meanIndentation(law, shownLoad(point), set), at = (velocity) => motionOf(law, middle, {...set, drag_velocity: velocity});
    const slips = set.friction_coefficient > 0, critical = slips ? at(1).stretch * set.normal_amplitude * 2 * Math.PI * set.frequency : set.drag_velocity;
    const ends = [Math.min(critical, set.drag_velocity) / 100, Math.max(critical, set.drag_velocity) * 10];
    const velocity = Array.from({length: 31}, (_, i) => ends[0] * (ends[1] / ends[0]) ** (i / 30)), way = velocity.map((v) => at(v).way);
    const bottom = middle - set.normal_amplitude;
    // The value at which a condition that holds at the lower end stops holding, by bisection.
    const last = (low, high, holds) => { if (!holds(low)) return 0; for (let i = 0; i < 40; ++i) { const m = Math.sqrt(low * high); if (holds(m)) low = m; else high = m; } return low; };
    const opens = bottom <= law.touch, stuck = 0.05 * meanForce(law, middle, set.normal_amplitude);
    if (!slips || !(middle + set.normal_amplitude <= law.high)) return {velocity, way, opens: false, noSlip: way.map(() => null), sliding: way.map(() => null)};
    // A contact that opens in every cycle slides from the critical velocity on, at any excursion.
    if (opens) return {velocity, way, opens, noSlip: way.map(() => null), sliding: velocity.map((v, i) => (v >= critical ? way[i] : null))};
    const noSlip = velocity.map((v, i) => {
      const motion = at(v), {stick, opened} = losses(law, middle, {...motion, excursion: way[i]});
      return Math.abs(opened / stick - 1) > 0.05 ? 0 : last(way[i], 1e4 * way[i], (excursion) => slipLoss(law, middle, {...motion, excursion}) <= 0.05 * stick);
    });
    const length = (law.high - law.low) / 1e4;
    const sliding = 2 * at(1).stretch * last(length, bottom - law.deepest, (depth) => law.force(bottom - depth) > stuck);
    return {velocity, way, opens, noSlip, sliding: velocity.map(() => sliding)};
  };
  const mine = () => explore(point, shownLoad(point), set);
  return addFigure(parent, {
    id: "regime-map", title: "Regimes of the slow motion", height: 420,
    alt: () => `Map of regimes over velocity and excursion at ${quantity(point.pressure[shownLoad(point)], "Pa", 3)}; the motion entered, ${quantity(set.drag_velocity, "m/s", 3)} over ${quantity(set.excursion, "m", 3)}: ${mine().regime}.`,
    caption: () => `Regimes at ${quantity(point.pressure[shownLoad(point)], "Pa", 3)} for the normal oscillation and the coefficient of friction entered above. No slip: slip changes the loss by less than 5${NARROW}%. Sliding: less than 5${NARROW}% of the mean normal force is on parts that always stick. Lifts off: the contact opens in every cycle and does not slide as a whole. Grey: the motion is not slow, because one normal cycle covers the excursion.`,
    axes: {x: {label: "velocity ‹v›", unit: "m/s", log: true, fixed: true, values: () => [set.drag_velocity]}, y: {label: "excursion ‹X›", unit: "m", log: true, fixed: true, values: () => [known(set.excursion) ? set.excursion : set.normal_amplitude]}},
    columns: () => { const b = borders(); return [{label: "velocity", key: "velocity", unit: "m/s", values: b.velocity}, {label: "distance per normal cycle", key: "way_per_cycle", unit: "m", values: b.way}, {label: "largest excursion without slip", key: "no_slip_excursion", unit: "m", values: b.noSlip}, {label: "smallest excursion with sliding", key: "sliding_excursion", unit: "m", values: b.sliding}]; },
    plot: () => {
      const b = borders(), x = set.excursion, floor = Math.min(b.way[0], x || Infinity) / 3, top = Math.max(b.way.at(-1), ...b.sliding, x || 0) * 3;
      const first = b.way, second = first.map((w, i) => Math.max(w, b.noSlip[i] ?? 0)), last = first.map(() => top), third = second.map((s, i) => Math.max(s, b.sliding[i] ?? top));
      const region = (label, from, to, paint) => ({label, x: [...b.velocity, ...[...b.velocity].reverse()], y: [...from, ...[...to].reverse()], fill: "toself", mode: "none", fillcolor: paint, hoverinfo: "skip"});
      return {series: [region("not slow", first.map(() => floor), first, faint("slate", 0.35)), ...(b.opens || b.sliding.some(known) ? [b.opens ? region("lifts off", first, third, faint("ochre", 0.4)) : region("no slip", first, second, faint("green", 0.45)), ...(b.opens ? [] : [region("partial slip", second, third, faint("blue", 0.35))]), region("sliding", third, last, faint("vermilion", 0.4))] : []),
        ...(known(x) ? [{label: "motion entered", x: [set.drag_velocity], y: [x], mode: "markers", marker: {symbol: "star", size: 15, color: color("ink")}, text: [`v = ${quantity(set.drag_velocity, "m/s", 3)}, X = ${quantity(x, "m", 3)}: ${mine().regime}`]}] : [])]};
    },
  });
}
