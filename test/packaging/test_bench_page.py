# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import json
import re

import bench_page
import pytest

from test.support.paths import ROOT

RESULTS = ROOT / 'benchmarks' / 'results'


def test_the_page_is_what_the_results_say():
    # when this fails: make docs
    assert (ROOT / 'BENCHMARKS.md').read_text() == bench_page.page()


def test_the_page_shows_every_result_with_its_commit():
    text = bench_page.page()
    results = sorted(RESULTS.glob('*.json'))
    assert len(results) > 20
    for path in results:
        assert f'\n## {path.stem}\n' in text
        assert f'commit {json.loads(path.read_text())["commit"][:12]}' in text


def test_each_benchmark_has_one_entry_of_key_numbers():
    text = bench_page.KEY_NUMBERS.read_text()
    names = re.findall(r'^(\w+):', text, re.MULTILINE)
    assert sorted(set(names)) == sorted(names)  # of two, YAML takes the last without a word
    for name in names:
        assert len([*(ROOT / 'benchmarks').glob(f'*/{name}.py')]) == 1, name
    for picture in re.findall(r'doc/img/\w+\.png', text):
        assert (ROOT / picture).exists(), picture


def test_every_picture_and_table_among_the_results_is_shown():
    text = bench_page.page()
    for path in RESULTS.glob('*.png'):
        assert f'(benchmarks/results/{path.name})' in text
    for name in ('lab_advise', 'peer_simulators', 'plugin_stability', 'plugin_stock_vs_ours'):
        table = bench_page.table_of(name, json.loads((RESULTS / f'{name}.json').read_text()))
        assert table.count('\n|') > 5
        assert table in text


def test_results_hold_nothing_that_follows_from_others():
    assert {path.suffix for path in RESULTS.iterdir()} == {'.json', '.png', '.csv'}


def test_a_folder_of_short_runs_gets_a_page_of_its_own(tmp_path):
    # of a run too short for all its key numbers, and of a benchmark without any
    (tmp_path / 'remus.json').write_text('{"cores": 2, "decay": {"yaw": 2e-3}}')
    (tmp_path / 'new.json').write_text(
        '{"cpu": "An 8080", "cores": 1, "commit": "abc", "runs": 7, "good": true, "rows": [1]}'
    )
    text = bench_page.page(tmp_path)

    assert '| An 8080; 1 cores | new |' in text
    assert '| runs | 7 |  |  |' in text
    assert '| good | yes |  |  |' in text
    assert 'rows' not in text
    assert '| 0.002 |  |  |' in text
    assert bench_page.page_of(tmp_path) == tmp_path / 'BENCHMARKS.md'


@pytest.mark.parametrize(
    ('result', 'entry', 'value', 'met'),
    [
        ({'a': {'b': -3.0}}, {'at': ['a', 'b']}, -3.0, None),
        ({'a': [{'b': 1.0}, {'b': -2.0}]}, {'at': ['a', '*', 'b'], 'target': '<= 1'}, -2.0, False),
        ({'a': {'x': 0.8, 'y': 2.0}}, {'at': ['a', '*'], 'target': '>= 0.9'}, 0.8, False),
        ({'a': [1.0, 6.0], 'b': [4.0, 8.0]}, {'at': ['a', '*'], 'over': ['b', '*'],
         'target': '<= 1'}, 0.75, True),
        ({'a': [True, False]}, {'at': ['a', '*'], 'target': 'yes'}, False, False),
        ({'a': None}, {'at': ['a'], 'target': '<= 1'}, None, False),
    ],
)  # fmt: skip
def test_the_worst_of_the_values_is_judged(result, entry, value, met):
    shown = bench_page.Shown(result, {'what': 'it', **entry})
    assert shown.value == value
    assert shown.met is met


def test_a_key_number_that_leads_nowhere_is_refused():
    with pytest.raises(ValueError, match=r"a ratio: nothing at \['cost', 'b'\]"):
        bench_page.Shown({'cost': {'a': 1}}, {'what': 'a ratio', 'at': ['cost', 'b']})


def test_rows_are_counted_that_hold():
    result = {'rows': {'a': {'caught': ['RK4']}, 'b': {'caught': []}, 'c': {'caught': ['Euler']}}}
    entry = {'what': 'it', 'at': ['rows', '*', 'caught'], 'count': True, 'target': '>= 3'}
    assert bench_page.Shown(result, entry).value == 2
    assert bench_page.Shown(result, entry).met is False
