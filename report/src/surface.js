// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of the surface and of its contact.
"use strict";

const MAP_NOTE = (picture) => picture.stride > 1 ? ` Every ${number(picture.stride)}th point along either axis is shown.` : "";

/** Axes of a map: position along x and y, with equal scales. */
function mapAxes(picture) {
  const x = Array.from({length: picture.nx}, (_, i) => i * picture.step_x);
  const y = Array.from({length: picture.ny}, (_, i) => i * picture.step_y);
  return {x, y, axes: {
    x: {label: "‹x›", unit: "m", fixed: true, values: () => x, layout: {constrain: "domain", showgrid: false}},
    y: {label: "‹y›", unit: "m", fixed: true, values: () => y, layout: {scaleanchor: "x", constrain: "domain", constraintoward: "top", showgrid: false}}}};
}

const mapHeight = () => Math.round(Math.min(460, document.getElementById("main").clientWidth - 40));

function mapColumns(picture, {x, y}, key, unit, values) {
  const columns = [{key: "x", unit: "m", values: []}, {key: "y", unit: "m", values: []}, {key, unit, values: []}];
  for (let ix = 0; ix < picture.nx; ++ix)
    for (let iy = 0; iy < picture.ny; ++iy) {
      columns[0].values.push(Number(x[ix].toPrecision(7)));
      columns[1].values.push(Number(y[iy].toPrecision(7)));
      columns[2].values.push(values[ix * picture.ny + iy]);
    }
  return columns;
}

function quantiles(values) {
  const sorted = Float32Array.from(values).sort();
  return (share) => sorted[Math.min(sorted.length - 1, Math.round(share * (sorted.length - 1)))];
}

function heightMap(parent, point) {
  const picture = point.picture, place = mapAxes(picture);
  const heights = decoded(picture.heights, Float32Array);
  const at = quantiles(heights), shares = [0, 0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 1];
  const scale = scaleFor([at(0), at(1)], "m");
  const z = matrix(heights, picture.nx, picture.ny, (v) => v * scale.factor);
  const which = point.surface?.realisations > 1 ? "the first surface" : "the surface";
  addFigure(parent, {
    id: "height-map", title: "Heights", axes: place.axes, height: mapHeight(),
    alt: () => `Map of the heights of ${which}, ${quantity(point.surface?.size_x, "m")} by ${quantity(point.surface?.size_y, "m")}: from ${quantity(at(0), "m", 3)} to ${quantity(at(1), "m", 3)} about the mean, half of the points between ${quantity(at(0.25), "m", 3)} and ${quantity(at(0.75), "m", 3)}.`,
    caption: `Height of ${which} above its mean; hills are bright. One point in a thousand is above the colour scale, up to ${quantity(at(1), "m", 3)}, and one in a thousand below it, down to ${quantity(at(0), "m", 3)}.${MAP_NOTE(picture)}`,
    columns: () => [{label: "share of the points below", key: "share", unit: "1", values: shares}, {label: "height", key: "height", unit: "m", values: shares.map((s) => Number(at(s).toPrecision(7))), digits: 3}],
    csv: () => mapColumns(picture, place, "height", "m", Array.from(heights, (v) => Number(v.toPrecision(7)))),
    plot: () => ({series: [{type: "heatmap", x: place.x, y: place.y, z, colorscale: "Viridis", zmin: at(0.001) * scale.factor, zmax: at(0.999) * scale.factor,
      colorbar: {title: {text: `height (${scale.label})`, side: "right"}, thickness: 12, outlinewidth: 0, len: 0.95},
      hovertemplate: `<i>x</i> = %{x:.4~g}, <i>y</i> = %{y:.4~g}<br>height %{z:.4~g} ${scale.label}<extra></extra>`}]}),
  });
}

