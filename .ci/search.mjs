// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Asks the search of the built site, by its own code: node search.mjs SITE, questions as JSON on
// standard input; answers with the pages of the hits of each, best first.
import fs from 'node:fs';
import path from 'node:path';
import vm from 'node:vm';

const site = process.argv[2];
const questions = JSON.parse(fs.readFileSync(0, 'utf8'));

const nothing = { addEventListener() {}, querySelector: () => null };
const context = vm.createContext({
  document: { ...nothing, readyState: 'loading', getElementById: () => null },
  ...nothing, console, _ready() {}, DOCUMENTATION_OPTIONS: {}, SPHINX_HIGHLIGHT_ENABLED: false,
});
context.window = context;
for (const file of ['_static/language_data.js', '_static/searchtools.js', 'searchindex.js']) {
  vm.runInContext(fs.readFileSync(path.join(site, file), 'utf8'), context);
}
const ask = vm.runInContext('(q) => Search._performSearch(...Search._parseQuery(q))', context);
const answers = {};
for (const question of questions) {
  // the best comes last; [page, title, anchor, ...]
  answers[question] = ask(question).reverse().slice(0, 5).map((hit) => hit[0] + hit[2]);
}
process.stdout.write(JSON.stringify(answers));
