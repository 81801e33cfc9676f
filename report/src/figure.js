// SPDX-License-Identifier: GPL-3.0-or-later
// One figure: its plot, legend, switches, CSV and table, and its text for screen readers.
"use strict";

const dark = matchMedia("(prefers-color-scheme: dark)");
const printing = matchMedia("print");
const drawn = [];  // every figure on the page, drawn when it comes near and again when colours change

/** Draws a figure when it comes near to what is in sight, so that the page opens without waiting for all of them. */
const nearby = new IntersectionObserver((entries) => {
  for (const {target} of entries.filter((entry) => entry.isIntersecting)) {
    nearby.unobserve(target);
    drawNow(drawn.filter((figure) => figure.element === target));
  }
}, {rootMargin: "60% 0px"});

function drawNow(figures) {
  for (const figure of figures) {
    figure.near = true;
    figure.redraw();
  }
}

/** A colour of report.css. */
const color = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** A colour of report.css, #rrggbb, with an opacity. */
function faint(name, opacity) {
  const value = parseInt(color(name).slice(1), 16);
  return `rgba(${value >> 16}, ${(value >> 8) & 255}, ${value & 255}, ${opacity})`;
}

const axisFont = () => ({family: getComputedStyle(document.body).fontFamily, size: 13, color: color("ink")});

/**
 * spec  {id, title, caption, alt, height?, columns, axes: {x: {label, unit, log, fixed?}, y: …}, controls?, square?, plot(tools)}
 *       axes      label: without unit; log: initial scale; fixed: no switch; values: returns the values that determine the SI prefix
 *       plot      returns {series, shapes?, layout?}; a series is a plotly trace in SI units with {label, group?}
 *       controls  elements before the switches; they call figure.redraw()
 */
function addFigure(parent, spec) {
  const state = {hidden: new Set()};
  for (const [name, axis] of Object.entries(spec.axes)) state[name] = axis.log ? "log" : "linear";
  const plot = h("div", {class: "plot", id: `${spec.id}-plot`, role: "img", "aria-label": plainText(spec.alt()), style: `height:${spec.height ?? 380}px`});
  const legend = h("div", {class: "legend", role: "group", "aria-label": `Curves of ${plainText(spec.title)}: show or hide`});
  const details = h("details", {}, h("summary", {}, "Numbers as a table"));
  const switches = Object.entries(spec.axes).filter(([, axis]) => !axis.fixed).map(([name, axis]) =>
    h("label", {class: "switch"},
      h("input", {type: "checkbox", checked: state[name] === "log", "data-axis": name,
        onchange: (event) => { state[name] = event.target.checked ? "log" : "linear"; figure.redraw(); }}),
      h("span", {}, "log ", rich(axis.short ?? axis.label))));
  const caption = h("figcaption"), place = drawn.length + 1;
  const figure = {
    element: h("figure", {id: spec.id, "aria-labelledby": `${spec.id}-title`},
      h("h3", {id: `${spec.id}-title`}, rich(spec.title)),
      h("div", {class: "tools"}, spec.controls ?? null, switches,
        h("span", {class: "files"}, h("button", {type: "button", class: "csv", "aria-label": `Download the numbers of ${plainText(spec.title)} as CSV`,
          onclick: () => {
            download(`${spec.id}.csv`, "text/csv", csv((spec.csv ?? spec.columns)()));
            document.getElementById("live").textContent = `${spec.id}.csv is downloaded`;
          }}, "CSV"),
        h("button", {type: "button", class: "svg", "aria-label": `Download the picture of ${plainText(spec.title)} as SVG`, onclick: () => pictureOf(spec.id, plot)}, "SVG"))),
      plot, legend, caption, details),
    near: false,
    redraw() {
      if (figure.near) draw(spec, state, plot, legend, figure);
      plot.setAttribute("aria-label", plainText(spec.alt()));
      caption.replaceChildren(h("b", {}, `Figure ${place}. `), ...rich(typeof spec.caption === "function" ? spec.caption() : spec.caption, true));
      if (details.open) fill();
    },
    plot,
  };
  const fill = () => details.replaceChildren(details.firstChild, table(`Numbers of ${spec.title}`, spec.columns(), true));
  details.addEventListener("toggle", () => { if (details.open) fill(); });
  parent.append(figure.element);
  drawn.push(figure);
  figure.redraw();
  nearby.observe(figure.element);
  return figure;
}