function spectrumFigure(parent, point) {
  const picture = point.picture;
  const hurst = known(picture.hurst)
    ? `A power law fitted to this spectrum has ‹H› = ${number(picture.hurst, 3)} (95 %: ${number(picture.hurst_low, 3)} … ${number(picture.hurst_high, 3)}).`
    : "The spectrum shows no self-affine range.";
  const law = picture.law === "asked for" ? "requested law" : "fitted power law, ‹C› ∝ ‹q›^{−2(1+H)}";
  addFigure(parent, {
    id: "spectrum", title: "Power spectral density",
    alt: () => `Power spectral density against wave number, both logarithmic, from ${number(Math.min(...picture.wavenumber), 3)} to ${number(Math.max(...picture.wavenumber), 3)} rad/m. ${plainText(hurst)}`,
    caption: `‹C›(‹q›), averaged over rings of wave vectors; its integral over the plane of wave vectors is ‹h›_{rms}². ${hurst} Wavelengths are 2π/‹q›.`,
    axes: {x: {label: "wave number ‹q›", short: "‹q›", unit: "rad/m", log: true}, y: {label: "‹C›", unit: "m^4", log: true}},
    columns: () => [{label: "wave number", key: "wavenumber", unit: "rad/m", values: picture.wavenumber}, {label: "‹C›", key: "psd", unit: "m^4", values: picture.psd},
      {label: picture.law === "asked for" ? "requested ‹C›" : "‹C› of the fit", key: "law_density", unit: "m^4", values: picture.law_psd}],
    plot: () => {
      // Beyond the shortest wave the spectrum is only round-off.
      const seen = picture.psd.map((_, i) => i).filter((i) => picture.psd[i] > Math.max(...picture.psd) * 1e-13);
      return {series: [
        {label: "this surface", x: seen.map((i) => picture.wavenumber[i]), y: seen.map((i) => picture.psd[i]), mode: "lines+markers", line: {color: color("blue"), width: 1.5}, marker: {size: 5, color: color("blue")},
          text: seen.map((i) => `<i>q</i> = ${number(picture.wavenumber[i], 3)} rad/m, wavelength ${quantity(2 * Math.PI / picture.wavenumber[i], "m", 3)}<br><i>C</i> = ${number(picture.psd[i], 3)} m⁴`)},
        ...(picture.law ? [{label: law, x: picture.wavenumber.filter((_, i) => known(picture.law_psd[i])), y: picture.law_psd.filter(known), mode: "lines", line: {color: color("vermilion"), width: 2, dash: "dash"}, hoverinfo: "skip"}] : [])]};
    },
  });
}

function distributionFigure(parent, point) {
  const picture = point.picture;
  if (!picture.height?.length) return;
  const width = picture.height.length > 1 ? picture.height[1] - picture.height[0] : 1;
  const moment = (n) => picture.height.reduce((sum, z, i) => sum + z ** n * picture.height_density[i] * width, 0);
  const rms = Math.sqrt(moment(2));
  const gauss = picture.height.map((z) => Math.exp(-((z / rms) ** 2) / 2) / (rms * Math.sqrt(2 * Math.PI)));
  addFigure(parent, {
    id: "distribution", title: "Distribution of heights",
    alt: () => `Histogram of the heights, compared with a Gaussian of the same rms height, ${quantity(rms, "m", 3)}.`,
    caption: "Density of the points over their height, compared with a Gaussian of the same rms height. Only the highest points make contact, so the right end matters most; a logarithmic axis shows it best.",
    axes: {x: {label: "height above the mean", unit: "m", fixed: true}, y: {label: "density", unit: "1/m", log: false}},
    columns: () => [{label: "height", key: "height", unit: "m", values: picture.height}, {label: "density", key: "density", unit: "1/m", values: picture.height_density}, {label: "Gaussian", key: "gaussian", unit: "1/m", values: gauss}],
    plot: ({state}) => ({series: [
      {label: "this surface", x: picture.height, y: picture.height_density, mode: "lines", line: {color: color("blue"), width: 2, shape: "hvh"},
        text: picture.height.map((z, i) => `height ${quantity(z, "m", 3)} = ${number(z / rms, 3)} <i>h</i><sub>rms</sub><br>${number(100 * picture.height_density[i] * width, 3)} % of the points in this bin`)},
      {label: "Gaussian", x: picture.height, y: gauss, mode: "lines", line: {color: color("vermilion"), width: 2, dash: "dash"}, hoverinfo: "skip"}],
    axes: state.y === "log" ? {yaxis: {range: undefined}} : {yaxis: {rangemode: "tozero"}}}),
  });
}

