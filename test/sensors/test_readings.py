# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What sensors state of their topics fits what they measure."""

import numpy as np
import pytest

from fluid_sim_ros.schema.sensors import KINDS
from fluid_sim_ros.sensors import SensorSuite
from fluid_sim_ros.sensors.sensor import CLASSES


def test_every_kind_of_the_schema_has_one_class():
    assert tuple(sorted(CLASSES)) == tuple(sorted(KINDS))


@pytest.mark.parametrize('kind', KINDS)
def test_readings_are_the_numbers_of_the_channels(kind, brick):
    simulation = brick(density=1000, **{kind: {'rate': 10}}) if kind == 'pressure' else brick(
        density=1.2, **{kind: {'rate': 10}}
    )  # fmt: skip
    suite = SensorSuite(simulation, 'brick')
    sensor = getattr(suite, kind)
    assert suite.sensors == (sensor,)
    if kind != 'camera':  # whose reading is the state that its pictures show
        assert sum(count for _, count in sensor.axes(sensor.config)) == len(sensor.values)
    assert all(getattr(suite, other) is None for other in KINDS if other != kind)
    assert sensor.readings
    stated = {name for name, _ in sensor.axes(sensor.config)}
    for reading in sensor.readings:
        for quantity in reading.quantities:
            numbers = getattr(sensor, quantity.name)
            assert isinstance(numbers, np.ndarray)
            for each in (quantity.unit, quantity.channels):
                assert isinstance(each, str) or len(each) in (0, 1, len(numbers))
            assert stated.issuperset(quantity.channels)
    shown = [c for r in sensor.readings for q in r.quantities for c in q.channels]
    assert set(shown) == stated


def test_the_topics_of_all_sensors_are_distinct():
    topics = [reading.topic for cls in CLASSES.values() for reading in cls.readings]
    assert len(set(topics)) == len(topics)
