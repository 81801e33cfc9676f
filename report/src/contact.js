// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of force against mean gap, and of the contact models compared.
"use strict";

const mean = (values) => {
  const there = values.filter(known);
  return there.length ? there.reduce((a, b) => a + b, 0) / there.length : NaN;
};
const ratioOf = (estimate, by) => Object.fromEntries(Object.entries(estimate).map(([member, values]) => [member, values.map((v, i) => (known(v) ? v / (Array.isArray(by) ? by[i] : by) : null))]));

/** Numbers of one point of the parameter grid that several figures use. */
function facts(point) {
  const area = point.surface ? point.surface.size_x * point.surface.size_y : NaN;
  const statistic = (name) => point.surface?.statistics?.find((s) => s.name === name)?.mean;
  const rms = statistic("rms_height");
  const scale = (point.damping?.contact_modulus ?? NaN) * (statistic("rms_slope") ?? NaN);
  const fit = point.fit?.bem;
  const result = {area, rms, scale, force: point.pressure.map((p) => p * area), count: point.surface?.realisations ?? 1};
  if (fit && fit.reference_pressure) {
    // Mean over the surfaces of the fitted gap at a given pressure: ū = ⟨l ln p0⟩ − ⟨l⟩ ln p.
    const usable = fit.decay_length.map((_, i) => i).filter((i) => known(fit.decay_length[i]) && fit.reference_pressure[i] > 0);
    result.length = mean(usable.map((i) => fit.decay_length[i]));
    result.logReference = mean(usable.map((i) => fit.decay_length[i] * Math.log(fit.reference_pressure[i]))) / result.length;
    result.pressureMin = mean(fit.pressure_min);
    result.pressureMax = mean(fit.pressure_max);
    result.gapOf = (p) => result.length * (result.logReference - Math.log(p));
    result.pressureOf = (gap) => Math.exp(result.logReference - gap / result.length);
  }
  return result;
}