// The load of the cards, the profile, the contact map and the explorer: chosen by the reader, or else that of the maps in the file, or else the middle one.
let chosenLoad = null;
const onLoad = [];  // functions to call when it changes
const shownLoad = (point) => chosenLoad ?? point.picture?.mapped_load ?? Math.floor(point.pressure.length / 2);

function chooseLoad(load) {
  chosenLoad = load;
  for (const element of document.querySelectorAll("select.load")) element.value = String(load);
  for (const follow of onLoad) follow();
}

function loadChooser(point, id) {
  const area = facts(point).area;
  return h("label", {class: "choice", for: id}, "Load ", h("select", {id, class: "load", onchange: (event) => chooseLoad(Number(event.target.value))},
    point.pressure.map((p, i) => h("option", {value: i, selected: i === shownLoad(point)}, quantity(p, "Pa", 3) + (known(area) ? `, ${quantity(p * area, "N", 3)}` : "")))));
}

/** Names the surface of the maps and the profile, if a study has several. */
const ofSurface = (point) => (point.surface?.realisations > 1 ? " of the first surface" : "");

/** Heights along the line through the middle, and the points on it that touch at the chosen load. */
function profileFigure(parent, point) {
  const picture = point.picture, place = mapAxes(picture), row = Math.floor(picture.ny / 2);
  const heights = decoded(picture.heights, Float32Array);
  const line = place.x.map((_, ix) => Number(heights[ix * picture.ny + row].toPrecision(7)));
  const loads = picture.first_load ? decoded(picture.first_load, Int16Array) : null;
  const low = Math.min(...line), high = Math.max(...line);
  const touches = (first) => first >= 0 && first <= shownLoad(point);
  const touching = () => line.map((z, ix) => (loads && touches(loads[ix * picture.ny + row]) ? z : null));
  const pressed = () => quantity(point.pressure[shownLoad(point)], "Pa", 3);
  const figure = addFigure(parent, {
    id: "profile", title: "Profile",
    alt: () => `Heights along x at y = ${quantity(place.y[row], "m", 3)}: from ${quantity(low, "m", 3)} to ${quantity(high, "m", 3)} about the mean; ${touching().filter(known).length} of ${line.length} points touch at ${pressed()}.`,
    caption: () => `Heights${ofSurface(point)} along the line ‹y› = ${quantity(place.y[row], "m", 3)} through the middle, stretched: one unit of height is drawn as long as ${number(((place.x.at(-1) - place.x[0]) / 2) / (high - low), 2)} units of length. Marked points touch at ${pressed()}.`,
    axes: {x: {label: "‹x›", unit: "m", fixed: true}, y: {label: "height above the mean", unit: "m", fixed: true}},
    columns: () => [{label: "‹x›", key: "x", unit: "m", values: place.x.map((v) => Number(v.toPrecision(7)))}, {label: "height", key: "height", unit: "m", values: line}],
    plot: () => ({series: [{label: "surface", x: place.x, y: line, mode: "lines", line: {color: color("blue"), width: 1.5}, text: line.map((z, i) => `height ${quantity(z, "m", 3)}<br>at <i>x</i> = ${quantity(place.x[i], "m", 3)}`)},
      ...(touching().some(known) ? [{label: `in contact at ${pressed()}`, x: place.x, y: touching(), mode: "markers", marker: {symbol: "circle", size: 5, color: color("vermilion")}, hoverinfo: "skip"}] : [])]}),
  });
  onLoad.push(figure.redraw);
}

