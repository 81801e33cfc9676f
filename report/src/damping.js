// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of damping, and of the convergence of means over the surfaces.
"use strict";

const isDrag = (point) => point.damping?.mode === "drag";

const slipFollowed = (point) => point.slip_followed === "yes" && point.solution?.damping_constant?.mean.some(known);

/** Labels and styles: the loss of the motion as described, and three methods for the loss without slip. */
function routes(point) {
  return {
    ...(slipFollowed(point) ? {solution: {label: "computed, with slip", style: {color: "purple", symbol: "triangle-up", dash: "solid"}}} : {}),
    law: {label: isDrag(point) ? "Eq. (16), fitted ‹l›" : "Eq. (12), fitted ‹l›", style: {color: "vermilion", symbol: "square", dash: "dash"}},
    small: {label: isDrag(point) ? "Eq. (15), ‹F›″ of the curve" : "Eq. (12), ‹F›″ of the curve", style: {color: "ochre", symbol: "diamond", dash: "dot"}},
    curve: {label: slipFollowed(point) ? "computed, without slip" : "computed", style: {color: "blue", symbol: "circle", dash: "solid"}},
  };
}

function describeMotion(damping) {
  const frequency = quantity(damping.angular_frequency / (2 * Math.PI), "Hz", 3);
  const held = {force: "mean force held", auto: "mean force held where the contact lifts off"}[damping.hold] ?? "mean indentation held";
  return damping.mode === "drag"
    ? `drag at ${quantity(damping.drag_velocity, "m/s", 3)} with a normal oscillation of ${quantity(damping.normal_amplitude, "m", 3)} at ${frequency}, ${held}`
    : `normal and tangential oscillation of ${quantity(damping.normal_amplitude, "m", 3)} and ${quantity(damping.tangential_amplitude, "m", 3)} at ${frequency}, phase ${quantity(damping.phase, "rad", 3)}, ${held}`;
}

const MEASURES = {
  damping_constant: {label: "damping constant ‹γ›", short: "‹γ›", unit: "N s/m", title: "damping constant"},
  work_per_cycle: {label: "work per cycle ‹W›", short: "‹W›", unit: "J", title: "work per cycle"},
};

