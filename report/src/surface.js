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

// The load of the cards, the profile, the contact map and the explorer: chosen by the reader, or else that of the maps in the file, or else the middle one.
let chosenLoad = null;
const onLoad = [];  // functions to call when it changes
const shownLoad = (point) => chosenLoad ?? point.picture?.mapped_load ?? Math.floor(point.pressure.length / 2);

function chooseLoad(load) {
  chosenLoad = load;
  for (const element of document.querySelectorAll("select.load")) element.value = String(load);
  for (const follow of onLoad) follow();
}

/** The normal force at each pressure. */
const forces = ({surface, pressure}) => pressure.map((p) => p * (surface ? surface.size_x * surface.size_y : NaN));

function loadChooser(point, id) {
  const force = forces(point);
  return h("label", {class: "choice", for: id}, "Load ", h("select", {id, class: "load", onchange: (event) => chooseLoad(Number(event.target.value))},
    point.pressure.map((p, i) => h("option", {value: i, selected: i === shownLoad(point)}, quantity(p, "Pa", 3) + (known(force[i]) ? `, ${quantity(force[i], "N", 3)}` : "")))));
}

/** Names the surface of the maps and the profile, if a study has several. */
const ofSurface = (point) => (point.surface?.realisations > 1 ? " of the first surface" : "");

/** Heights along the line through the middle, and the points on it that touch at the chosen load. */
function profileFigure(parent, point) {
  const picture = point.picture, place = mapAxes(picture), row = Math.floor(picture.ny / 2);
  const heights = decoded(point.figures.find(({kind}) => kind === "height-map").panels[0].image.values, Float32Array);
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
