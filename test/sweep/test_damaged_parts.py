# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A part of a sweep that was damaged on the disk is flown again, whatever byte it is."""

import random

import pyarrow as pa

from fluid_sim_ros.sweep.results import Results, as_table
from test.support.sweeps import sweep_of

ROWS = [{'run': run, 'status': 'ok', 'x': 0.1 * run, 'y': -3.0 * run} for run in range(40)]


def test_no_damaged_part_is_taken_for_another_table(tmp_path):
    sweep = sweep_of(scene='rov', duration=0.1, runs=40, vary={'current.x': {'normal': [0, 1]}})
    folder = tmp_path / 'out'
    Results(folder, sweep).add(ROWS)
    (part,) = (folder / 'parts').glob('*.parquet')
    whole, right = part.read_bytes(), as_table(ROWS)
    rng, refused = random.Random(7), 0
    for _ in range(150):
        damaged = bytearray(whole)
        damaged[rng.randrange(len(whole))] ^= 1 << rng.randrange(8)
        part.write_bytes(damaged)
        results = Results(folder, sweep)
        if results.kept():
            (table,) = results._tables.values()
            assert isinstance(table, pa.Table) and table.to_pylist() == right.to_pylist()
        else:
            refused += 1
    assert refused > 30
    part.write_bytes(whole)
    assert Results(folder, sweep).kept() == [(0, 40)]
