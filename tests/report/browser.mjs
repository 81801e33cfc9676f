// SPDX-License-Identifier: GPL-3.0-or-later
// node browser.mjs CHROMIUM FOLDER PROGRAM: opens and uses the pages in FOLDER as a reader would. Prints a list of faults and exits with 1 if there are any.
import {execFileSync} from "node:child_process";
import {existsSync, readFileSync, statSync} from "node:fs";
import {createRequire} from "node:module";
import {dirname, join} from "node:path";
import {inflateSync} from "node:zlib";

const {chromium} = createRequire(import.meta.url)("playwright-core");
const [, , executablePath, folder, program] = process.argv;
const faults = [];
const check = (ok, what) => { if (!ok) faults.push(what); };
process.on("exit", () => { for (const fault of faults) console.error(fault); });

const browser = await chromium.launch({executablePath, headless: true, timeout: 120000,
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage"]});

/** Opens a page. Console messages, exceptions and network requests count as faults. */
async function open(name, options) {
  const context = await browser.newContext({acceptDownloads: true, ...options});
  const page = await context.newPage();
  page.setDefaultTimeout(120000);
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) faults.push(`${name}: console says ${message.text()}`); });
  page.on("pageerror", (error) => faults.push(`${name}: ${error.message}`));
  page.on("request", (request) => { if (!/^(file|blob|data):/.test(request.url())) faults.push(`${name}: asks for ${request.url()}`); });
  await page.goto(`file://${join(folder, name)}`, {waitUntil: "load"});
  return page;
}

/** Saves a picture of the whole page if SALEBRA_SCREENSHOTS is set, because it takes a second. */
async function picture(page, name) {
  if (process.env.SALEBRA_SCREENSHOTS) await page.screenshot({path: join(folder, name), fullPage: true});
}

/** Scrolls through the page as a reader does; each figure is drawn when it comes into sight. */
async function scrollThrough(page) {
  for (const figure of await page.locator("figure").all()) {
    await figure.evaluate((element) => element.scrollIntoView({block: "center", behavior: "instant"}));
    await page.waitForFunction((id) => document.getElementById(`${id}-plot`).data, await figure.getAttribute("id"));
  }
  await page.evaluate(() => scrollTo({top: 0, behavior: "instant"}));
}