function forceGapFigure(parent, point) {
  const f = facts(point), gap = point.curve.mean_gap.bem;
  const fitted = known(f.length);
  const residual = fitted ? gap.mean.map((g, i) => (known(g) ? point.pressure[i] / f.pressureOf(g) - 1 : null)) : [];
  const text = gap.mean.map((g, i) => `<i>F</i> = ${quantity(f.force[i], "N")}, <i>p</i> = ${quantity(point.pressure[i], "Pa")}<br><i>ū</i> = ${quantity(g, "m")} = ${number(g / f.rms, 3)} <i>h</i><sub>rms</sub>`
    + (known(gap.low?.[i]) ? `<br>95 %: ${interval({low: gap.low[i], high: gap.high[i]}, "m")}` : "") + (known(residual[i]) ? `<br>deviation from the fit ${percent(residual[i])}` : ""));
  const inside = point.pressure.map((p) => fitted && p >= f.pressureMin * (1 - 1e-9) && p <= f.pressureMax * (1 + 1e-9));
  const worst = Math.max(...residual.filter((r, i) => inside[i] && known(r)).map(Math.abs), 0);
  addFigure(parent, {
    id: "force-gap", title: "Force against mean gap", height: 520,
    alt: () => `Force by boundary elements on a logarithmic scale against the mean gap: from ${quantity(f.force[0], "N", 3)} at a gap of ${quantity(gap.mean[0], "m", 3)} to ${quantity(f.force.at(-1), "N", 3)} at ${quantity(gap.mean.at(-1), "m", 3)}.`
      + (fitted ? ` The fitted line has the decay length ${quantity(f.length, "m", 3)}; within the window of the fit the force deviates from it by at most ${number(100 * worst, 2)} %.` : " No law was fitted."),
    caption: () => "Force ‹F› against mean gap ‹ū› by boundary elements" + (f.count > 1 ? `: mean of ${f.count} surfaces with the 95 % band of the mean gap, and ${point.samples?.length < f.count ? `the first ${point.samples.length} surfaces` : "each surface"} as a thin line` : "")
      + (fitted ? `. The line is ‹F› = ‹F›_{0} exp(−‹ū›/‹l›) with ‹l› = ${quantity(f.length, "m", 3)}, fitted in the shaded window and extended beyond it. The lower panel shows the deviation of the force from this line, at most ${number(100 * worst, 2)}${NARROW}% within the window. Points on a straight line mean an exponential law; points on a curve mean that this law fails.` : "."),
    axes: {x: {label: "mean gap ‹ū›", short: "‹ū›", unit: "m", log: false}, y: {label: "force ‹F›", short: "‹F›", unit: "N", log: true, values: () => f.force, layout: {domain: fitted ? [0.4, 1] : [0, 1]}},
      ...(fitted ? {y2: {label: "deviation from fit", fixed: true, percent: true, layout: {domain: [0, 0.32], zeroline: true, zerolinecolor: color("vermilion"), zerolinewidth: 2}}} : {})},
    columns: () => [{label: "pressure", key: "pressure", unit: "Pa", values: point.pressure}, {label: "force", key: "force", unit: "N", values: f.force},
      ...estimateColumns("mean gap", "mean_gap", "m", gap),
      ...(fitted ? [{label: "force of the fit", key: "fit_force", unit: "N", values: gap.mean.map((g) => (known(g) ? f.pressureOf(g) * f.area : null))}, {label: "deviation from the fit", key: "off_the_fit", unit: "1", values: residual, digits: 3}] : [])],
    plot: () => {
      const series = [], shapes = [], annotations = [];
      if (fitted) {
        const ends = [f.gapOf(f.pressureMax), f.gapOf(f.pressureMin)];
        shapes.push({type: "rect", x0: ends[0], x1: ends[1], y0: 0, y1: 1, yref: "paper", fillcolor: faint("vermilion", 0.1), line: {width: 0}, layer: "below"});
        annotations.push({x: (ends[0] + ends[1]) / 2, y: 1, yref: "paper", text: "window of the fit", showarrow: false, yanchor: "top", font: {color: color("muted"), size: 12}});
      }
      if (f.count > 1)
        (point.samples ?? []).forEach((row) => series.push({label: "single surfaces", group: "single", x: row, y: f.force, mode: "lines", line: {color: faint("blue", 0.28), width: 1}, hoverinfo: "skip"}));
      const there = gap.mean.map((_, i) => i).filter((i) => known(gap.low?.[i]));
      if (there.length > 1 && f.count > 1) {
        series.push({label: "95 % band", x: [...there.map((i) => gap.low[i]), ...[...there].reverse().map((i) => gap.high[i])], y: [...there, ...[...there].reverse()].map((i) => f.force[i]),
          fill: "toself", mode: "none", fillcolor: faint("blue", 0.2), hoverinfo: "skip"});
      }
      if (fitted) {
        const gaps = gap.mean.filter(known), low = Math.min(...gaps), high = Math.max(...gaps);
        const line = Array.from({length: 41}, (_, i) => low + ((high - low) * i) / 40);
        // Far from the window of the fit the line would dwarf the curve.
        const shown = line.map((g) => [g, f.pressureOf(g) * f.area]).filter(([, y]) => y < 3 * f.force.at(-1));
        series.push({label: "‹F›_{0} exp(−‹ū›/‹l›)", x: shown.map(([g]) => g), y: shown.map(([, y]) => y), mode: "lines", line: {color: color("vermilion"), width: 2, dash: "dash"}, hoverinfo: "skip"});
        series.push({label: "deviation from the fit", quiet: true, group: "boundary elements", x: gap.mean, y: residual, yaxis: "y2", mode: "lines+markers", line: {color: color("blue"), width: 1.5}, marker: {size: 7, color: color("blue")}, text});
      }
      series.push({label: f.count > 1 ? "boundary elements, mean" : "boundary elements", group: "boundary elements", x: gap.mean, y: f.force, mode: "lines+markers", line: {color: color("blue"), width: 2}, marker: {size: 6, color: color("blue")}, text});
      // The axis shows all residuals unless those outside the window would make those within it unreadable.
      const limit = Math.max(Math.min(1.15 * Math.max(...residual.filter(known).map(Math.abs), 0), 4 * worst), 0.02);
      return {series, shapes, annotations, ...(fitted ? {axes: {yaxis2: {range: [-limit, limit], nticks: 4}, xaxis: {anchor: "y2"}}} : {})};
    },
  });
}

