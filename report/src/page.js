// SPDX-License-Identifier: GPL-3.0-or-later
// The page: first the results, then the sections on which they are based.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);

/** Creates a section with its heading; build() fills it. */
function section(parent, id, title, intro, build) {
  const body = h("div", {class: "figures"});
  const element = h("section", {id, "aria-labelledby": `${id}-heading`}, h("h2", {id: `${id}-heading`}, title), intro ? h("p", {class: "intro"}, rich(intro)) : null, body);
  parent.append(element);
  build(body, element);
  return element;
}

const isDrag = (point) => point.damping?.mode === "drag";
const converged = (point) => point.figures?.some(({kind}) => kind === "convergence");
const absent = (what) => h("p", {class: "absent"}, `This results file does not contain ${what}; a study by a newer salebra does.`);

const finding = (title, value, details, doubt) => h("div", {class: doubt ? "finding doubt" : "finding"}, h("h3", {}, rich(title)), h("p", {class: "value"}, rich(value)), details.filter(Boolean).map((line) => h("p", {class: "detail"}, rich(line))));

/** Verdict, regime, force law, and the damping constant at the chosen load. */
function cards(point) {
  const fit = point.fit?.models?.bem, doubt = point.validity && point.validity !== "valid", found = [];
  if (point.validity) found.push(finding("Validity", point.validity, ["assumptions below, worst first"], doubt));
  const {max_force: most, contact_time: closed} = point.damping ?? {}, at = shownLoad(point);
  if (point.solution?.regime) found.push(finding("Regime", point.solution.regime[shownLoad(point)], ["at the chosen load", known(most?.[at]) && `largest force ${quantity(most[at], "N", 3)}`, known(closed?.[at]) && closed[at] < 1 && `in contact during ${number(100 * closed[at], 3)}${NARROW}% of the cycle`], point.solution.regime[shownLoad(point)] === "sliding"));
  if (known(fit?.decay_length?.mean)) {
    const ratio = fit.decay_length_over_rms_height, limits = [interval(fit.decay_length, "m"), interval(ratio, "1")];
    found.push(finding(fit.fair === 0 ? "Force law ‹F› ∝ exp(−‹ū›/‹l›), a poor description" : "Force law ‹F› ∝ exp(−‹ū›/‹l›)", `‹l› = ${quantity(fit.decay_length.mean, "m", 3)}`,
      [limits[0] && `95 %: ${limits[0]}`, known(ratio?.mean) && `${number(ratio.mean, 3)} ‹h›_{rms}${limits[1] && `; 95 %: ${limits[1]}`}`], fit.fair === 0));
  } else {
    found.push(absent("a fitted force law"));
  }
  const adhesion = point.adhesion, pull = adhesion?.pull_off_pressure, work = adhesion?.adhesion_work_per_cycle;
  if (pull) found.push(finding("Pull-off", quantity(pull.mean, "Pa", 3), [interval(pull, "Pa") && `95 %: ${interval(pull, "Pa")}`, known(adhesion.pull_off_error?.mean) && `up to ${quantity(adhesion.pull_off_error.mean, "Pa", 2)} more (error of its steps)`, known(work?.mean) && `a cycle loses ${quantity(work.mean, "J", 3)} ± ${quantity(adhesion.adhesion_work_error?.mean, "J", 2)} (error of its steps)`]));
  for (const one of [point, ...(point.other_directions ?? [])]) if (one.damping) found.push(dampingCard(point, one));
  return found;
}