/** Downloads the picture as shown, as SVG for a paper or a slide. */
async function pictureOf(id, plot) {
  // The legend of the page is not part of the plot.
  const names = plot.data.filter(({showlegend, visible}) => showlegend && visible).length;
  const layout = {...plot.layout, showlegend: names > 1, legend: {orientation: "h", y: -0.2}};
  const address = await Plotly.toImage({data: plot.data, layout}, {format: "svg", width: plot.clientWidth, height: plot.clientHeight + (names > 1 ? 20 * names : 0)});
  download(`${id}.svg`, "image/svg+xml", decodeURIComponent(address.slice(address.indexOf(",") + 1)));
  document.getElementById("live").textContent = `${id}.svg is downloaded`;
}

const scaled = (values, factor) => values.map((v) => (known(v) ? v * factor : null));

/** Scales the error bars of a trace to the units of its axis. */
const scaledBars = (bars, factor) => ({...bars, ...Object.fromEntries(["array", "arrayminus"].filter((arm) => bars[arm]).map((arm) => [arm, scaled(bars[arm], factor)]))});

/** Labels of a logarithmic axis: plain numbers if they are short; 1, 2 and 5 of each decade if there are few decades. */
function logarithmicTicks(values) {
  const there = values.filter((v) => known(v) && v > 0);
  if (!there.length) return {};
  const low = Math.log10(Math.min(...there)), high = Math.log10(Math.max(...there));
  return {exponentformat: low > -3.5 && high < 4.5 ? "none" : "power", ...(high - low > 2.2 ? {dtick: 1} : high - low > 0.7 ? low < -3.5 || high > 4.1 ? {dtick: 1} : {minor: {}, tickvals: [-1, 0, 1, 2, 3].flatMap((decade) => [1, 2, 5].map((first) => Number(`${first}e${Math.floor(low) + decade}`)))} : {})};
}

function axisLayout(axis, mode, scale, values) {
  const label = plotText(axis.label) + (scale.label ? ` (${plotText(scale.label)})` : "");
  return {
    type: mode, title: {text: label, standoff: 8}, automargin: true, gridcolor: color("grid"), linecolor: color("line"), zeroline: false,
    showline: true, ticks: "outside", tickcolor: color("line"), ticklen: 4, exponentformat: "power", showexponent: "all", minexponent: 4,
    minor: mode === "log" ? {showgrid: false, ticks: "outside", ticklen: 2, tickcolor: color("line")} : {},
    ...(mode === "log" ? logarithmicTicks(values.map((v) => v * scale.factor)) : {}),
    ...(axis.limits && axis.log === (mode === "log") ? {range: axis.limits.map((limit) => (axis.log ? Math.log10(limit * scale.factor) : limit * scale.factor))} : {}),
    ...(axis.layout ?? {}),
  };
}

