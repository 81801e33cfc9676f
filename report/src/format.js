// SPDX-License-Identifier: GPL-3.0-or-later
// Formats numbers, units and text for the page.
"use strict";

const PREFIXES = {"-18": "a", "-15": "f", "-12": "p", "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"};
const NARROW = "\u202f";  // between a number and its unit

const known = (value) => typeof value === "number" && Number.isFinite(value);

// Units with a power of a base unit: the power to which a prefix is raised, and the unit with a prefix.
const POWERS = {"m^2": [2, (p) => `${p}m²`], "1/m^2": [-2, (p) => `1/${p}m²`], "1/m": [-1, (p) => `1/${p}m`], "rad/m": [-1, (p) => `rad/${p}m`]};
// Units that take no prefix: their numbers are written with a power of ten.
const BARE = {"m^4": "m⁴", "m^3": "m³", "1": ""};

/** Returns {factor, label}: value·factor is in units of label, and the largest of the values has one to three digits before the point. */
function scaleFor(values, unit) {
  if (unit in BARE) return {factor: 1, label: BARE[unit]};
  const [power, write] = POWERS[unit] ?? [1, (p) => p + unit];
  const largest = Math.max(...values.filter(known).map(Math.abs).filter((v) => v > 0), 0);
  if (!(largest > 0)) return {factor: 1, label: write("")};
  const steps = Math.floor((Math.log10(largest) / Math.abs(power) + 1e-12) / 3);
  const exponent = Math.min(12, Math.max(-18, 3 * steps * Math.sign(power)));
  return {factor: 10 ** (-exponent * power), label: write(PREFIXES[exponent])};
}

const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";
const raised = (integer) => (integer < 0 ? "⁻" : "") + [...String(Math.abs(integer))].map((c) => SUPERSCRIPTS[c]).join("");

/** Formats a number with this many significant digits: 0.4123, 12300, 1.2 × 10⁻⁵. `full` keeps trailing zeros, for columns. */
function number(value, digits = 4, full = false) {
  if (!known(value)) return "n/a";
  if (value === 0) return "0";
  const exponent = Math.floor(Math.log10(Math.abs(value)) + 1e-12);
  if (exponent < -3 || exponent > 5) {
    const mantissa = Number((value / 10 ** exponent).toPrecision(digits));
    return minus(`${mantissa}${NARROW}×${NARROW}10${raised(exponent)}`);
  }
  if (full) return minus(value.toFixed(Math.min(12, Math.max(0, digits - 1 - exponent))));
  return minus(String(Number(value.toPrecision(digits))));
}

const minus = (text) => text.replace(/-/g, "−");

/** Formats a number with unit and SI prefix: 14.3 nm. */
function quantity(value, unit, digits = 4) {
  if (!known(value)) return "n/a";
  const {factor, label} = scaleFor([value], unit);
  return number(value * factor, digits) + (label ? NARROW + label : "");
}

/** Formats low … high with one unit and two digits of their difference: 13.6 … 15.1 nm. Empty if there is no interval. */
function interval(estimate, unit) {
  if (!estimate || !known(estimate.low) || !known(estimate.high)) return "";
  const {factor, label} = scaleFor([estimate.low, estimate.high], unit);
  const ends = [estimate.low * factor, estimate.high * factor], width = ends[1] - ends[0];
  const digits = Math.max(0, 1 - Math.floor(Math.log10(width) + 1e-12));
  const small = Math.max(...ends.map(Math.abs)) < 1e-3 || Math.max(...ends.map(Math.abs)) >= 1e6 || !(width > 0) || digits > 9;
  return ends.map((v) => (small ? number(v, 3) : minus(v.toFixed(digits)))).join(" … ") + (label ? NARROW + label : "");
}

function percent(value, digits = 2) {
  if (!known(value)) return "n/a";
  const text = number(100 * value, Math.abs(value) >= 1 ? 3 : digits);
  return (value > 0 ? "+" : "") + text + NARROW + "%";
}

/** Formats a relative error, which has no sign. */
const errorPercent = (value) => (known(value) ? number(100 * value, 2) + NARROW + "%" : "n/a");

// Markup of the texts, translated to HTML and to plotly: ‹italic›, _{sub}, ^{sup}.
const MARKS = /‹([^›]+)›|_\{([^}]*)\}|\^\{([^}]*)\}/g;