/** The damping constant at the chosen load. one: the point, or what it has of a motion in another direction. */
function dampingCard(point, one) {
  const {damping, solution} = one, doubt = one.validity && one.validity !== "valid";
  const i = shownLoad(point), curve = damping.curve?.damping_constant?.bem, law = damping.law?.damping_constant?.bem, slip = one.slip_followed === "yes";
  const shown = slip ? solution.damping_constant : curve ?? law, value = shown?.mean[i], error = shown?.error?.[i] / Math.abs(value);
  const limits = interval({low: shown?.low?.[i], high: shown?.high?.[i]}, "N s/m");
  const lawName = isDrag(one) ? "Eq. (16)" : "Eq. (12)";
  return finding((slip ? "Damping constant" : "Damping constant without slip") + (point.other_directions ? `, motion ${damping.direction_in_words}` : ""), known(value) ? quantity(value, "N s/m", error > 0.1 ? 2 : 3) : "n/a",
    [slip && known(solution.slip_share[i]) ? `${number(100 * solution.slip_share[i], 2)}${NARROW}% of the loss by slip` : "", limits && `95 %: ${limits}`, known(error) ? `numerical error ${errorPercent(error)}` : "",
      `at ‹F› = ${quantity(damping.force[i], "N", 3)}, ‹p› = ${quantity(point.pressure[i], "Pa", 3)}`,
      known(curve?.mean[i]) && known(law?.mean[i]) ? `${lawName} gives ${quantity(law.mean[i], "N s/m", 3)}, ${percent(law.mean[i] / curve.mean[i] - 1)}${slip ? ` against ${quantity(curve.mean[i], "N s/m", 3)} without slip` : ""}` : ""], doubt);
}

