# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Scenes drawn over the schemas load, and are stepped, commanded, taken back and stepped again.

The large volume: ``benchmarks/robustness/valid_scenes.py``.
"""

import time
import warnings
from collections import Counter

import pytest

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.schema import (
    fleet,
    flow_data,
    flow_signals,
    mean_flow,
    scene,
    sensors,
    turbulence,
    waves,
)
from fluid_sim_ros.schema.base import Strict
from test.support.hostile.scenes.scene import NOT_DRAWN, drawn_content, drawn_scene
from test.support.hostile.scenes.used import used
from test.support.volumes import quick

#: Of these the files of a scene are made.
MODULES = (fleet, flow_data, flow_signals, mean_flow, scene, sensors, turbulence, waves)
#: Parents of others, which are no mappings of a file themselves.
PARENTS = {
    'SceneKeys', 'ModelKeys', 'SensorFile', 'ScanFile', 'Signal', 'Sheared', 'Turbulence',
    'FlowModel', 'FleetAutopilot', 'Strict', 'Advised',
}  # fmt: skip
DRAWN, STEPPED = 3000, 60


def test_every_key_of_each_schema_occurs():
    """A new key that is not drawn is missing here, or has no rule."""
    stated = {
        f'{kind.__name__}.{key}'
        for module in MODULES
        for kind in vars(module).values()
        if isinstance(kind, type) and issubclass(kind, Strict) and kind.__name__ not in PARENTS
        for key in kind.model_fields
    }
    missing = {name for name in stated if not _is_excused(name)}
    for seed in range(DRAWN):
        missing -= set(drawn_content(seed)[1])
        if not missing:
            break
    assert not missing


def _is_excused(name):
    schema, key = name.split('.')
    return name in NOT_DRAWN or (
        schema.endswith('File') and f'SensorFile.{key}' in NOT_DRAWN
    )  # fmt: skip


@pytest.mark.parametrize('first', quick(range(0, 20 * STEPPED, STEPPED), 0))
def test_drawn_scenes_load_and_are_used(tmp_path, first):
    warnings.simplefilter('ignore')
    outcomes, refused = Counter(), Counter()
    for seed in range(first, first + STEPPED):
        path, _ = drawn_scene(seed, tmp_path)
        begin = time.process_time()
        try:
            outcomes[used(path, seed)] += 1
        except FluidSimError as error:
            refused[str(error)] += 1
            assert str(error).isprintable()
        assert time.process_time() - begin < 10, seed
    assert not outcomes.keys() - {'flown', 'diverged'}, outcomes
    assert sum(refused.values()) <= 0.1 * STEPPED, dict(refused)
    assert outcomes['flown'] > 0.8 * STEPPED
