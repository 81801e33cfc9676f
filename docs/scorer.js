// SPDX-License-Identifier: GPL-3.0-or-later
// What a search lists first: the page that explains a term before those that use it, pages of results, the reference of the libraries and the changelog last.
// A title that matches the query counts 15 (below). The page of a subject comes first for its words, those of other authors included.
const SUBJECTS = {
  "docs/theory": ["decay length"], "docs/theory_contact": ["stiffness"], "docs/statistics": ["levelling", "flattening", "ra", "rq", "sa", "sq"],
  "docs/howto/damping_curve": ["outlier"], "docs/howto/hardness": ["running-in", "plastic"], "docs/howto/joint": ["microslip"],
  "docs/howto/friction": ["gross slip"], "docs/limits": ["excursion", "validity"], "docs/howto/force_law": ["dem", "multibody"],
};
const ASKED = (new URLSearchParams(location.search).get("q") ?? "").trim().toLowerCase();
const AFTER = [/^docs\/cpp/, /^docs\/python\//, /^docs\/names$/, /^CHANGELOG$/, /^docs\/(architecture|comparison|direct_simulation|performance|published|reliability)$/];
var Scorer = {
  score: ([docname, title, anchor, descr, score]) => {
    if (AFTER.some((pattern) => pattern.test(docname))) return score - 20;
    return score + (SUBJECTS[docname]?.some((word) => ASKED === word || ASKED === `${word}s`) ? 60 : 0);
  },
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: {0: 15, 1: 5, 2: -5},
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