/** The points that touch at each load. A contact at a higher load contains those at lower loads, so one map of first touches holds all loads. */
function contactMap(parent, point) {
  const picture = point.picture, place = mapAxes(picture), pressures = point.pressure;
  const loads = decoded(picture.first_load, Int16Array);
  const counts = new Array(pressures.length).fill(0);
  for (const load of loads) if (load >= 0 && load < counts.length) ++counts[load];
  const shares = counts.map((_, k) => counts.slice(0, k + 1).reduce((a, b) => a + b, 0) / loads.length);
  const words = () => `${quantity(pressures[shownLoad(point)], "Pa", 3)}: ${number(100 * shares[shownLoad(point)], 3)}${NARROW}% in contact`;
  const output = h("output", {for: "contact-load"}, words());
  const slider = h("input", {type: "range", id: "contact-load", min: 0, max: pressures.length - 1, step: 1, value: shownLoad(point), "aria-valuetext": words(),
    oninput: (event) => {
      cancelAnimationFrame(slider.pending);
      slider.pending = requestAnimationFrame(() => chooseLoad(Number(event.target.value)));
    }});
  onLoad.push(() => {
    slider.value = shownLoad(point);
    output.textContent = words();
    slider.setAttribute("aria-valuetext", words());
    figure.redraw();
  });
  const scale = scaleFor([pressures[Math.floor(pressures.length / 2)]], "Pa");
  const names = pressures.map((p) => quantity(p, "Pa", 3));
  const firstTouch = matrix(loads, picture.nx, picture.ny, (load) => (load >= 0 ? names[load] : ""));
  const tick = (k) => number(pressures[k] * scale.factor, 2);
  const figure = addFigure(parent, {
    id: "contact-map", title: "Contact map", axes: place.axes, height: mapHeight(),
    controls: h("label", {class: "slider", for: "contact-load"}, "Pressure ", slider, " ", output),
    alt: () => `Map of the points in contact. At ${words()}; at ${quantity(pressures[0], "Pa", 3)} it is ${number(100 * shares[0], 3)} %, at ${quantity(pressures.at(-1), "Pa", 3)} ${number(100 * shares.at(-1), 3)} %.`,
    caption: `Points${ofSurface(point)} in contact at the chosen pressure, by boundary elements; the colour shows the pressure of first touch. A contact at a higher pressure contains those at lower pressures; the damping without slip relies on this.${MAP_NOTE(picture)}`,
    columns: () => [{label: "pressure", key: "pressure", unit: "Pa", values: pressures}, {label: "share of the points in contact", key: "share", unit: "1", values: shares}],
    csv: () => mapColumns(picture, place, "first_pressure", "Pa", Array.from(loads, (load) => (load < 0 ? null : pressures[load]))),
    plot: () => {
      const ticks = [0, 0.25, 0.5, 0.75, 1].map((share) => Math.round(share * (pressures.length - 1)));
      return {series: [{type: "heatmap", x: place.x, y: place.y, z: matrix(loads, picture.nx, picture.ny, (load) => (load >= 0 && load <= shownLoad(point) ? load : null)),
        zmin: 0, zmax: pressures.length - 1, colorscale: dark.matches && !printing.matches ? [[0, "#ffe08a"], [0.5, "#e8743b"], [1, "#5a2a83"]] : [[0, "#2a0a4a"], [0.5, "#c4473a"], [1, "#f6c667"]], hoverongaps: false,
        customdata: firstTouch,
        colorbar: {title: {text: `first touch at (${scale.label})`, side: "right"}, tickvals: ticks, ticktext: ticks.map(tick), thickness: 12, outlinewidth: 0, len: 0.95},
        hovertemplate: "<i>x</i> = %{x:.4~g}, <i>y</i> = %{y:.4~g}<br>touches from %{customdata} on<extra></extra>"}],
      layout: () => ({plot_bgcolor: color("sunken")})};
    },
  });
}

/** A map of "contact_pressure" or "gap" at the load that the file stores; blank where the value is 0. */
function stateMap(parent, point, {key, id, title, unit, clip, colorscale, blank, caption}) {
  const picture = point.picture, place = mapAxes(picture), step = picture[`max_${key}`] / 32767;
  const values = Array.from(decoded(picture[key], Int16Array), (v) => (key === "gap" || v > 0 ? v * step : null));
  const seen = values.filter(known), at = quantiles(seen), shares = [0, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99, 1];
  const scale = scaleFor([0, at(clip)], unit), load = quantity(point.pressure[picture.mapped_load], "Pa", 3);
  addFigure(parent, {
    id, title: `${title} at ${load}`, axes: place.axes, height: mapHeight(),
    alt: () => `Map of the ${title.toLowerCase()} at ${load}: half of the values are below ${quantity(at(0.5), unit, 3)}, the largest is ${quantity(at(1), unit, 3)}.`,
    caption: `${caption(load)}${MAP_NOTE(picture)}`,
    columns: () => [{label: "share of the points below", key: "share", unit: "1", values: shares}, {label: title.toLowerCase(), key, unit, values: shares.map((s) => Number(at(s).toPrecision(4))), digits: 3}],
    csv: () => mapColumns(picture, place, key, unit, values.map((v) => (v === null ? null : Number(v.toPrecision(4))))),
    plot: () => ({series: [{type: "heatmap", x: place.x, y: place.y, z: matrix(values, picture.nx, picture.ny, (v) => (v > 0 ? v * scale.factor : null)), colorscale,
      zmin: 0, zmax: at(clip) * scale.factor, hoverongaps: false,
      colorbar: {title: {text: `${title.toLowerCase()} (${scale.label})`, side: "right"}, thickness: 12, outlinewidth: 0, len: 0.95},
      hovertemplate: `<i>x</i> = %{x:.4~g}, <i>y</i> = %{y:.4~g}<br>%{z:.4~g} ${scale.label}<extra></extra>`}],
    layout: () => ({plot_bgcolor: blank ?? color("sunken")})}),
  });
}

