# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The accuracy table of doc/accuracy.md: ours is near the reference, stock is not."""

import pytest

from benchmarks.plugins.plugin_stock_vs_ours import table
from benchmarks.plugins.stock_vs_ours_cases import Row, measure

#: Case (its first words) -> largest error of ours, least error of stock.
BOUNDS = {
    'Neutral ellipsoid': (2e-6, 3.9),  # [m]
    'Sphere of density 500': (1e-6, 0.9),
    'Neutral sphere in a current': (1e-9, 0.5),
    'Aluminium ball': (1e-6, 0.08),
    '5:1 hull': (1e-3, 0.5),
    'Spinning sphere': (1e-9, 0.49),
    'Floating sphere': (1e-3, None),
    'Sphere, Re .1 to 1e5: worst Cd': (0.08, 1.0),
    'Sphere, Re .1 to 1e5: worst terminal': (0.04, 0.3),
    'Disc 1:1:.01 ': (1e-9, 40.0),
    'Disc 1:1:.001': (1e-9, 0.1),
    'Plate of I* = 1.4': (0.25, 0.9),
}


@pytest.fixture(scope='module')
def rows():
    return measure(9)


def test_every_row_has_bounds(rows):
    assert len(rows) == len(BOUNDS)


@pytest.mark.parametrize('case', BOUNDS)
def test_row(rows, case):
    (row,) = [row for row in rows if row.case.startswith(case)]
    ours, stock = BOUNDS[case]
    assert row.error(row.ours) <= ours
    if stock is None:
        assert row.stock is None
    else:
        assert row.error(row.stock) >= stock


def test_table_shows_value_and_error():
    row = Row('case', 'm', 2.0, 3.0, 2.0 + 2e-6)
    expected = '| case [m] | 2 | 3 (50 %) | 2 (1e-06) |'
    assert table({'rows': [row._asdict()]}).splitlines()[-1] == expected