function localLengthFigure(parent, point) {
  const local = point.local, f = facts(point);
  if (!local?.mean_gap?.length) return;
  const rows = local.mean_gap.length;
  const single = rows === 1;
  addFigure(parent, {
    id: "local-length", title: "Is the decay length a constant?", height: 520,
    alt: () => `Local decay length against the mean gap, for ${rows} ${single ? "surface" : "surfaces"}: from ${quantity(Math.min(...local.local_decay_length.flat().filter(known)), "m", 3)} to ${quantity(Math.max(...local.local_decay_length.flat().filter(known)), "m", 3)}; the fit gives ${quantity(f.length, "m", 3)}.`,
    caption: `Local decay length −d‹ū›/d ln ‹p› between neighbouring loads. An exponential law gives a horizontal line${known(f.length) ? `; the fit has ‹l› = ${quantity(f.length, "m", 3)} (dashed) in the shaded window` : ""}.`,
    axes: {x: {label: "mean gap ‹ū›", short: "‹ū›", unit: "m", log: false, fixed: true}, y: {label: "local decay length", unit: "m", log: false}},
    columns: () => [{label: "surface", key: "surface", unit: "1", values: local.mean_gap.flatMap((row, r) => row.map(() => r + 1))}, {label: "mean gap", key: "mean_gap", unit: "m", values: local.mean_gap.flat()}, {label: "local decay length", key: "local_decay_length", unit: "m", values: local.local_decay_length.flat()}],
    plot: () => {
      const shapes = [];
      if (known(f.length)) {
        shapes.push({type: "rect", x0: f.gapOf(f.pressureMax), x1: f.gapOf(f.pressureMin), y0: 0, y1: 1, yref: "paper", fillcolor: faint("vermilion", 0.1), line: {width: 0}, layer: "below"});
        shapes.push({type: "line", x0: 0, x1: 1, xref: "paper", y0: f.length, y1: f.length, line: {color: color("vermilion"), width: 2, dash: "dash"}});
      }
      return {shapes, axes: {yaxis: {rangemode: "tozero"}}, series: local.mean_gap.map((row, r) => ({label: "single surfaces", group: "single", x: row, y: local.local_decay_length[r], mode: single ? "lines+markers" : "lines", line: {color: single ? color("blue") : faint("blue", 0.45), width: single ? 2 : 1.2}, marker: {size: 5, color: color("blue")},
        text: row.map((g, i) => `${single ? "" : `surface ${r + 1}<br>`}<i>l</i> = ${quantity(local.local_decay_length[r][i], "m", 3)} = ${number(local.local_decay_length[r][i] / f.rms, 3)} <i>h</i><sub>rms</sub><br><i>ū</i> = ${quantity(g, "m", 3)}`)}))};
    },
  });
}

// Abramowitz and Stegun 7.1.26, accurate to 1.5e-7.
function erf(x) {
  const t = 1 / (1 + 0.3275911 * x);
  return 1 - ((((1.061405429 * t - 1.453152027) * t + 1.421413741) * t - 0.284496736) * t + 0.254829592) * t * Math.exp(-x * x);
}