function pressureMap(parent, point) {
  stateMap(parent, point, {key: "contact_pressure", id: "pressure-map", title: "Contact pressure", unit: "Pa", clip: 0.99, colorscale: "Viridis",
    caption: (load) => `Contact pressure${ofSurface(point)} at the nominal pressure ${load}, the only load stored in the file, by boundary elements; points without contact are blank. The highest pressures depend on the size of the cells.`});
}

function gapMap(parent, point) {
  stateMap(parent, point, {key: "gap", id: "gap-map", title: "Gap", unit: "m", clip: 0.99, colorscale: [[0, "#08306b"], [0.5, "#4292c6"], [1, "#f2f8ff"]], blank: "#8d8579",
    caption: (load) => `Gap${ofSurface(point)} after deformation at the nominal pressure ${load}, the only load stored in the file, by boundary elements. Points in contact are grey; dark blue is a narrow gap, light blue a wide one.`});
}

/** Number and size of the contact spots. */
function spotsFigure(parent, point) {
  const spots = point.spots ?? {}, count = spots.spot_count;
  if (!count?.mean.some(known)) return;
  const sizes = [["mean_spot_area", "mean", {color: "green", symbol: "diamond", dash: "solid"}], ["max_spot_area", "largest", {color: "vermilion", symbol: "square", dash: "solid"}]].filter(([key]) => spots[key]?.mean.some(known));
  const last = point.pressure.length - 1;
  addFigure(parent, {
    id: "spots", title: "Contact spots", height: mapHeight(),
    alt: () => `Number of contact spots and their areas against pressure: ${number(count.mean[0], 3)} spots at ${quantity(point.pressure[0], "Pa", 3)}, at most ${number(Math.max(...count.mean.filter(known)), 3)}, ${number(count.mean[last], 3)} at ${quantity(point.pressure[last], "Pa", 3)}.`,
    caption: "Contact spots by boundary elements; a spot consists of neighbouring points in contact. The upper panel shows the number of spots, the lower panel their areas. Statistical laws need many spots.",
    axes: {x: {label: "pressure ‹p›", short: "‹p›", unit: "Pa", log: true}, y: {label: "spots", unit: "1", log: true, layout: {domain: [0.55, 1]}}, y2: {label: "area", unit: "m^2", log: true, layout: {domain: [0, 0.45]}}},
    columns: () => [{label: "pressure", key: "pressure", unit: "Pa", values: point.pressure}, ...estimateColumns("spots", "spot_count", "1", count), ...sizes.flatMap(([key, label]) => estimateColumns(`${label} area`, key, "m^2", spots[key]))],
    plot: () => ({axes: {xaxis: {anchor: "y2"}}, series: [
      ...band("number of spots", point.pressure, count, {color: "blue", symbol: "circle", dash: "solid"}, {text: count.mean.map((n, i) => `${number(n, 3)} spots at ${quantity(point.pressure[i], "Pa", 3)}`)}),
      ...sizes.flatMap(([key, label, style]) => band(`${label} area of a spot`, point.pressure, spots[key], style, {both: {yaxis: "y2"}, text: spots[key].mean.map((a, i) => `${label} area of a spot ${quantity(a, "m^2", 3)}<br>at ${quantity(point.pressure[i], "Pa", 3)}`)}))]}),
  });
}