function dampingFigure(parent, point) {
  const damping = point.damping, f = facts(point), force = damping.force;
  const models = point.models.filter((m) => damping.curve?.work_per_cycle?.[m.name]?.mean.some(known) || damping.law?.work_per_cycle?.[m.name]?.mean.some(known));
  let model = models.find((m) => m.name === "bem") ?? models[0], measure = "damping_constant";
  const select = (id, label, options, change) => h("label", {class: "choice", for: id}, label + " ",
    h("select", {id, onchange: (event) => { change(event.target.value); figure.redraw(); }}, options.map(([value, text]) => h("option", {value}, text))));
  // The damping constant is proportional to the work per cycle, with the same factor for all models.
  const constantPerWork = () => {
    const ratios = point.models.flatMap((m) => ["curve", "law"].flatMap((route) => (damping[route]?.work_per_cycle?.[m.name]?.mean ?? []).map((w, i) => damping[route].damping_constant[m.name].mean[i] / w))).filter(known);
    return ratios[0];
  };
  const direct = () => (damping.direct ?? []).map((d) => ({...d, value: d.work_per_cycle * (measure === "work_per_cycle" ? 1 : constantPerWork())}));
  const estimate = (route) => (route !== "solution" ? damping[route]?.[measure]?.[model.name] : model.name !== "bem" ? undefined : ratioOf(point.solution.damping_constant, measure === "work_per_cycle" ? constantPerWork() : 1));
  // The second derivative of a curve may be far from all other values; such points are only in the table.
  const shown = (key) => {
    const values = estimate(key), others = ["solution", "curve", "law"].filter((route) => route in routes(point)).flatMap((route) => estimate(route)?.mean ?? []).filter((v) => v > 0);
    if (key !== "small" || !values || !others.length) return values;
    const near = values.mean.map((v) => v > Math.min(...others) / 5 && v < 5 * Math.max(...others));
    return Object.fromEntries(Object.entries(values).map(([member, list]) => [member, list.map((v, i) => (near[i] ? v : null))]));
  };
  const spec = {
    id: "damping-curve", title: "Damping against force", height: 420,
    controls: [select("damping-model", "Model", [model, ...models.filter((m) => m !== model)].map((m) => [m.name, m.title]), (name) => { model = models.find((m) => m.name === name); }),
      select("damping-measure", "Show", Object.entries(MEASURES).map(([key, m]) => [key, m.title]), (key) => { measure = key; })],
    alt: () => {
      const curve = estimate("curve"), i = curve ? curve.mean.findLastIndex(known) : -1;
      return `${MEASURES[measure].title} against force by ${Object.keys(routes(point)).filter(estimate).length} methods for ${model.title}.` + (i >= 0 ? ` At ${quantity(force[i], "N", 3)}: ${routes(point).curve.label} ${quantity(curve.mean[i], MEASURES[measure].unit, 3)}, ${plainText(routes(point).law.label)} ${quantity(estimate("law")?.mean[i], MEASURES[measure].unit, 3)}.` : "");
    },
    caption: () => `${slipFollowed(point) ? "The loss with slip is that of the motion as described. The loss without slip" : "The loss"} is computed by three methods: the closed form of the paper with the fitted law; the same form with the curvature of the computed curve at each force; and the theorem ‹W› = ½∮‹s›² d‹K›_{t}, which holds at any amplitude. For boundary elements, the theorem uses contacts solved within the oscillation, with bars for the numerical error; for other models it uses their force–gap curve. ${damping.interval_method && f.count > 1 ? `Bands: ${damping.interval_method}. ` : ""}Motion: ${describeMotion(damping)}. No value is shown where the curve of a model does not cover the cycle or the error is larger than the value.${estimate("small") && shown("small").mean.some((v, i) => v !== estimate("small").mean[i]) ? " Points of Eq. (15) that are far from all others are only in the table." : ""}${damping.direct ? " Stars: direct three-dimensional simulation of one surface." : ""}`,
    get axes() { return {x: {label: "mean force ‹F›", short: "‹F›", unit: "N", log: true}, y: {...MEASURES[measure], log: true}}; },
    columns: () => [{label: "force", key: "force", unit: "N", values: force}, {label: "pressure", key: "pressure", unit: "Pa", values: point.pressure},
      ...[["largest force", "max_force", "N"], ["contact time", "contact_time", "1"]].filter(([, key]) => damping[key]?.some(known)).map(([label, key, unit]) => ({label, key, unit, values: damping[key]})),
      ...Object.entries(routes(point)).flatMap(([key, route]) => (estimate(key) ? estimateColumns(route.label, `${key}_${measure}`, MEASURES[measure].unit, estimate(key)) : []))],
    plot: () => ({series: [...(damping.direct ? [{label: "direct simulation", x: direct().map((d) => d.force), y: direct().map((d) => d.value), mode: "markers", marker: {symbol: "star", size: 13, color: color("ink")},
      text: direct().map((d) => `direct simulation, ${escaped(d.file)}: ${quantity(d.value, MEASURES[measure].unit)}<br><i>F</i> = ${quantity(d.force, "N")}`)}] : []), ...Object.entries(routes(point)).flatMap(([key, route]) => {
      const values = shown(key);
      if (!values) return [];
      const reference = estimate("curve");
      const drawn = band(route.label, force, values, route.style, {text: force.map((value, i) => `${plotText(route.label)}: ${quantity(values.mean[i], MEASURES[measure].unit)}`
        + (known(values.low?.[i]) ? `<br>95 %: ${interval({low: values.low[i], high: values.high[i]}, MEASURES[measure].unit)}` : "")
        + (known(values.error?.[i]) && known(values.mean[i]) ? `<br>numerical error ${errorPercent(values.error[i] / Math.abs(values.mean[i]))}` : "")
        + (!["curve", "solution"].includes(key) && known(reference?.mean[i]) ? `<br>${percent(values.mean[i] / reference.mean[i] - 1)} from the computed value` : "") + `<br><i>F</i> = ${quantity(value, "N")}, <i>p</i> = ${quantity(point.pressure[i], "Pa", 3)}`)});
      if (values.error?.some(known)) drawn.at(-1).error_y = {type: "data", array: values.error.map((e, i) => (known(e) && known(values.mean[i]) ? e : 0)), color: color(route.style.color), thickness: 1.5};
      return drawn;
    })].sort((a, b) => Number(b.mode === "none") - Number(a.mode === "none"))}),
  };
  const figure = addFigure(parent, spec);

  const deviation = damping.deviation?.deviation?.bem;
  if (!deviation?.mean.some(known)) return;
  const law = plainText(routes(point).law.label), name = law.split(",")[0];
  const ratio = Object.fromEntries(Object.entries(deviation).map(([member, values]) => [member, values.map((v) => (known(v) ? 1 + v : null))]));
  addFigure(parent, {
    id: "damping-deviation", title: `Deviation of ${name}`, height: 300,
    alt: () => `Ratio of ${law} to the computed damping constant, by force: from ${number(Math.min(...ratio.mean.filter(known)), 3)} to ${number(Math.max(...ratio.mean.filter(known)), 3)}.`,
    caption: `Ratio of the damping constant by ${law}, to the one computed without slip from the same boundary elements${f.count > 1 ? "; ratio of the means over the surfaces, with its 95 % interval" : ""}. The computed value assumes no force law and holds at any amplitude.`,
    axes: {x: {label: "mean force ‹F›", short: "‹F›", unit: "N", log: true}, y: {label: `${name} over computed`, unit: "1", log: true, fixed: true}},
    columns: () => [{label: "force", key: "force", unit: "N", values: force}, ...estimateColumns("ratio", "ratio", "1", ratio)],
    plot: () => ({series: band("ratio", force, ratio, {color: "vermilion", symbol: "square", dash: "solid"},
      {text: force.map((value, i) => `${number(ratio.mean[i], 3)}, deviation ${percent(deviation.mean[i], 3)}` + (known(ratio.low?.[i]) ? `<br>95 %: ${interval({low: ratio.low[i], high: ratio.high[i]}, "1")}` : "") + `<br><i>F</i> = ${quantity(value, "N")}, <i>ū</i> = ${number(point.curve?.mean_gap?.bem?.mean[i] / f.rms, 3)} <i>h</i><sub>rms</sub>`)}),
      shapes: [{type: "line", xref: "paper", x0: 0, x1: 1, y0: 1, y1: 1, line: {color: color("line"), width: 1.5}}]}),
  });
}

