// SPDX-License-Identifier: GPL-3.0-or-later
// What a search lists first: the page that explains a term before those that use it, pages of results, the reference of the libraries and the changelog last.
// A title that matches the query counts 15 (below).
const FIRST = {"docs/theory": 18};
const AFTER = [/^docs\/cpp/, /^docs\/python\//, /^docs\/names$/, /^CHANGELOG$/, /^docs\/(architecture|comparison|direct_simulation|performance|published|reliability)$/];
var Scorer = {
  score: ([docname, title, anchor, descr, score]) => {
    if (AFTER.some((pattern) => pattern.test(docname))) return score - 20;
    return score + (FIRST[docname] ?? 0);
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
