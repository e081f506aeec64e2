// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// What the search of the site shows first: pages that answer before pages that report.
Scorer = {
  score: ([page, , anchor, , score]) => {
    const reports = /^(project|vehicles|reference)\/|^(development|extending|robustness)$/.test(page);
    // a heading that has the words of the question answers it
    return score + (anchor ? 10 : 0) - (reports ? 20 : 0);
  },
  objNameMatch: 11, objPartialMatch: 6, objPrio: { 0: 15, 1: 5, 2: -5 }, objPrioDefault: 0,
  title: 15, partialTitle: 7, term: 5, partialTerm: 2,
};