function draw(spec, state, plot, legend, figure) {
  const content = spec.plot({state});
  const all = (name) => content.series.filter((s) => s.type !== "heatmap").flatMap((s) => Array.from(s[name] ?? []).filter((_, k) => known(s.x[k]) && known(s.y[k])));
  const scales = {}, layout = {
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", font: axisFont(), showlegend: false, hovermode: "closest",
    separators: `.${NARROW}`, margin: {l: 12, r: 14, t: 8, b: 12}, dragmode: matchMedia("(pointer: coarse)").matches ? false : "zoom", autosize: true,
    hoverlabel: {bgcolor: color("raised"), bordercolor: color("line"), font: {...axisFont(), color: color("ink")}, align: "left"},
    modebar: {bgcolor: "rgba(0,0,0,0)", color: color("muted"), activecolor: color("blue")},
  };
  for (const [name, axis] of Object.entries(spec.axes)) {
    scales[name] = axis.unit === undefined ? {factor: 1, label: ""} : scaleFor(axis.values ? axis.values() : all(name), axis.unit);
    layout[`${name}axis`] = axisLayout(axis, state[name], scales[name], axis.log === undefined ? [] : all(name));
  }
  const traces = content.series.map((series) => {
    const {label, group, quiet, ...trace} = series;
    const hidden = state.hidden.has(group ?? label);
    for (const letter of ["x", "y"]) if (trace[`error_${letter}`]) trace[`error_${letter}`] = scaledBars(trace[`error_${letter}`], scales[letter].factor);
    return {
      ...trace, name: plotText(label ?? ""), showlegend: Boolean(label) && !quiet, visible: !hidden, x: scaled(Array.from(trace.x), scales.x.factor),
      y: scaled(Array.from(trace.y), scales.y.factor), ...(trace.text ? {hovertemplate: "%{text}<extra></extra>", hoverinfo: "text"} : {}),
    };
  });
  // Shapes are in SI units too.
  const place = (shape) => {
    const moved = {...shape};
    for (const letter of ["x", "y"]) {
      if (shape[`${letter}ref`]) continue;
      for (const end of [`${letter}0`, `${letter}1`]) if (moved[end] !== undefined) moved[end] *= scales[letter].factor;
    }
    return moved;
  };
  layout.shapes = (content.shapes ?? []).map(place);
  Object.assign(layout, content.layout?.(scales) ?? {});
  Plotly.react(plot, traces, layout, {responsive: true, displaylogo: false, displayModeBar: matchMedia("(pointer: coarse)").matches ? false : "hover", modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
    toImageButtonOptions: {filename: spec.id, scale: 2}});
  drawLegend(content.series, state, legend, figure);
}

// The markers of the curves, in the shapes that plotly draws.
const LEGEND_MARKS = {
  circle: `<circle cx="14" cy="5" r="3.2"/>`, "circle-open": `<circle class="open" cx="14" cy="5" r="3"/>`, square: `<rect x="11" y="2" width="6" height="6"/>`,
  "triangle-down": `<path class="solid" d="M14 8.8L18 1.8H10Z"/>`, pentagon: `<path class="solid" d="M14 1.2L17.8 4L16.4 8.4H11.6L10.2 4Z"/>`,
  diamond: `<path class="solid" d="M14 1L18 5L14 9L10 5Z"/>`, "triangle-up": `<path class="solid" d="M14 1.2L18 8.2H10Z"/>`, star: `<path class="solid" d="M14 0.5L15.3 3.6L18.7 3.9L16.1 6.1L16.9 9.4L14 7.6L11.1 9.4L11.9 6.1L9.3 3.9L12.7 3.6Z"/>`,
  cross: `<path class="solid" d="M12.7 1.5H15.3V3.7H17.5V6.3H15.3V8.5H12.7V6.3H10.5V3.7H12.7Z"/>`, x: `<path class="open" d="M11 2L17 8M17 2L11 8"/>`,
};

/** Draws the legend as buttons, so that curves can be hidden by keyboard too, each with a sample of its curve. */
function drawLegend(series, state, legend, figure) {
  const entries = new Map();
  for (const s of series) {
    if (!s.label || s.quiet) continue;
    const key = s.group ?? s.label;
    if (!entries.has(key)) entries.set(key, s);
  }
  const focused = legend.contains(document.activeElement) ? document.activeElement.dataset.key : null;
  legend.replaceChildren(...(entries.size < 2 ? [] : [...entries].map(([key, s]) => {
    const dash = {solid: "none", dash: "6 3", dot: "2 3", dashdot: "6 3 2 3", longdashdot: "9 3 2 3", longdash: "9 3"}[s.line?.dash ?? "solid"];
    const paint = s.line?.color ?? s.marker?.color ?? s.fillcolor;
    const sample = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    sample.setAttribute("viewBox", "0 0 28 10");
    sample.setAttribute("aria-hidden", "true");
    sample.innerHTML = s.mode === "none" ? `<rect x="0" y="0" width="28" height="10" rx="2"/>`
      : (s.mode === "markers" ? "" : `<path d="M0 5H28" stroke-dasharray="${dash}"/>`) + (s.mode?.includes("markers") ? LEGEND_MARKS[s.marker?.symbol ?? "circle"] ?? LEGEND_MARKS.circle : "");
    sample.style.color = paint;
    const button = h("button", {type: "button", "data-key": key, "aria-pressed": String(!state.hidden.has(key)),
      onclick: () => {
        if (!state.hidden.delete(key)) state.hidden.add(key);
        figure.redraw();
      }}, sample, h("span", {}, rich(s.label)));
    if (key === focused) queueMicrotask(() => button.focus());
    return button;
  })));
}