// Symbols: meaning, unit, and the page of the documentation that defines the symbol.
const SYMBOLS = {
  p: ["nominal pressure, force over nominal area", "Pa", "docs/glossary.md"], F: ["normal force", "N", "docs/theory.md"],
  "ū": ["mean gap of the deformed surfaces", "m", "docs/conventions.md"], l: ["decay length of the force with the mean gap", "m", "docs/theory.md"],
  h: ["height; ‹h›_{rms} root mean square height, ‹h›′ root mean square slope", "m, 1", "docs/statistics.md"], A: ["contact area; ‹A›_{0} nominal area", "m²", "docs/statistics.md"],
  K: ["normal stiffness d‹F›/dδ; ‹K›_{t} tangential stiffness", "N/m", "docs/theory.md"], E: ["‹E›*, contact modulus", "Pa", "docs/theory.md"], G: ["‹G›*, tangential modulus", "Pa", "docs/theory.md"],
  u: ["‹u›_{z} normal amplitude, ‹u›_{x} tangential amplitude", "m", "docs/theory.md"], v: ["velocity of the slow tangential motion", "m/s", "docs/theory_friction.md"], X: ["excursion: distance from one turning point of the slow motion to the other", "m", "docs/theory_friction.md"], "μ": ["coefficient of friction", "1", "docs/theory_friction.md"],
  W: ["energy lost in a cycle", "J", "docs/theory.md"], "γ": ["damping constant, power over mean square velocity", "N s/m", "docs/theory.md"],
  C: ["power spectral density of the heights", "m⁴", "docs/conventions.md"], q: ["wave number, 2π over the wavelength", "rad/m", "docs/conventions.md"], H: ["Hurst exponent", "1", "docs/statistics.md"],
};

/** Converts a text with markup to nodes. Texts from a file must not pass through it; they become text nodes. linked: symbols link to the table of symbols. */
function rich(text, linked = false) {
  const nodes = [];
  let end = 0;
  for (const match of text.matchAll(MARKS)) {
    nodes.push(text.slice(end, match.index));
    const tag = match[1] !== undefined ? "i" : match[2] !== undefined ? "sub" : "sup";
    const marked = h(tag, {}, match[1] ?? match[2] ?? match[3]);
    const known = linked && tag === "i" && match[1] in SYMBOLS;
    nodes.push(known ? h("a", {class: "symbol", href: `#symbol-${match[1]}`, title: plainText(SYMBOLS[match[1]][0])}, marked) : marked);
    end = match.index + match[0].length;
  }
  nodes.push(text.slice(end));
  return nodes;
}

/** Shows names in backquotes, such as `hardness`, as code. */
const coded = (text) => text.split("`").map((part, i) => (i % 2 ? h("code", {}, part) : part));

/** Escapes a text from a file for plotly, which interprets some HTML. */
const escaped = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");

const plotText = (text) => escaped(text).replace(MARKS, (_, italic, sub, sup) =>
  italic !== undefined ? `<i>${italic}</i>` : sub !== undefined ? `<sub>${sub}</sub>` : `<sup>${sup}</sup>`);

/** Removes the markup, for screen readers and files. */
const plainText = (text) => text.replace(MARKS, (_, italic, sub, sup) => italic ?? sub ?? sup);

/** Creates an element; children are nodes or text, lists of them, or null. */
function h(tag, properties, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties ?? {})) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  for (const child of children.flat(Infinity)) if (child !== null && child !== undefined) element.append(child);
  return element;
}

/** A table of columns [{label, unit, values}]; each column of numbers gets a suitable SI prefix. */
function table(caption, columns, rowLabel) {
  const scales = columns.map((c) => c.unit === undefined ? null : scaleFor(c.values, c.unit));
  const heads = columns.map((c, i) => h("th", {scope: "col"}, rich(c.label), scales[i]?.label ? ` (${scales[i].label})` : ""));
  const rows = columns[0].values.map((_, r) => h("tr", {}, columns.map((c, i) => {
    const value = c.values[r];
    const text = scales[i] ? (known(value) ? number(value * scales[i].factor, c.digits ?? 4, c.digits !== 0) : "–") : String(value ?? "–");
    return h(i === 0 && rowLabel ? "th" : "td", i === 0 && rowLabel ? {scope: "row"} : {class: scales[i] ? "number" : null}, text);
  })));
  return h("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": plainText(caption)},
    h("table", {}, h("caption", {}, rich(caption)), h("thead", {}, h("tr", {}, heads)), h("tbody", {}, rows)));
}

/** CSV text by RFC 4180: headers key_unit, then numbers in SI units with a decimal point; unknown values are empty. */
function csv(columns) {
  const cell = (value) => value === null || value === undefined || Number.isNaN(value) ? ""
    : typeof value === "number" ? String(value) : /[",\r\n]/.test(value) ? `"${value.replace(/"/g, '""')}"` : value;
  const name = (c) => c.key + (c.unit === undefined || c.unit === "1" ? "" : "_" + c.unit.replace(/\^/g, "").replace(/\//g, "_per_").replace(/^1_/, "").replace(/ /g, ""));
  const lines = [columns.map((c) => cell(name(c))).join(",")];
  for (let r = 0; r < columns[0].values.length; ++r) lines.push(columns.map((c) => cell(c.values[r])).join(","));
  return lines.join("\r\n") + "\r\n";
}

function download(name, type, text) {
  const address = URL.createObjectURL(new Blob([text], {type}));
  const link = h("a", {href: address, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}
