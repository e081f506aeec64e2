# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import re

from test.support.paths import DOC, ROOT

PAGE = DOC / 'robustness.md'


def test_every_test_that_the_page_names_exists():
    named = set(re.findall(r'`(test_\w+)`', PAGE.read_text(encoding='utf-8')))
    assert len(named) > 50
    files = [path.read_text(encoding='utf-8') for path in (ROOT / 'test').rglob('test_*.py')]
    there = {name for text in files for name in re.findall(r'^def (test_\w+)\(', text, re.M)}
    assert named - there == set()


def test_every_row_says_what_happens_now_and_names_a_test():
    rows = [line for line in PAGE.read_text(encoding='utf-8').splitlines() if line[:2] == '| ']
    rows = [row for row in rows if not row.startswith('| Kind ')]
    assert len(rows) > 40
    for row in rows:
        kind, _, now, tests = (cell.strip() for cell in row.strip('|').split(' |'))
        assert kind and now and tests, row


def test_the_readme_leads_to_the_page():
    assert '(doc/robustness.md)' in (ROOT / 'README.md').read_text(encoding='utf-8')