function redrawAll() {
  for (const figure of drawn) figure.redraw();
}
dark.addEventListener("change", redrawAll);
addEventListener("beforeprint", () => drawNow(drawn));
printing.addEventListener("change", () => {
  if (printing.matches) drawNow(drawn);
  for (const figure of drawn.filter(({near}) => near)) Plotly.Plots.resize(figure.plot);
  redrawAll();
});

// Building blocks of plots.

/** Traces of an estimate {mean, low, high} over x: the mean and its band. */
function band(label, x, estimate, style, more = {}) {
  const series = [];
  const inside = x.map((_, i) => i).filter((i) => known(estimate.low?.[i]) && known(estimate.high?.[i]));
  if (inside.length > 1) {
    const there = inside, back = [...inside].reverse();
    series.push({label, group: label, quiet: true, x: [...there, ...back].map((i) => x[i]),
      y: [...there.map((i) => estimate.high[i]), ...back.map((i) => estimate.low[i])],
      fill: "toself", mode: "none", type: "scatter", fillcolor: faint(style.color, 0.18), hoverinfo: "skip"});
  }
  series.push({label, group: label, x, y: estimate.mean, type: "scatter", mode: more.markers === false ? "lines" : "lines+markers",
    line: {color: color(style.color), width: 2, dash: style.dash}, marker: {symbol: style.symbol, size: 6, color: color(style.color)},
    text: more.text});
  return series;
}

/** Columns of those of mean, low, high and error that an estimate has. */
function estimateColumns(label, key, unit, estimate) {
  const columns = [{label, key, unit, values: estimate.mean}];
  if (estimate.low?.some(known)) {
    columns.push({label: `${label}, low`, key: `${key}_low`, unit, values: estimate.low},
      {label: `${label}, high`, key: `${key}_high`, unit, values: estimate.high});
  }
  return columns;
}

// Figures of the library: include/salebra/figures/figure.hpp describes their members.

const CURVE_STYLES = [["blue", "circle"], ["vermilion", "square"], ["green", "triangle-up"], ["purple", "diamond"], ["ochre", "triangle-down"], ["slate", "pentagon"], ["ink", "x"], ["muted", "cross"], ["vermilion", "star"]];
const CURVE_DASHES = {dashed: "dash", dotted: "dot"};
const LINE_DASHES = ["longdash", "longdashdot", "dashdot", "dot"];
const PALETTES = {sequential: "Viridis", diverging: "RdBu", grey: "Greys"};

/** The text of a figure of the library in the markup of the page: a_b and a_{b} become a_{b}, a backslash makes the next character plain, and symbols are slanted. */
const libraryText = (text) => text.replace(/\\(.)|([_^])(?:\{([^}]*)\}|(.))/gu, (_, plain, mark, braced, one) => plain ?? `${mark}{${braced ?? one}}`)
  .replace(/(\d) (?=(?:[afpnµmkMG]?(?:m|N|Pa|J)|%)(?:[²\s,;.)]|$))/gu, `$1${NARROW}`)
  .replace(/(?<![\p{L}\d‹]|\d[\s\u202f])[pFūlhKEGuvWγCqH](?![\p{L}\d›])/gu, "‹$&›");

const libraryAxis = (axis, fixed) => ({label: libraryText(axis.label), unit: axis.unit || "1", log: axis.logarithmic, fixed, ...(known(axis.prefix_of) ? {values: () => [axis.prefix_of]} : {}), ...(axis.high === undefined ? {} : {limits: [axis.low, axis.high]})});

/** A value with its unit, in words for the pointer and for screen readers. */
const worded = (axis, value) => `${libraryText(axis.label)} ${quantity(value, axis.unit || "1", 4)}`;