/** Ratio of the damping by each model to that by boundary elements. */
function dampingRatioFigure(parent, point) {
  const ratios = point.over_bem?.work_per_cycle;
  const models = point.models.filter((m) => m.name !== "bem" && ratios?.[m.name]?.mean.some(known));
  if (!models.length) return;
  const force = point.damping.force;
  addFigure(parent, {
    id: "damping-models", title: "Damping by other contact models", height: 360,
    alt: () => `Ratio of the damping by each model to that by boundary elements on the same surfaces, by force: ${models.map((m) => `${m.title} from ${number(Math.min(...ratios[m.name].mean.filter(known)), 2)} to ${number(Math.max(...ratios[m.name].mean.filter(known)), 2)}`).join("; ")}.`,
    caption: "Ratio of the damping from the force–gap curve of each model to that by boundary elements, on the same surfaces at the same force. It shows the error of using a model instead of boundary elements.",
    axes: {x: {label: "mean force ‹F›", short: "‹F›", unit: "N", log: true}, y: {label: "over boundary elements", short: "ratio", unit: "1", log: true}},
    columns: () => [{label: "force", key: "force", unit: "N", values: force}, ...models.flatMap((m) => estimateColumns(m.title, `${m.name}_ratio`, "1", ratios[m.name]))],
    plot: () => ({series: models.flatMap((m) => band(m.title, force, ratios[m.name], styleOf(m.name), {text: force.map((value, i) => `${escaped(m.title)}: ${number(ratios[m.name].mean[i], 3)}` + (known(ratios[m.name].low?.[i]) ? `<br>95 %: ${interval({low: ratios[m.name].low[i], high: ratios[m.name].high[i]}, "1")}` : "") + `<br><i>F</i> = ${quantity(value, "N")}`)})),
      shapes: [{type: "line", xref: "paper", x0: 0, x1: 1, y0: 1, y1: 1, line: {color: color("line"), width: 1.5}}]}),
  });
}

/** Compares the points of a parameter grid. */
function overviewFigure(parent, data) {
  const ratio = data.overview?.decay_length_over_rms_height;
  if (!ratio?.mean) return;
  const names = data.points.map((_, i) => data.names[i] || `point ${i + 1}`), places = names.map((_, i) => i + 1);
  const bars = ratio.mean.map((m, i) => [known(ratio.high?.[i]) ? ratio.high[i] - m : 0, known(ratio.low?.[i]) ? m - ratio.low[i] : 0]);
  addFigure(parent, {
    id: "overview", title: "The points of the parameter grid", height: 340,
    alt: () => `l over rms height at each point: ${names.map((n, i) => `${n}: ${number(ratio.mean[i], 3)}`).join("; ")}.`,
    caption: "‹l›/‹h›_{rms} of boundary elements at each point, with 95 % intervals. Choose a point above to see its results.",
    axes: {x: {label: "point", fixed: true, layout: {tickvals: places, ticktext: places.map(String)}}, y: {label: "‹l›/‹h›_{rms}", unit: "1", log: false, fixed: true}},
    columns: () => [{label: "point", key: "point", values: names}, ...estimateColumns("‹l›/‹h›_{rms}", "decay_length_over_rms_height", "1", ratio), ...(data.overview.area_slope ? estimateColumns("area slope κ", "area_slope", "1", data.overview.area_slope) : [])],
    plot: () => ({series: [{label: "l/h", x: places, y: ratio.mean, mode: "markers", marker: {size: 8, color: color("blue")}, error_y: {type: "data", symmetric: false, array: bars.map((b) => b[0]), arrayminus: bars.map((b) => b[1]), color: color("blue"), thickness: 1.5, width: 4},
      text: names.map((n, i) => `${escaped(n)}<br><i>l</i>/<i>h</i><sub>rms</sub> = ${number(ratio.mean[i], 3)}<br>95 %: ${interval({low: ratio.low?.[i], high: ratio.high?.[i]}, "1")}`)}]}),
  });
}