/** States whether F ∝ exp(−ū/l) holds. */
function lawVerdict(point) {
  const fit = point.fit?.models?.bem, bend = fit?.law_bend;
  const closest = fit?.decay_length_at_min_gap_over_rms_height?.mean, farthest = fit?.decay_length_at_max_gap_over_rms_height?.mean;
  if (!known(fit?.fair)) return null;
  // If the parabola of the fit has its turning point in the window, the deviation is infinite; the file stores null.
  const [offClosest, offFarthest] =
      [fit.law_off_at_min_gap, fit.law_off_at_max_gap].map((off) => off ?? Infinity);
  const run = `Over the fitted window the local ‹l› varies from ${number(closest, 2)} (smallest gap) to ${number(farthest, 2)} ‹h›_{rms} (largest gap)`;
  const size = bend ? `, a change of ${percent(bend.mean)}` + (known(bend.low) ? ` (95 %: ${percent(bend.low)} … ${percent(bend.high)})` : "") : "";
  const ends = `At the ends of the window ‹F›/‹l›² deviates from ‹F›″ by ${percent(offClosest)} (smallest gap) and ${
      percent(offFarthest)} (largest gap).`;
  return {
    poor: !fit.fair,
    text: `${run}${size}. ${ends}` + (fit.fair ? '' : ' Do not use Eq. (16) here.')
  };
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

function conclusion(main, point) {
  section(main, "conclusion", "Results", null, (body, element) => {
    body.className = "findings";
    const fill = () => body.replaceChildren(...cards(point));
    onLoad.push(fill);
    fill();
    const verdict = lawVerdict(point);
    if (verdict) element.append(h("p", {class: "verdict"}, h("strong", {}, verdict.poor ? "The law is a poor description. " : "The law is a fair description. "), rich(verdict.text)));
    for (const {verdicts, damping} of [point, ...(point.other_directions ?? [])].filter((one) => one.verdicts)) {
      const heading = `Assumptions of the damping constant${point.other_directions ? `, motion ${damping.direction_in_words}` : ""}`;
      element.append(h("p", {class: "verdict"}, h("strong", {}, `${heading}. `)));
      element.append(h("pre", {class: "verdicts", tabindex: "0", role: "region", "aria-label": heading}, verdicts.replaceAll("`", "")));
    }
    if (point.motion) element.append(h("p", {class: "verdict"}, rich(libraryText(point.motion)), (point.other_directions ?? []).map(({damping}) => ` Also computed ${damping.direction_in_words}.`)));
    element.append(h("p", {class: "verdict"}, h("strong", {}, "Intervals. "), `${point.fit?.interval_method ?? "95 %"}.`));
    const warnings = warningsOf(point);
    element.append(h("div", {class: "warnings", role: "region", "aria-label": "Warnings"},
      h("h3", {}, warnings.length ? "Warnings" : "No warnings"), warnings.length ? h("ul", {}, warnings.map((text) => h("li", {}, coded(text)))) : h("p", {}, "The study gave no warnings.")));
  });
}

function warningsOf(point) {
  const lines = (text) => (text ?? "").split("\n").filter((line) => line.trim());
  const capital = (text) => text[0].toUpperCase() + text.slice(1) + (text.endsWith(".") ? "" : ".");
  const flags = lines(point.surface?.ensemble_warnings).map((line) => capital(line.replace(/^[a-z_]+: /, "")));
  const warnings = [...lines(point.surface?.warnings).map(capital), ...flags];
  const computed = point.damping?.curve?.damping_constant?.bem;
  const unstated = (computed?.error ?? []).filter((error, i) => known(error) && !known(computed.mean[i])).length;
  if (unstated)
    warnings.push(`No damping constant at ${unstated} of ${point.pressure.length} pressures: the error is larger than the number, because too few cells open and close in the oscillation; a finer grid or \`relative_error\` may help.`);
  const least = point.damping?.deviation_min, greatest = point.damping?.deviation_max;
  const law = isDrag(point) ? "Eq. (16)" : "Eq. (12)";
  if (Math.max(Math.abs(least), Math.abs(greatest)) > 0.1)
    warnings.push(`${law} with the fitted decay length deviates from the computed damping constant by ${percent(least)} to ${percent(greatest)}.`);
  return warnings;
}

const STATISTICS = {rms_height: "rms height ‹h›_{rms}", rms_slope: "rms slope ‹h›′", skewness: "skewness", kurtosis: "kurtosis (Gaussian: 3)", nayak: "Nayak’s α = ‹m›_{0}‹m›_{4}/‹m›_{2}^{2}",
  moment0: "spectral moment ‹m›_{0}", moment2: "profile moment ‹m›_{2}", moment4: "profile moment ‹m›_{4}", summit_density: "summits per area", mean_radius: "mean radius of summits", summit_rms: "rms of summit heights"};

function surfaceTable(point) {
  const statistics = point.surface?.statistics;
  if (!statistics) return absent("statistics of its surfaces");
  const many = statistics.some((s) => known(s.low));
  return h("div", {class: "scroll card", tabindex: "0", role: "region", "aria-label": "Statistics of the surfaces"}, h("table", {},
    h("caption", {}, many ? "Statistics, means over the surfaces" : "Statistics of the surface"),
    h("thead", {}, h("tr", {}, h("th", {scope: "col"}, "quantity"), h("th", {scope: "col"}, "value"), many ? h("th", {scope: "col"}, "95 % interval") : null)),
    h("tbody", {}, statistics.map((s) => h("tr", {}, h("th", {scope: "row"}, rich(STATISTICS[s.name] ?? s.title)), h("td", {class: "number"}, quantity(s.mean, s.unit)), many ? h("td", {class: "number"}, interval(s, s.unit) || "–") : null)))));
}

/** The time between the two times in the file, which are in whole seconds. */
function runTime({started, created}) {
  const seconds = (Date.parse(created) - Date.parse(started)) / 1000;
  if (!(seconds >= 0)) return null;
  const parts = [[Math.floor(seconds / 3600), "h"], [Math.floor(seconds / 60) % 60, "min"], [seconds % 60, "s"]].filter(([count]) => count > 0);
  return parts.map(([count, unit]) => `${count}${NARROW}${unit}`).join(" ") || `less than 1${NARROW}s`;
}

function settings(main, point) {
  section(main, "settings", "Settings and provenance", null, (body) => {
    body.className = "";
    const provenance = data.provenance ?? {}, surface = point.surface ?? {};
    const seeds = (surface.seed ?? []).filter((s) => s !== 0);
    const entries = [["Results file", data.results], ["Command", provenance.command_line, "code"], ["Created", provenance.created?.replace("T", " ").replace("Z", " UTC")], ["Run time of the command", runTime(provenance)],
      ["Program", provenance.version ? `${provenance.program ?? "salebra"} ${provenance.version}${provenance.revision ? `, revision ${provenance.revision}` : ""}; report by salebra ${data.report_version}` : null],
      ["Libraries", provenance.libraries], ["Surface", point.picture?.origin?.replace(/(rolloff|short_cutoff|rms_height)=([-+.\de]+)/g, (_, name, value) => `${name} = ${quantity(Number(value), "m")},`).replace(/,$/, "")], ["Seeds", seeds.length ? seedText(seeds) : null], ["Tangential stiffness", point.damping?.tangential_stiffness], ["E*, G*/E*", point.damping ? `${quantity(point.damping.contact_modulus, "Pa")}, ${number(point.damping.modulus_ratio)}` : null]];
    body.append(h("dl", {}, entries.filter(([, text]) => text).map(([name, text, tag]) => h("div", {}, h("dt", {}, name), h("dd", {}, tag ? h(tag, {}, text) : text)))));
    if (provenance.configuration?.trim()) body.append(h("details", {}, h("summary", {}, "Configuration as read"), h("pre", {tabindex: "0", role: "region", "aria-label": "Configuration"}, provenance.configuration)));
  });
}

/** The table of symbols, the equations, and how to cite. */
function symbolsAndCitation(main) {
  section(main, "symbols", "Symbols and citation", null, (body) => {
    body.className = "";
    body.append(h("div", {class: "scroll card", tabindex: "0", role: "region", "aria-label": "Symbols"}, h("table", {}, h("caption", {}, "Symbols, and the pages of salebra's documentation that define them"),
      h("thead", {}, h("tr", {}, ["symbol", "meaning", "unit", "page"].map((text) => h("th", {scope: "col"}, text)))),
      h("tbody", {}, Object.entries(SYMBOLS).map(([letter, [meaning, unit, page]]) => h("tr", {id: `symbol-${letter}`}, h("th", {scope: "row"}, h("i", {}, letter)), h("td", {}, rich(meaning)), h("td", {}, unit), h("td", {}, h("code", {}, page))))))));
    const slow = "(‹G›*/‹E›*) ‹F›″ ‹u›_{z}";
    body.append(h("ul", {class: "equations"}, [`Eq. (12), equal frequencies: ‹W› = (8/3) ${slow} ‹u›_{x}^{2} sin^{2}‹φ›_{0}`, `Eq. (15), slow tangential motion: ‹W› = 2(π^{2} − 4) ${slow} (‹v›/‹ω›)^{2}`, "Eq. (16): Eq. (15) with ‹F›″ = ‹F›/‹l›^{2}"].map((text) => h("li", {}, rich(text)))));
    const version = data.provenance?.version ?? data.report_version;
    body.append(h("details", {}, h("summary", {}, "How to cite"), h("pre", {tabindex: "0", role: "region", "aria-label": "Citation in BibTeX"},
      `@article{popov2015relaxation,\n  author  = {Popov, M. and Popov, V. L. and Pohrt, R.},\n  title   = {Relaxation damping in oscillating contacts},\n  journal = {Scientific Reports}, volume = {5}, pages = {16189}, year = {2015},\n  doi     = {10.1038/srep16189}\n}\n@software{salebra,\n  author  = {{The salebra developers}},\n  title   = {salebra: statistics of rough-surface contact and its relaxation damping},\n  version = {${version}}\n}`)));
  });
}

/** Formats consecutive seeds as 1 … 8 (8), others as a list of at most 40. */
function seedText(seeds) {
  if (seeds.length > 2 && seeds.every((s, i) => s === seeds[0] + i)) return `${seeds[0]} … ${seeds.at(-1)} (${seeds.length})`;
  return seeds.slice(0, 40).join(", ") + (seeds.length > 40 ? ` … (${seeds.length})` : "");
}

function heading(point) {
  const surface = point.surface ?? {}, count = surface.realisations ?? 1;
  // A measured surface has no seed; the name of its file is the best heading.
  const file = count === 1 && !surface.seed?.[0] ? point.picture?.origin?.split("/").at(-1) : "";
  const title = data.title || (file ? `Contact and damping of ${file}` : "") || (count > 1 ? `Contact and damping of ${count} rough surfaces` : "Contact and damping of a rough surface");
  const size = surface.nx ? `${count > 1 ? `${count} surfaces` : "1 surface"}, ${surface.nx} × ${surface.ny} points on ${quantity(surface.size_x, "m")} × ${quantity(surface.size_y, "m")}` : "";
  document.getElementById("head").replaceChildren(h("p", {class: "brand"}, "salebra report"), h("h1", {}, title), h("p", {class: "subtitle"}, [size, data.results, data.provenance?.created?.slice(0, 10)].filter(Boolean).join(" · ")));
  const sections = {conclusion: "Results", ...(point.assumptions ? {explorer: "Another motion"} : {}), surface: "Surface", law: "Force law", contact: "Contact", models: "Models", ...(point.adhesion ? {} : {damping: "Damping"}), ...(converged(point) ? {ensemble: "Surfaces"} : {}), symbols: "Symbols", settings: "Settings"};
  document.getElementById("bar").replaceChildren(loadChooser(point, "load"), h("ul", {}, Object.entries(sections).map(([id, text]) => h("li", {}, h("a", {href: `#${id}`}, text)))));
}

function show(index) {
  const point = data.points[index], main = document.getElementById("main");
  nearby.disconnect();
  for (const figure of drawn.splice(0)) Plotly.purge(figure.plot);
  onLoad.length = 0;
  chosenLoad = null;
  heading(point);
  main.replaceChildren();
  if (data.points.length > 1) {
    const chooser = h("select", {id: "point", onchange: (event) => show(Number(event.target.value))}, data.points.map((_, i) => h("option", {value: i, selected: i === index}, data.names?.[i] || `point ${i + 1}`)));
    section(main, "grid", "Parameter grid", null, (body, element) => {
      element.insertBefore(h("label", {class: "choice", for: "point"}, "Point shown below ", chooser), body);
      libraryFigure(body, data, "overview", {height: 340});
    });
  }
  conclusion(main, point);
  if (point.assumptions && point.damping && lawOf(point))
    section(main, "explorer", "Another motion", "Enter a motion to see its loss in this contact. The page computes it from the mean curve of the study, by the formulas of the program.", (body) => explorer(body, point));
  section(main, "surface", "The surface", null, (body) => {
    if (point.picture) {
      libraryFigure(body, point, "height-map");
      profileFigure(body, point);
      libraryFigure(body, point, "spectrum");
      libraryFigure(body, point, "distribution");
    } else {
      body.append(absent("a map, the spectrum and the height distribution of its surface"));
    }
    body.append(surfaceTable(point));
  });
  section(main, "law", "Force against mean gap", null, (body) => {
    if (!libraryFigure(body, point, "gap-load", {height: 420})) body.append(absent("force–gap curves"));
    libraryFigure(body, point, "adhesion-loop", {height: 420});
    libraryFigure(body, point, "local-length");
  });
  section(main, "contact", "Contact", null, (body) => {
    libraryFigure(body, point, "pressure-map");
    libraryFigure(body, point, "gap-map");
    if (point.picture?.first_load) contactMap(body, point);
    else body.append(absent("a contact map"));
    libraryFigure(body, point, "spots");
    libraryFigure(body, point, "spot-areas");
  });
  section(main, "models", "Models side by side", "Boundary elements and Greenwood–Williamson models on the same surfaces, and theories in closed form.", (body, element) => {
    const summary = modelTable(point);
    if (summary) element.insertBefore(summary, body);
    for (const name of ["area-load", "stiffness-load", "stiffness-ratio"]) libraryFigure(body, point, name);
  });
  if (!point.adhesion) section(main, "damping", "Damping", null, (body) => {
    if (!point.damping) return void body.append(absent("damping"));
    libraryFigure(body, point, "damping-curve", {height: 420});
    libraryFigure(body, point, "damping-ratio");
  });
  if (converged(point)) section(main, "ensemble", "Number of surfaces", null, (body) => libraryFigure(body, point, "convergence", {height: 300}));
  symbolsAndCitation(main);
  settings(main, point);
}

document.getElementById("foot").append(h("p", {}, "Popov, Popov, Pohrt: ", h("i", {}, "Relaxation damping in oscillating contacts"), ", Sci. Rep. 5, 16189 (2015), ", h("a", {href: "https://doi.org/10.1038/srep16189", rel: "noreferrer"}, "doi:10.1038/srep16189"),
  ". Drawn with plotly.js, MIT licence. This page loads nothing from the network."));
if (typeof Plotly === "undefined") throw new Error("plotly.js is not in this page");
show(0);
