# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What ``fluid_sim doctor SCENE`` lists."""

from pathlib import Path

import pytest

from fluid_sim_ros.cli.scene import examine_scene


def rows(scene):
    return {row.name: row.found for row in examine_scene(scene)}


@pytest.mark.parametrize('scene', ['x500', 'fish', 'fleet_x500'])
def test_the_model_can_be_copied_from_where_it_says(scene):
    assert Path(rows(scene)['model']).is_file()


def test_thrusters_stand_in_the_order_of_a_command():
    assert rows('x500')['x500: thrusters'] == 'in this order: m1, m2, m3, m4 (0 to 8.549 N each)'
    assert rows('aerosonde')['aerosonde: thrusters'] == 'in this order: propeller (0 to 88.07 N)'
    assert 'fish: thrusters' not in rows('fish')