/** One quantity of every model over the pressure, with bands and the curves of theories. */
function modelFigure(parent, point, {id, title, quantity: name, convert, y, caption, theories = [], extra = []}) {
  const f = facts(point), all = point.models.filter((m) => point.curve?.[name]?.[m.name]);
  const value = Object.fromEntries(all.map((m) => [m.name, convert ? convert(point.curve[name][m.name], f, m.name) : point.curve[name][m.name]]));
  const models = all.filter((m) => value[m.name].mean.some(known));
  if (!models.length) return;
  const relative = known(f.scale);
  const x = relative ? point.pressure.map((p) => p / f.scale) : point.pressure;
  const bem = value.bem?.mean, middle = Math.floor(x.length / 2);
  addFigure(parent, {
    id, title,
    alt: () => `${plainText(title)} over the pressure for ${models.map((m) => m.title).join("; ")}. At ${quantity(point.pressure[middle], "Pa", 3)}: ${models.map((m) => `${m.title} ${number(value[m.name].mean[middle], 3)}`).join(", ")}.`,
    caption, axes: {x: {label: relative ? "pressure ‹p›/(‹E›*‹h›′)" : "pressure", short: "‹p›", unit: relative ? "1" : "Pa", log: true}, y},
    columns: () => [{label: "pressure", key: "pressure", unit: "Pa", values: point.pressure}, ...(relative ? [{label: "pressure over ‹E›*‹h›′", key: "relative_pressure", unit: "1", values: x}] : []),
      ...models.flatMap((m) => estimateColumns(m.title, `${m.name}_${name}`, "1", value[m.name])), ...(relative ? theories : []).map((t) => ({label: t.label, key: t.key, unit: "1", values: x.map(t.of)}))],
    plot: () => {
      const series = [];
      if (relative)
        theories.forEach((t, i) => series.push({label: t.label, x, y: x.map(t.of), mode: "lines", line: {color: color("muted"), width: 1.5, dash: ["dot", "dash", "dashdot"][i]}, text: x.map((v, k) => `${escaped(plainText(t.label))}: ${number(t.of(v), 3)}<br><i>p</i> = ${quantity(point.pressure[k], "Pa", 3)}`)}));
      for (const {label, estimate, style} of extra) series.push(...band(label, x, estimate, style));
      for (const model of [...models].reverse()) {
        const estimate = value[model.name];
        series.push(...band(model.title, x, estimate, styleOf(model.name), {text: x.map((v, k) => `${escaped(model.title)}: ${number(estimate.mean[k], 4)}`
          + (known(estimate.low?.[k]) ? `<br>95 %: ${interval({low: estimate.low[k], high: estimate.high[k]}, "1")}` : "") + (bem && model.name !== "bem" && known(bem[k]) ? `<br>${percent(estimate.mean[k] / bem[k] - 1)} from boundary elements` : "")
          + `<br><i>p</i> = ${quantity(point.pressure[k], "Pa", 3)}${relative ? ` = ${number(v, 2)} <i>E</i>* <i>h</i>′` : ""}`)}));
      }
      return {series: series.reverse().sort((a, b) => Number(b.mode === "none") - Number(a.mode === "none"))};
    },
  });
}