/** Draws a figure of the library with this name, if the file has its data. more: parts of the specification that addFigure() takes. */
function libraryFigure(parent, point, name, more = {}) {
  const found = point.figures?.find(({kind}) => kind === name);
  if (!found) return null;
  const panel = found.panels[0], image = panel.image;
  if (!image && !panel.curves.some(({y}) => y.some(known))) return null;
  const parts = image ? mapOf(panel) : curvesOf(panel);
  const heading = libraryText(panel.title);
  return addFigure(parent, {id: name, title: libraryText(found.title), caption: `${libraryText(found.caption)}${heading.includes(" = ") ? ` ${heading.replace(/^\p{Ll}(?=\p{Ll})/u, (first) => first.toUpperCase())}.` : ""}${image ? MAP_NOTE(point.picture) : ""}`, ...parts, ...more});
}

/** Curves over a common or an own x, with bands or error bars, lines across the panel and shaded ranges. */
function curvesOf({x, y, second_x, second_y, curves: all, lines, ranges}) {
  const curves = all.filter((curve) => curve.y.some(known));
  const style = (curve, i) => { const [paint, symbol] = CURVE_STYLES[curve.color < 0 ? i % 7 : curve.color]; return {color: paint, symbol, dash: CURVE_DASHES[curve.style] ?? "solid"}; };
  // A curve without a name is one more of those of its colour.
  const nameOf = (curve) => libraryText(curve.name || curves.find(({name, color: same}) => name && same === curve.color)?.name || y.label), key = (curve) => (curve.quantity || y.quantity || "y");
  const common = curves.every((curve) => curve.x.length === curves[0].x.length && curve.x.every((v, k) => v === curves[0].x[k]));
  const twice = curves.some((curve, i) => curves.findIndex((other) => key(other) === key(curve)) !== i);
  const keyOf = (curve) => (twice ? `${plainText(nameOf(curve)).replace(/[^A-Za-z0-9]+/g, "_")}_${key(curve)}` : key(curve)), unit = y.unit || "1";
  const text = (curve) => curve.x.map((v, k) => plotText(`${nameOf(curve)}: ${quantity(curve.y[k], unit, 4)}`) + (known(curve.low[k]) ? `<br>${interval({low: curve.low[k], high: curve.high[k]}, unit)}` : "")
    + [[x, v], [second_x, v], [second_y, curve.y[k]]].filter(([axis]) => axis).map(([axis, value]) => `<br>${plotText(worded(axis, value * (axis.factor ?? 1)))}`).join(""));
  const lineLook = (i) => ({color: color("ink"), width: 1, dash: LINE_DASHES[i % LINE_DASHES.length]}), rangeColor = () => faint("vermilion", 0.1);
  const entry = (name, look) => ({label: libraryText(name), x: [null], y: [null], type: "scatter", hoverinfo: "skip", ...look}), shown = (state) => ({name}) => !state.hidden.has(libraryText(name));
  const positive = (letter) => curves.every((curve) => curve[letter].every((v) => !known(v) || v > 0));
  const span = (curve) => { const there = curve.y.filter(known); return `${plainText(nameOf(curve))} from ${quantity(there[0], unit, 3)} to ${quantity(there.at(-1), unit, 3)}`; };
  return {
    axes: {x: libraryAxis(x, !positive("x")), y: libraryAxis(y, !positive("y"))},
    alt: () => `${plainText(libraryText(y.label))} over ${plainText(libraryText(x.label))}: ${curves.filter((curve) => curve.y.some(known)).map(span).join("; ")}${lines.map((line) => `; ${plainText(libraryText(line.name))} at ${quantity(line.at, (line.vertical ? x : y).unit || "1", 3)}`).join("")}.`,
    columns: () => (common ? [{label: libraryText(x.label), key: x.quantity || "x", unit: x.unit || "1", values: curves[0].x}, ...curves.flatMap((curve) => estimateColumns(nameOf(curve), keyOf(curve), unit, {mean: curve.y, low: curve.low, high: curve.high}))]
      : [{label: "curve", key: "curve", unit: "1", values: curves.flatMap((curve, i) => curve.x.map(() => i + 1))}, {label: libraryText(x.label), key: x.quantity || "x", unit: x.unit || "1", values: curves.flatMap((curve) => curve.x)}, {label: libraryText(y.label), key: y.quantity || "y", unit, values: curves.flatMap((curve) => curve.y)}]),
    plot: ({state}) => ({
      // The legend names lines and ranges: beside them, names would hide data.
      series: [...curves.flatMap((curve, i) => {
        const drawn = band(nameOf(curve), curve.x, {mean: curve.y, ...(curve.style === "points" ? {} : {low: curve.low, high: curve.high})}, style(curve, i), {text: text(curve), markers: /points/.test(curve.style)});
        if (curve.style === "points") Object.assign(drawn.at(-1), {mode: "markers", error_y: {type: "data", symmetric: false, array: curve.y.map((v, k) => (known(curve.high[k]) ? curve.high[k] - v : 0)), arrayminus: curve.y.map((v, k) => (known(curve.low[k]) ? v - curve.low[k] : 0)), color: color(style(curve, i).color), thickness: 1.5}});
        return drawn;
      }), ...lines.map(({name}, i) => entry(name, {mode: "lines", line: lineLook(i)})), ...ranges.map(({name}) => entry(name, {mode: "none", fill: "toself", fillcolor: rangeColor()}))],
      shapes: [...ranges.filter(shown(state)).map(({low, high, vertical}) => ({type: "rect", ...(vertical ? {x0: low, x1: high, y0: 0, y1: 1, yref: "paper"} : {y0: low, y1: high, x0: 0, x1: 1, xref: "paper"}), fillcolor: rangeColor(), line: {width: 0}, layer: "below"})),
        ...lines.map((line, i) => [line, i]).filter(([line]) => shown(state)(line)).map(([{at, vertical}, i]) => ({type: "line", ...(vertical ? {x0: at, x1: at, y0: 0, y1: 1, yref: "paper"} : {y0: at, y1: at, x0: 0, x1: 1, xref: "paper"}), line: lineLook(i)}))],
    }),
  };
}

