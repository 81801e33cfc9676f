// SPDX-License-Identifier: GPL-3.0-or-later
// node site.mjs SITE [FOLDER]: looks at the built documentation in headless Chromium, at the width of a desk and of a phone. Ends with 1 and the list
// of what is wrong, with 77 where the site is missing or old, or Chromium or playwright-core (tests/report) missing. FOLDER: where pictures go,
// with SALEBRA_SCREENSHOTS=1.
import {existsSync, readdirSync, statSync} from "node:fs";
import {createRequire} from "node:module";
import {join, resolve} from "node:path";
import {fileURLToPath} from "node:url";

const [, , given, folder] = process.argv;
const site = resolve(given);
const executablePath = ["chromium", "chromium-browser", "google-chrome"].map((name) => join("/usr/bin", name)).find(existsSync);
const skip = (why) => { console.error(`skipped: ${why}`); process.exit(77); };
if (!existsSync(join(site, "docs/index.html"))) skip(`no site in ${site}`);
// scripts/docs writes this file last; without Doxygen or the right packages it leaves an older site as it is.
const made = statSync(join(site, "index.html")).mtimeMs;
const pages = fileURLToPath(new URL("../../docs/", import.meta.url));
if (readdirSync(pages).some((name) => statSync(join(pages, name)).mtimeMs > made)) skip(`${site} is older than a file of ${pages}`);
if (!executablePath) skip("Chromium is not installed");
let chromium;
try {
  ({chromium} = createRequire(fileURLToPath(new URL("../report/site.mjs", import.meta.url)))("playwright-core"));
} catch {
  skip("playwright-core is not there; scripts/report-assets tests fetches it");
}

const faults = [];
const check = (ok, what) => { if (!ok) faults.push(what); };
const browser = await chromium.launch({executablePath, headless: true, timeout: 120000,
  args: ["--no-sandbox", "--allow-file-access-from-files", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage"]});

/** What is first in a list of pages that a search finds, by titles and by words of other authors. */
const SEARCHES = {"decay length": "docs/theory.html", "glossary": "docs/glossary.html", "install": "docs/install.html",
  "outlier": "docs/howto/damping_curve.html", "levelling": "docs/statistics.html", "Ra": "docs/statistics.html", "stiffness": "docs/theory_contact.html", "excursion": "docs/limits.html", "microslip": "docs/howto/joint.html"};
const PAGES = ["docs/index", "docs/start", "docs/glossary", "docs/examples", "docs/theory", "docs/theory_contact", "docs/theory_friction", "docs/theory_validity", "docs/questions", "docs/install",
  "docs/notebooks/12_joint", "docs/python/contact"].filter((one) => existsSync(join(site, `${one}.html`)));

const page = await (await browser.newContext()).newPage();
page.setDefaultTimeout(120000);
let at;
page.on("pageerror", (error) => faults.push(`${at}: ${error.message}`));
const open = (one, question = "") => { at = one; return page.goto(`file://${join(site, one)}.html${question}`, {waitUntil: "load"}); };
for (const one of PAGES) {
  await open(one);
  const text = await page.locator("article").innerText();
  check(!text.includes("_core"), `${one}: names the extension, salebra._core`);
  const missing = await page.evaluate(() => [...document.images].filter((image) => image.complete && image.naturalWidth === 0).map((image) => image.src));
  check(missing.length === 0, `${one}: pictures are missing: ${missing}`);
  for (const [name, viewport] of [["desk", {width: 1400, height: 900}], ["phone", {width: 390, height: 800}]]) {
    await page.setViewportSize(viewport);
    const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
    check(content <= window + 1, `${one}, ${name}: ${content} pixels of content in a window of ${window}`);
    const cut = await page.evaluate(() => [...document.querySelectorAll("article p > math, article li > math")].filter((formula) => !formula.closest("table"))
      .filter((formula) => formula.getBoundingClientRect().right > document.documentElement.clientWidth).map((formula) => formula.textContent));
    check(cut.length === 0, `${one}, ${name}: formulas of the text are cut off; set them apart: ${cut}`);
    if (process.env.SALEBRA_SCREENSHOTS && folder) await page.screenshot({path: join(folder, `${one.replaceAll("/", "-")}-${name}.png`)});
  }
}
await page.setViewportSize({width: 1400, height: 900});
await open("docs/start");
check(await page.locator("button.copybtn").count() > 3, "docs/start: no buttons that copy commands");
for (const [words, first] of Object.entries(SEARCHES)) {
  await open("search", `?q=${encodeURIComponent(words)}`);
  const found = page.locator("#search-results ul.search li a").first();
  await found.waitFor({timeout: 60000});
  await page.waitForTimeout(1000);
  const link = await found.getAttribute("href");
  check(link.split(/[?#]/)[0].endsWith(first), `a search for "${words}" finds ${link} first, not ${first}`);
}
await browser.close();
for (const fault of faults) console.error(fault);
process.exit(faults.length ? 1 : 0);