function modelFigures(parent, point) {
  const spots = point.edge_corrected_area_fraction;
  modelFigure(parent, point, {
    id: "area-load", title: "Contact area", quantity: "contact_area_fraction",
    y: {label: "contact area ‹A›/‹A›_{0}", short: "‹A›/‹A›_{0}", unit: "1", log: true},
    theories: [{label: "Persson, erf(√2 ‹p›/(‹E›*‹h›′))", key: "persson_theory", of: (p) => erf(Math.SQRT2 * p)}, {label: "Bush, Gibson, Thomas, √(2π) ‹p›/(‹E›*‹h›′)", key: "bgt", of: (p) => Math.sqrt(2 * Math.PI) * p}],
    extra: spots ? [{label: "boundary elements, corrected for edge cells", estimate: spots, style: {color: "blue", symbol: "circle-open", dash: "dot"}}] : [],
    caption: "True contact area over nominal area. Summits of Greenwood–Williamson models do not interact unless the model says so; boundary elements include the interaction. The theories hold for small loads, Persson's up to full contact. On a grid the contact area is too large by about half of the cells at its edge; the dotted curve is corrected for this.",
  });
  modelFigure(parent, point, {
    id: "gap-load", title: "Mean gap", quantity: "mean_gap", convert: (e, f) => ratioOf(e, f.rms),
    y: {label: "mean gap ‹ū›/‹h›_{rms}", short: "‹ū›", unit: "1", log: false},
    caption: "Mean gap of the deformed surfaces under the same pressure. A straight line here means an exponential law; its slope is −‹l›/‹h›_{rms}.",
  });
  modelFigure(parent, point, {
    id: "stiffness-load", title: "Normal stiffness", quantity: "normal_stiffness", convert: (e, f) => ratioOf(e, f.force.map((force) => force / f.rms)),
    y: {label: "stiffness ‹K› ‹h›_{rms}/‹F›", short: "‹K›", unit: "1", log: false},
    caption: "Normal stiffness over force, in units of 1/‹h›_{rms}. For an exponential law it is the constant ‹h›_{rms}/‹l›.",
  });
  const ratio = point.damping?.modulus_ratio, normal = point.curve?.normal_stiffness;
  modelFigure(parent, point, {
    id: "stiffness-ratio", title: "Tangential over normal stiffness", quantity: "tangential_stiffness",
    convert: (e, _, name) => ({mean: e.mean.map((v, i) => (known(v) && known(normal?.[name]?.mean[i]) ? v / normal[name].mean[i] : null))}),
    y: {label: "‹K›_{t}/‹K›", short: "‹K›_{t}/‹K›", unit: "1", log: false, fixed: true, layout: {rangemode: "tozero"}},
    theories: known(ratio) ? [{label: "‹G›*/‹E›*", key: "modulus_ratio", of: () => ratio}] : [],
    caption: `Ratio of the mean stiffnesses. The closed forms assume ‹K›_{t} = (‹G›*/‹E›*)‹K›, which holds for circular spots; stiffnesses computed for the real contacts show how accurate that is here. ${(point.damping?.tangential_stiffness ?? "").replace(/^boundary elements: (.*)$/, "For boundary elements: $1.")}`,
  });
}

/** Decay length and area slope of each model, as a table that is always shown. */
function modelTable(point) {
  const fits = point.fit?.models;
  if (!fits) return null;
  const models = point.models.filter((m) => fits[m.name]);
  const of = (name) => models.map((m) => fits[m.name][name]);
  const text = (estimates, unit) => estimates.map((e) => interval(e, unit) || "–");
  const columns = [{label: "model", key: "model", values: models.map((m) => m.title)}];
  if (of("decay_length").some(Boolean)) columns.push({label: "‹l›", key: "decay_length", unit: "m", values: of("decay_length").map((e) => e?.mean)}, {label: "95 % interval", key: "interval", values: text(of("decay_length"), "m")});
  if (of("decay_length_over_rms_height").some(Boolean)) columns.push({label: "‹l›/‹h›_{rms}", key: "ratio", unit: "1", digits: 3, values: of("decay_length_over_rms_height").map((e) => e?.mean)}, {label: "95 % interval", key: "ratio_interval", values: text(of("decay_length_over_rms_height"), "1")});
  if (of("area_slope").some(Boolean)) columns.push({label: "area slope κ", key: "area_slope", unit: "1", digits: 3, values: of("area_slope").map((e) => e?.mean)}, {label: "95 % interval", key: "slope_interval", values: text(of("area_slope"), "1")});
  return table("Decay length of ‹F› ∝ exp(−‹ū›/‹l›), and slope of ‹A›/‹A›_{0} over ‹p›/(‹E›*‹h›′), by model", columns, true);
}