/** A map of a quantity over the surface. */
function mapOf({x, y, image}) {
  const {scale} = image, values = decoded(image.values, Float32Array), seen = values.filter(Number.isFinite), at = quantiles(seen), unit = scale.unit || "1";
  const place = {x: image.x, y: image.y}, [least, most] = [scale.low ?? (at(0) < 0 ? at(0.001) : 0), scale.high ?? at(at(0) < 0 ? 0.999 : 0.99)], shown = scaleFor([least, most], unit), label = libraryText(scale.label);
  const shares = [0, 0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 1], map = {nx: image.x.length, ny: image.y.length};
  const axis = ({label: text, unit: of}, more, positions) => ({label: libraryText(text), unit: of || "1", fixed: true, values: () => positions, layout: {constrain: "domain", showgrid: false, ...more}});
  return {
    height: mapHeight(), axes: {x: axis(x, {}, place.x), y: axis(y, {scaleanchor: "x", constraintoward: "top"}, place.y)},
    alt: () => `Map of the ${plainText(label)}: from ${quantity(at(0), unit, 3)} to ${quantity(at(1), unit, 3)}, half of the values below ${quantity(at(0.5), unit, 3)}.`,
    columns: () => [{label: "share of the points below", key: "share", unit: "1", values: shares}, {label, key: scale.quantity, unit, values: shares.map((s) => Number(at(s).toPrecision(7))), digits: 3}],
    csv: () => mapColumns(map, place, scale.quantity, unit, Array.from(values, (v) => (Number.isFinite(v) ? Number(v.toPrecision(7)) : null))),
    plot: () => ({series: [{type: "heatmap", x: place.x, y: place.y, z: matrix(values, map.nx, map.ny, (v) => (Number.isFinite(v) ? v * shown.factor : null)), colorscale: PALETTES[image.palette], zmin: least * shown.factor, zmax: most * shown.factor, hoverongaps: false,
      colorbar: {title: {text: `${plotText(label)} (${shown.label})`, side: "right"}, thickness: 12, outlinewidth: 0, len: 0.95},
      hovertemplate: `<i>x</i> = %{x:.4~g}, <i>y</i> = %{y:.4~g}<br>%{z:.4~g} ${shown.label}<extra></extra>`}], layout: () => ({plot_bgcolor: color("sunken")})}),
  };
}

/** Decodes the numbers of a map from base64. */
function decoded(text, Type) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Type(bytes.buffer);
}

/** Rows of a map for plotly: z[iy][ix] from values (ix, iy) with y contiguous. */
function matrix(values, nx, ny, value) {
  return Array.from({length: ny}, (_, iy) => Array.from({length: nx}, (_unused, ix) => value(values[ix * ny + iy])));
}