/** Each figure has visible curves, a name, a text for screen readers, and a table of finite numbers. */
async function checkFigures(page, name, expected) {
  await scrollThrough(page);
  const figures = await page.evaluate(() => [...document.querySelectorAll("figure")].map((figure) => {
    const plot = figure.querySelector(".plot");
    figure.querySelector("details").open = true;
    return {id: figure.id, title: figure.querySelector("h3").textContent, label: plot.getAttribute("aria-label"), role: plot.getAttribute("role"),
      traces: plot.data?.length ?? 0, shapes: plot.querySelectorAll(".trace path, .heatmaplayer image, .fills path").length,
      axes: [...plot.querySelectorAll(".xtick, .ytick")].length, named: document.getElementById(figure.getAttribute("aria-labelledby")) !== null};
  }));
  const ids = figures.map((figure) => figure.id);
  for (const id of expected) check(ids.includes(id), `${name}: has no figure ${id}, only ${ids}`);
  for (const figure of figures) {
    check(figure.traces > 0 && figure.shapes > 0 && figure.axes >= 2, `${name}: ${figure.id} is not drawn (${JSON.stringify(figure)})`);
    check(figure.role === "img" && figure.label?.length > 40 && !/undefined|NaN|null|\[object/.test(figure.label), `${name}: ${figure.id} says to a screen reader: ${figure.label}`);
    check(figure.named, `${name}: ${figure.id} has no name`);
  }
  await page.waitForFunction(() => [...document.querySelectorAll("figure details")].every((details) => details.querySelector("table")));
  const tables = await page.evaluate(() => [...document.querySelectorAll("figure")].map((figure) => ({id: figure.id, rows: figure.querySelectorAll("tbody tr").length,
    heads: [...figure.querySelectorAll("thead th")].map((head) => head.scope), caption: figure.querySelector("caption")?.textContent})));
  for (const table of tables) {
    check(table.rows >= 1 && table.heads.length >= 2 && table.heads.every((scope) => scope === "col") && table.caption, `${name}: the table of ${table.id} is no table (${JSON.stringify(table)})`);
  }
  await page.evaluate(() => { for (const details of document.querySelectorAll("figure details")) details.open = false; });
  const text = await page.evaluate(() => document.body.innerText);
  check(!/undefined|NaN|\[object|Infinity|‹|›|_\{/.test(text), `${name}: shows ${text.match(/.{0,40}(undefined|NaN|\[object|Infinity|‹|›|_\{).{0,40}/)?.[0]}`);
}

/**
 * Error bars agree with the numbers of the same figure, whatever the unit of the axis: each side of a bar, relative to its value, is the
 * error of a column or the distance from its mean to its low or high. Returns the number of bars on axes with a prefix.
 */
async function checkBars(page, name) {
  const figures = await page.evaluate(() => [...document.querySelectorAll("figure")].map((figure) => {
    const download = window.download;
    let text = "";
    window.download = (file, type, content) => { text = content; };
    figure.querySelector(".csv").click();
    window.download = download;
    const traces = figure.querySelector(".plot").data.flatMap((trace) => ["x", "y"].filter((letter) => trace[`error_${letter}`])
      .map((letter) => ({name: trace.name, values: trace[letter], above: trace[`error_${letter}`].array, below: trace[`error_${letter}`].arrayminus ?? trace[`error_${letter}`].array})));
    return {id: figure.id, text, traces};
  }));
  let prefixed = 0;
  for (const {id, text, traces} of figures) {
    const [heads, ...rows] = parsed(text);
    const column = (head) => rows.map((row) => (row[heads.indexOf(head)] ? Number(row[heads.indexOf(head)]) : NaN));
    for (const {name: trace, values, above, below} of traces) {
      // The column with the same values, up to the unit; numbers of a page have seven digits.
      const near = (a, b) => Math.abs(a - b) <= 1e-6 * Math.abs(b);
      const there = values.map((_, i) => i).filter((i) => values[i] !== null);
      const same = heads.filter((head) => there.length && there.every((i) => near(values[i] / column(head)[i], values[there[0]] / column(head)[there[0]])));
      check(same.length > 0, `${name}: the curve ${trace} of ${id} has the values of no column`);
      if (!same.length) continue;
      // Of columns with the same values, the last is that of the points.
      const means = column(same.at(-1)), factor = values[there[0]] / means[there[0]];
      const other = (word) => heads.find((head) => head.includes(`_${word}`) && head.replace(`_${word}`, "") === same.at(-1));
      const [low, high, error] = ["low", "high", "error"].map((word) => (other(word) ? column(other(word)) : []));
      const bars = there.flatMap((i) => [[above[i], error[i] ?? high[i] - means[i]], [below[i], error[i] ?? means[i] - low[i]]]
        .map(([bar, width]) => [bar / values[i], width / means[i]])).filter(([drawn]) => drawn > 0);
      check(bars.length > 0, `${name}: ${id}, ${trace}: no bar is longer than 0`);
      // The difference of two numbers of seven digits has fewer correct digits.
      const wrong = bars.find(([drawn, told]) => !(Math.abs(drawn - told) <= 1e-6));
      check(!wrong, `${name}: ${id}, ${trace}: a bar is ${wrong?.[0]} of its value, the numbers say ${wrong?.[1]}`);
      if (factor !== 1) prefixed += bars.length;
    }
  }
  return prefixed;
}

/** Every button and switch has a name, headings do not skip a level, ids are unique. */
async function checkStructure(page, name) {
  const found = await page.evaluate(() => {
    const wrong = [];
    for (const element of document.querySelectorAll("main button, main input, main select")) {
      const label = element.getAttribute("aria-label") || element.textContent.trim() || element.labels?.[0]?.textContent.trim();
      if (!label) wrong.push(`${element.outerHTML.slice(0, 80)} has no name`);
    }
    let level = 0;
    for (const heading of document.querySelectorAll("h1, h2, h3")) {
      const next = Number(heading.tagName[1]);
      if (next > level + 1) wrong.push(`${heading.textContent} skips a level`);
      level = next;
    }
    const ids = [...document.querySelectorAll("[id]")].filter((e) => !e.closest("svg")).map((element) => element.id);
    if (new Set(ids).size !== ids.length) wrong.push(`ids are not unique: ${ids.filter((id, i) => ids.indexOf(id) !== i)}`);
    for (const link of document.querySelectorAll("nav a")) if (!document.querySelector(link.getAttribute("href"))) wrong.push(`${link.href} leads nowhere`);
    return wrong;
  });
  for (const fault of found) faults.push(`${name}: ${fault}`);
}

/** Contrast of text and of curves with their background, by WCAG 2. */
async function checkContrast(page, name) {
  const ratios = await page.evaluate(() => {
    const value = (css) => getComputedStyle(document.documentElement).getPropertyValue(`--${css}`).trim();
    const luminance = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)).reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
    const ratio = (a, b) => { const [x, y] = [luminance(value(a)), luminance(value(b))].sort((p, q) => q - p); return (x + 0.05) / (y + 0.05); };
    return [...["ink", "muted", "accent"].map((c) => [c, ratio(c, "raised"), 4.5]), ["warn", ratio("warn", "warn-paper"), 4.5],
      ...["blue", "vermilion", "green", "purple", "ochre", "slate"].map((c) => [c, ratio(c, "raised"), 3])];
  });
  for (const [css, ratio, least] of ratios) check(ratio >= least, `${name}: ${css} has a contrast of ${ratio.toFixed(2)}, less than ${least}`);
}

/** Parses CSV text by RFC 4180 without quotes within cells, as the figures write it. */
function parsed(text) {
  const rows = text.trimEnd().split("\r\n").map((line) => (line.match(/("([^"]|"")*"|[^,]*)(,|$)/g) ?? []).slice(0, line.split(",").length));
  return rows.map((row) => row.map((cell) => cell.replace(/,$/, "").replace(/^"|"$/g, "")));
}

const everyFigure = ["regime-map", "height-map", "profile", "spectrum", "distribution", "gap-load", "local-length", "pressure-map", "gap-map", "contact-map", "spots", "spot-areas", "area-load", "stiffness-load",
  "damping-curve", "damping-ratio", "convergence"];

// Only what is in sight is drawn at first; paper gets all of it.
check(statSync(join(folder, "full.html")).size < 3e6, `full.html: has ${statSync(join(folder, "full.html")).size} bytes`);
const paper = await open("full.html", {viewport: {width: 1280, height: 900}});
const drawnNow = () => paper.evaluate(() => drawn.filter((figure) => figure.plot.data).length);
check((await drawnNow()) < everyFigure.length / 2, `full.html: draws ${await drawnNow()} figures at once`);
await paper.pdf({format: "A4"});
check((await drawnNow()) === everyFigure.length, `full.html: prints ${await drawnNow()} of ${everyFigure.length} figures`);
await paper.context().close();

const full = await open("full.html", {viewport: {width: 1280, height: 900}, colorScheme: "light"});
await checkFigures(full, "full.html", everyFigure);
await checkStructure(full, "full.html");
await checkContrast(full, "full.html");
// The damping constant on top, the profile, the contact map and the regimes show one load, and so do the maps when the page opens. Choosing another load changes all but the maps.
const loadsShown = () => full.evaluate(() => new Promise(requestAnimationFrame)).then(() => full.evaluate(() => [/p = (.*Pa)/.exec(document.querySelector("#conclusion").innerText)?.[1], /^(.*Pa),/.exec(document.querySelector("#load").selectedOptions[0].text)?.[1], /^(.*Pa),/.exec(document.querySelector("#explore-load").selectedOptions[0].text)?.[1],
  /touch at (.*Pa)/.exec(document.querySelector("#profile figcaption").textContent)?.[1], /^(.*Pa):/.exec(document.querySelector("#contact-map output").textContent)?.[1], /Regimes at (.*Pa) for/.exec(document.querySelector("#regime-map figcaption").textContent)?.[1],
  ...["pressure-map", "gap-map"].map((id) => /nominal pressure ([^,;]*\wPa)/.exec(document.querySelector(`#${id} figcaption`).textContent)?.[1])]));
const loads = await loadsShown();
check(loads.length === 8 && new Set(loads).size === 1 && loads[0], `full.html: shows the loads ${loads}`);
await full.selectOption("#load", "9");
const chosen = await loadsShown();
check(new Set(chosen.slice(0, 6)).size === 1 && chosen[0] !== loads[0] && chosen[6] === loads[0] && chosen[7] === loads[0], `full.html: shows the loads ${chosen} where the tenth was chosen`);
await full.selectOption("#load", await full.evaluate(() => String(data.points[0].picture.mapped_load)));
const captions = await full.locator("figcaption b").allTextContents();
check(captions.length === everyFigure.length && captions.every((text, i) => text === `Figure ${i + 1}. `), `full.html: numbers its figures ${captions}`);
// An error has no sign. Assumptions that were not checked and missing numbers are named.
const top = await full.locator("#conclusion").innerText();
check(/numerical error \d/.test(top) && !/error [+−]/.test(await full.evaluate(() => document.body.innerText + document.getElementById("damping-curve-plot").data.flatMap((trace) => trace.text ?? []).join())), `full.html: has an error with a sign: ${top.match(/numerical error.*/)}`);
check(/Validity\s+(valid|valid with care|not valid|not checked)/.test(top) && /slip where it opens and closes: M above [\d.]+\s+friction_coefficient not given/.test(top), `full.html: does not say what was not checked: ${top}`);
const unstated = await full.evaluate(() => { const point = structuredClone(data.points[0]), computed = point.damping.curve.damping_constant.bem; computed.mean[0] = computed.mean[3] = null; return [warningsOf(data.points[0]), warningsOf(point)].map((list) => list.find((line) => /error is larger/.test(line))); });
check(unstated[0] === undefined && /^No damping constant at 2 of 12 pressures/.test(unstated[1]), `full.html: says of numbers that are not stated: ${unstated}`);
// Points in contact are blank in the map of the gap, all others in the map of the pressure.
const blank = await full.evaluate(() => { const of = (id) => document.getElementById(`${id}-plot`).data[0].z.flat(), gap = of("gap-map"); return of("pressure-map").map((p, i) => (p === null) === (gap[i] === null)).filter(Boolean).length / gap.length; });
check(blank < 0.01, `full.html: ${100 * blank} % of the points are blank, or drawn, in the maps of pressure and gap alike`);
const prefixed = await checkBars(full, "full.html");
check(prefixed > 0, "full.html: no error bar stands on an axis with a prefix, for which the bars are checked");
await picture(full, "full-1280.png");

// Each switch changes its axis.
for (const box of await full.locator("figure .switch input").all()) {
  const [figure, axis, before] = await box.evaluate((input) => [input.closest("figure").id, input.dataset.axis, input.checked]);
  await box.click();
  const after = await full.evaluate(([id, name]) => document.getElementById(`${id}-plot`).layout[name[0] + "axis" + name.slice(1)].type, [figure, axis]);
  check(after === (before ? "linear" : "log"), `full.html: the switch of ${figure} ${axis} leaves it ${after}`);
  await box.click();
}
// A click on the legend hides a curve, a second click shows it.
const chip = full.locator("#area-load .legend button").first();
await chip.click();
check(await full.evaluate(() => document.getElementById("area-load-plot").data.some((trace) => trace.visible === false)), "full.html: a click on the legend hides nothing");
check((await chip.getAttribute("aria-pressed")) === "false", "full.html: a hidden curve's button still counts as pressed");
await chip.click();
// At a higher load more points touch.
const touching = () => full.evaluate(() => document.getElementById("contact-map-plot").data[0].z.flat().filter((v) => v !== null).length);
const slider = full.locator("#contact-load");
await slider.focus();
const before = await touching();
await full.keyboard.press("End");
await full.waitForFunction((least) => document.getElementById("contact-map-plot").data[0].z.flat().filter((v) => v !== null).length > least, before);
// Hovering shows values with units.
const hovered = full.locator("#damping-curve .hoverlayer .hovertext");
for (let attempt = 0; attempt < 20 && (await hovered.count()) === 0; ++attempt) {
  const point = await full.evaluate(() => {
    const plot = document.getElementById("damping-curve-plot");
    plot.scrollIntoView({block: "center", behavior: "instant"});
    const trace = plot.data.findIndex((t) => t.text), box = plot.getBoundingClientRect(), {xaxis, yaxis} = plot._fullLayout;
    return [box.x + xaxis._offset + xaxis.c2p(plot.data[trace].x[5]), box.y + yaxis._offset + yaxis.d2p(plot.data[trace].y[5])];
  });
  await full.mouse.move(point[0] - 15, point[1] - 5);
  await full.mouse.move(...point, {steps: 5});
  await full.waitForTimeout(200 + 100 * attempt);
}
check((await hovered.count()) > 0, "full.html: hovering over a point of the damping curve shows nothing");
const hover = (await hovered.count()) ? await full.locator("#damping-curve .hoverlayer").textContent() : "";
check(/force F [\d.]+\s[µmn]?N/.test(hover) && /: [\d.]+\s[mµk]?N s\/m/.test(hover) && /cycle W [\d.]+\s[a-z]J/.test(hover), `full.html: hovering says ${hover}`);
// The CSV file of every figure is a table of numbers.
for (const [i, id] of everyFigure.entries()) {
  // Chromium allows a page ten downloads in ten seconds: only the first five are real, for the others the test intercepts the text.
  let name, text;
  if (i < 5) {
    const [download] = await Promise.all([full.waitForEvent("download"), full.locator(`#${id} .csv`).click()]);
    [name, text] = [download.suggestedFilename(), readFileSync(await download.path(), "utf8")];
  } else {
    await full.evaluate(() => { window.download = (file, type, content) => { window.caught = [file, content]; }; });
    await full.locator(`#${id} .csv`).click();
    [name, text] = await full.evaluate(() => window.caught);
  }
  const rows = parsed(text);
  check(name === `${id}.csv`, `full.html: ${id} downloads as ${name}`);
  check(rows.length > 2 && rows.every((row) => row.length === rows[0].length), `full.html: the CSV of ${id} has ragged rows`);
  check(rows[0].every((head) => /^[a-z0-9_A-Z]+$/.test(head)), `full.html: the CSV of ${id} has the header ${rows[0]}`);
  check(rows.slice(1).every((row) => row.every((cell) => cell === "" || Number.isFinite(Number(cell)))), `full.html: the CSV of ${id} has cells that are no numbers`);
}
// The deviation of Eq. (16) is the ratio of two columns of the figure above it.
const columns = await full.evaluate(() => ["damping-curve", "damping-ratio"].map((id) => { document.querySelector(`#${id} .csv`).click(); return window.caught[1]; }));
const [[curveHeads, ...curve], [offHeads, ...off]] = columns.map(parsed);
const columnOf = (heads, rows, head) => rows.map((row) => Number(row[heads.findIndex((one) => head.test(one))]));
const [byLaw, computed, told] = [columnOf(curveHeads, curve, /closed_form_Ns_per_m$/), columnOf(curveHeads, curve, /^boundary_elements_damping_constant_Ns_per_m$/), columnOf(offHeads, off, /^Eq_16_fitted_l/)];
check(told.length === 12 && told.every((v, i) => !(Math.abs(v - byLaw[i] / computed[i]) > 1e-6 * (1 + Math.abs(v)))), `full.html: is off by ${told}, by its columns ${byLaw.map((v, i) => v / computed[i])}`);
// The SVG picture, different markers in the legend, and links from symbols to their meaning.
await full.evaluate(() => { window.caught = null; });
await full.locator("#stiffness-load button.svg").click();
await full.waitForFunction(() => window.caught);
const vector = await full.evaluate(() => window.caught);
check(vector[0] === "stiffness-load.svg" && vector[1].startsWith("<svg") && vector[1].includes("trace"), `full.html: the picture of stiffness-load is ${vector[0]}, ${vector[1].slice(0, 40)}`);
const marks = await full.evaluate(() => [...document.querySelectorAll("#area-load .legend svg")].map((sample) => sample.innerHTML.replace(/stroke-dasharray="[^"]*"/, "")));
check(new Set(marks).size >= 6, `full.html: the legend of area-load has ${new Set(marks).size} different marks`);
const symbols = await full.evaluate(() => [...document.querySelectorAll("a.symbol")].filter((link) => !document.getElementById(decodeURIComponent(link.hash.slice(1)))).length);
check(symbols === 0 && (await full.locator("a.symbol").count()) > 10, `full.html: ${symbols} symbols lead nowhere`);
for (const page of new Set(await full.locator("#symbols td code").allInnerTexts())) check(existsSync(join(dirname(process.argv[1]), "../..", page)), `full.html: ${page}, which defines a symbol, is not there`);
check(/Run time of the command/.test(await full.locator("#settings").innerText()), "full.html: does not say how long its study took");
check(/@article/.test(await full.locator("#symbols").textContent()), "full.html: has no citation");
// Without JavaScript, the page shows the numbers and the verdict.
const bare = await (await browser.newContext({javaScriptEnabled: false})).newPage();
await bare.goto(`file://${join(folder, "full.html")}`, {waitUntil: "load"});
const said = await bare.locator("main").innerText();
check(/Decay length l of F ∝ exp\(−ū\/l\): [\d.]+ [nµ]m/.test(said) && /The law is a (fair|poor) description/.test(said) && /Validity: [a-z ]+\.[^]*slip where it opens/.test(said), `full.html without JavaScript says ${said.slice(0, 200)}`);
check((await bare.locator("main table tbody tr").count()) === 12, "full.html without JavaScript: has no table of damping constants");
const drawnVerdict = await full.locator("#conclusion .verdict strong").first().textContent();
check(said.includes(drawnVerdict.trim()), `full.html: the verdicts with and without JavaScript differ: ${drawnVerdict}`);
// With friction, the table includes the damping constant of the motion as described.
await bare.goto(`file://${join(folder, "grid.html")}`, {waitUntil: "load"});
const bareHeads = await bare.locator("main table").first().locator("th").allTextContents(), bareCells = await bare.locator("main table").first().locator("tbody td:nth-last-child(4)").allTextContents();
check(bareHeads.join() === "pressure,force,closed form, fitted l,without slip,with slip,largest force,contact time,regime" && bareCells.filter((text) => /N s\/m$/.test(text)).length > 4, `grid.html without JavaScript: has the columns ${bareHeads}, the last ${bareCells}`);
await bare.context().close();

/** For each sheet of a PDF by Chromium, the vertical positions of its text lines as fractions of the sheet from its top. */
function linesOfSheets(file) {
  const bytes = readFileSync(file), text = bytes.toString("latin1");
  const objects = new Map([...text.matchAll(/(?:^|\n)(\d+) 0 obj\n/g)].map((found) => [found[1], found.index + found[0].length]));
  return [...text.matchAll(/\/Type \/Page\b[^]*?\/MediaBox \[0 0 \S+ (\S+)\][^]*?\/Contents (\d+) 0 R/g)].map(([, height, contents]) => {
    const begin = text.indexOf("stream\n", objects.get(contents)) + "stream\n".length;
    const lines = [], saved = [];
    let [scale, shift] = [1, 0];  // vertical part of the transformation to points above the bottom of the sheet
    for (const line of inflateSync(bytes.subarray(begin, text.indexOf("endstream", begin))).toString("latin1").split("\n")) {
      const words = line.split(" "), operator = words.at(-1);
      if (operator === "q") saved.push([scale, shift]);
      else if (operator === "Q") [scale, shift] = saved.pop();
      else if (operator === "cm") [scale, shift] = [words[3] * scale, words[5] * scale + shift];
      else if (operator === "Tm") lines.push(1 - (words[5] * scale + shift) / height);
    }
    return lines;
  });
}

// The printed page is light and fits the sheet.
await full.setViewportSize({width: 794, height: 900});
await full.emulateMedia({colorScheme: "dark"});
await checkContrast(full, "full.html, dark");
await picture(full, "full-794-dark.png");
await full.pdf({path: join(folder, "full.pdf"), format: "A4"});
check(statSync(join(folder, "full.pdf")).size > 50000, "full.html: prints next to nothing");
// Fourteen figures and six tables take eight sheets, and more if each figure has the whole width.
const sheets = linesOfSheets(join(folder, "full.pdf"));
check(sheets.length > 4 && sheets.length <= 9, `full.html: prints on ${sheets.length} sheets`);
for (const [i, lines] of sheets.slice(0, -1).entries()) check(Math.max(...lines) > 0.5, `full.html: of sheet ${i + 1} only ${Math.max(...lines)} is printed`);
// The program prints the same sheets, with every figure.
execFileSync(program, ["report", join(folder, "full.h5"), "--pdf", join(folder, "printed.pdf"), "--quiet"], {stdio: ["ignore", "ignore", "pipe"]});
const printed = linesOfSheets(join(folder, "printed.pdf"));
check(Math.abs(printed.length - sheets.length) <= 1 && printed.flat().length > 0.9 * sheets.flat().length, `printed.pdf: has ${printed.flat().length} lines on ${printed.length} sheets, full.pdf ${sheets.flat().length} on ${sheets.length}`);
await full.emulateMedia({media: "print"});
check((await full.evaluate(() => getComputedStyle(document.body).backgroundColor)) === "rgb(255, 255, 255)", "full.html: prints on dark paper");
await picture(full, "full-print.png");
check(!(await full.locator("nav").isVisible()), "full.html: prints its links within the page");

// On a phone, nothing is wider than the screen.
for (const name of ["full.html", "study.html"]) {
  const phone = await open(name, {viewport: {width: 390, height: 844}, isMobile: true, hasTouch: true, deviceScaleFactor: 1});
  await checkFigures(phone, `${name}, 390`, everyFigure);
  const width = await phone.evaluate(() => document.documentElement.scrollWidth);
  check(width <= 390, `${name}: is ${width} pixels wide on a phone of 390`);
  await picture(phone, `${name.replace(".html", "")}-390.png`);
  // For several surfaces, the page computes from their mean curve the same shares by slip as the study.
  if (name === "study.html") {
    const shares = await phone.evaluate(() => { const point = data.points[0]; return point.solution.slip_share.map((share, k) => [share, explore(point, k, studiedMotion(point)).slip_share]).filter((pair) => pair.every(known)); });
    check(shares.length > 4 && shares.every(([share, mine]) => Math.abs(share - mine) < 1e-3), `study.html: shares by slip, in the file and by the page: ${shares.join(" | ")}`);
  }
  await phone.context().close();
}

/** Enters numbers in the explorer as a reader would. Returns the numbers shown, the reason for missing ones, and data of the study. */
async function explored(page, load, numbers) {
  await page.selectOption("#explore-load", String(load));
  return page.evaluate(async (values) => {
    for (const [name, value] of Object.entries(values)) {
      const input = document.getElementById(`explore-${name}`);
      input.value = value;
      input.dispatchEvent(new Event("input"));
    }
    for (let frame = 0; frame < 2; ++frame) await new Promise(requestAnimationFrame);
    const shown = Object.fromEntries([...document.querySelectorAll("#explorer dl div")].map((line) => [line.firstChild.textContent, line.lastChild.textContent])), why = document.querySelector("#explorer .why")?.textContent;
    return {shown, why, data: data.points[0].pressure, contact: data.points[0].damping.contact_modulus};
  }, numbers);
}

/** Parses a number with prefix and unit as the page writes it; NaN for n/a. */
function readBack(text) {
  const [, digits, , power, prefix] = /^([\d.]+)(\s×\s10(\S+))?\s?([afpnµmkMG]?)(N s\/m|N|J|%)$/.exec(text) ?? [];
  const exponent = power ? Number([...power].map((c) => (c === "⁻" ? "-" : "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c))).join("")) : 0;
  return digits ? Number(digits) * 10 ** exponent * {a: 1e-18, f: 1e-15, p: 1e-12, n: 1e-9, "µ": 1e-6, m: 1e-3, "": 1, k: 1e3, M: 1e6, G: 1e9}[prefix] : NaN;
}

// For motions entered in the page, the losses agree with those of the program for the same curve to 1 %, the effect of three digits and of the steps of a cycle.
// The motions range from no slip to sliding; units are those of the controls.
const motions = {
  slow: [[{normal_amplitude: 100, frequency: 20, drag_velocity: 1e-3, excursion: 2, friction_coefficient: 0.3}, "pm kHz mm/s nm"], [{normal_amplitude: 300, frequency: 50, drag_velocity: 1e-2, excursion: 5, friction_coefficient: 0.1}, "pm kHz mm/s nm"],
    [{normal_amplitude: 50, frequency: 5, drag_velocity: 1e-3, excursion: 100, friction_coefficient: 1}, "pm kHz mm/s nm"], [{normal_amplitude: 800, frequency: 20, drag_velocity: 1e-4, excursion: 0.005, friction_coefficient: 1}, "pm kHz mm/s nm"]],
  equal: [[{normal_amplitude: 300, frequency: 20, tangential_amplitude: 20, phase: 1, friction_coefficient: 0.3}, "pm kHz pm rad"], [{normal_amplitude: 800, frequency: 1, tangential_amplitude: 5, phase: 2, friction_coefficient: 0.3}, "pm kHz pm rad"],
    [{normal_amplitude: 20000, frequency: 20, tangential_amplitude: 500, phase: 1, friction_coefficient: 0.3}, "pm kHz pm rad", "force"], [{normal_amplitude: 20000, frequency: 20, tangential_amplitude: 5000, phase: 1, friction_coefficient: 0.3}, "pm kHz pm rad", "auto"]]};
// Motions that lift off, with what they hold.
motions.slow.push([{normal_amplitude: 20000, frequency: 20, drag_velocity: 0.1, excursion: 20, friction_coefficient: 0.3}, "pm kHz mm/s nm", "auto"], [{normal_amplitude: 20000, frequency: 20, drag_velocity: 10, excursion: 2000, friction_coefficient: 0.3}, "pm kHz mm/s nm", "force"],
  [{normal_amplitude: 8000, frequency: 20, drag_velocity: 0.1, excursion: 20, friction_coefficient: 1}, "pm kHz mm/s nm", "indentation"]);
const seen = {settings: 0, regimes: new Set(), validities: new Set()};
for (const [name, sets] of Object.entries(motions)) {
  const page = await open(`${name}.html`, {viewport: {width: 1280, height: 900}});
  for (const [set, units, hold = "indentation"] of sets) {
    // Larger loads would press beyond the end of the curve.
    const loadsAsked = set.normal_amplitude < 1000 ? [4, 7, 8, 9] : [1, 2, 3, 4];
    const names = Object.keys(set), given = names.flatMap((key, i) => [`--${key.replaceAll("_", "-")}`, `${set[key]}${units.split(" ")[i] ?? ""}`]);
    const {data: pressures, contact} = await explored(page, 4, {...set, hold});
    const asked = JSON.parse(execFileSync(program, ["damping", "--curve", join(folder, `${name}.h5`), "--pressure", loadsAsked.map((k) => pressures[k]).join(), "--contact-modulus", String(contact), "--hold", hold, "--poisson", "0.3", "--density", "2000",
      ...(name === "equal" ? ["--mode", "equal-frequency"] : []), ...given, "--json"], {encoding: "utf8", stdio: ["ignore", "pipe", "ignore"]}));
    for (const [i, k] of loadsAsked.entries()) {
      const {shown} = await explored(page, k, set), where = `${name}.html, load ${k}, ${given.join(" ")}`;
      for (const [label, value] of [["damping constant γ", asked.damping_constant[i]], ["work per cycle W", asked.work_per_cycle[i]], ["γ without slip", asked.damping_constant_without_slip[i]], ["mean force", asked.mean_force[i]], ["largest force", asked.max_force[i]]])
        check(value === null ? shown[label] === "n/a" : Math.abs(readBack(shown[label]) / value - 1) < 0.01, `${where}: ${label} is ${shown[label]}, by the program ${value}`);
      for (const [label, share] of [["by slip", asked.slip_share[i]], ["by relaxation", asked.relaxation_share[i]], ["contact time", asked.contact_time[i]]])
        check(share === null ? shown[label] === "n/a" : Math.abs(readBack(shown[label]) / 100 - share) < 0.01, `${where}: ${shown[label]} ${label}, by the program ${share}`);
      check(shown.regime === asked.regime[i], `${where}: the regime is ${shown.regime}, by the program ${asked.regime[i]}`);
      // With a coefficient of friction slip is computed, so it is no assumption.
      const verdicts = Object.entries(asked.assumptions).filter(([assumption, one]) => !/^slip_|^amplitude/.test(assumption) && !(assumption === "coupling" && one.verdict[i] === "unknown")).map(([, one]) => one.verdict[i]);
      if (asked.regime[i] === "sliding") verdicts.push("broken");  // no damper
      const validity = [["broken", "not valid"], ["doubtful", "valid with care"], ["unknown", "not checked"], ["holds", "valid"]].find(([verdict]) => verdicts.includes(verdict))[1];
      check(shown.validity === validity, `${where}: is ${shown.validity}, by the program ${validity}`);
      seen.settings += 1;
      seen.regimes.add(shown.regime);
      seen.validities.add(shown.validity);
    }
  }
  if (name === "slow") {
    await checkFigures(page, "slow.html", [...everyFigure.filter((id) => id !== "convergence"), "stiffness-ratio"]);
    await picture(page, "slow-1280.png");
    // If the program gives no number, the page gives none and states the reason.
    for (const [change, reason] of [[{excursion: ""}, /depends on excursion/], [{excursion: 0.001, drag_velocity: 0.01}, /motion is not slow/], [{excursion: 2, normal_amplitude: 1e5}, /presses up to about .*, but the curve ends at .*; extend the curve/], [{normal_amplitude: -1}, /must be > 0/]]) {
      const {shown, why} = await explored(page, 7, change);
      check(shown["damping constant γ"] === "n/a" && reason.test(why), `slow.html, ${JSON.stringify(change)}: shows ${shown["damping constant γ"]}, because ${why}`);
    }
    await explored(page, 2, {...motions.slow.at(-2)[0], hold: "auto"});
    const regions = await page.evaluate(() => document.getElementById("regime-map-plot").data.map((trace) => trace.name));
    check(regions.includes("lifts off") && regions.includes("sliding") && !regions.includes("no slip"), `slow.html: the map of a motion that lifts off has ${regions}`);
    await picture(page, "slow-lift-off.png");
    await page.click("#explorer button");
    check((await page.inputValue("#explore-normal_amplitude")) === "100" && (await page.inputValue("#explore-friction_coefficient")) === "0.3", "slow.html: the button does not bring back the motion of the study");
    check((await page.inputValue("#explore-hold")) === "indentation", "slow.html: the button does not bring back what the study holds");
  }
  await page.context().close();
}
check(seen.settings >= 40 && seen.regimes.size === 4 && seen.validities.size >= 2, `explorer: ${seen.settings} settings, ${[...seen.regimes]}, ${[...seen.validities]}`);
// Contacts solved within the oscillation check the curve. If they contradict it, the page gives no number.
const judged = await full.evaluate(() => { const point = data.points[0], {mean, error} = point.solution.damping_constant, of = (p, k) => explore(p, k, studiedMotion(p));
  const other = structuredClone(point);
  Object.assign(other.solution.damping_constant, {mean: mean.map((value) => value && value / 3), error: error.map((value) => value && value / 3)});
  return point.pressure.map((_, k) => ({k, mean: mean[k], error: error[k], mine: of(point, k), other: of(other, k)})).filter((one) => known(one.mean) && !/presses|lowest load of the curve/.test(one.mine.why)); });
const curveOf = (answer) => answer.verdicts.find((one) => one.name === "curve").verdict;
for (const {k, mean, error, mine} of judged)
  check(curveOf(mine) === "broken" ? Number.isNaN(mine.damping_constant) : Math.abs(mine.damping_constant / mean - 1) <= error / mean + (curveOf(mine) === "holds" ? 0.05 : 0.2), `full.html, load ${k}: ${mine.damping_constant} by the curve, ${mean} ± ${error} by contacts, which is ${curveOf(mine)}`);
check(judged.length > 5 && judged.every(({other}) => curveOf(other) === "broken" && Number.isNaN(other.damping_constant) && other.validity === "not valid" && /does not resolve/.test(other.why)), "full.html: has numbers of a curve that contacts do not confirm");

// Adhesive surfaces, and then another point of a parameter grid.
const sticky = await open("sticky.html", {viewport: {width: 1280, height: 900}});
await checkFigures(sticky, "sticky.html", ["gap-load", "area-load", "adhesion-loop"]);
check((await sticky.textContent("#conclusion")).includes("a cycle loses"), "sticky.html: no adhesion work");
check(await sticky.locator("#damping").count() === 0, "sticky.html: damping with adhesion");

const grid = await open("grid.html", {viewport: {width: 1280, height: 900}});
await checkFigures(grid, "grid.html", ["overview", ...everyFigure]);
await checkBars(grid, "grid.html");
// The figure shows the loss of the motion as described, as the card on top does, and it is larger than without slip.
const pictured = await grid.evaluate(() => { const {data: traces} = document.getElementById("damping-curve-plot"); return [traces.find((trace) => trace.name.startsWith("with slip"))?.y ?? [], traces.findLast((trace) => trace.name === "boundary elements").y]; });
check(pictured[0].some((value, i) => value && pictured[1][i]) && pictured[0].every((value, i) => !value || !pictured[1][i] || value > pictured[1][i]), `grid.html: draws with slip ${pictured[0]}, without ${pictured[1]}`);
const first = await grid.evaluate(() => document.querySelectorAll("#conclusion .value + .detail")[2].textContent);
await grid.selectOption("#point", "1");
await checkFigures(grid, "grid.html, second point", ["overview", ...everyFigure]);
check(first !== (await grid.evaluate(() => document.querySelectorAll("#conclusion .value + .detail")[2].textContent)), "grid.html: the second point shows the first");
await picture(grid, "grid-1280.png");

// A minimal file with texts that try to inject markup; the C++ tests leave it.
try {
  statSync(join(folder, "hostile.html"));
  const hostile = await open("hostile.html", {viewport: {width: 1280, height: 900}});
  await checkFigures(hostile, "hostile.html", ["gap-load", "area-load"]);
  check((await hostile.title()).includes("<script>"), `hostile.html: its title is ${await hostile.title()}`);
  check((await hostile.locator(".absent").count()) >= 4, "hostile.html: does not say what it lacks");
  const made = (await hostile.locator("#settings").innerText()).replace(/\s+/g, " ");
  check(/Run time of the command 1 h 5 min 2 s /.test(made) && /, revision 0123456789ab-modified;/.test(made), `hostile.html: its settings say ${made}`);
  await hostile.locator("#area-load .plot").hover();
  check((await hostile.title()) !== "taken", "hostile.html: a name in the file was run");
  check((await hostile.evaluate(() => document.querySelectorAll("[onmouseover], [onerror], main img").length)) === 0, "hostile.html: a name in the file became markup");
  await picture(hostile, "hostile-1280.png");
} catch (error) {
  if (error.code !== "ENOENT") throw error;
}

await browser.close();
console.log(faults.length ? `${faults.length} faults` : "every figure is drawn");
process.exitCode = faults.length ? 1 : 0;
