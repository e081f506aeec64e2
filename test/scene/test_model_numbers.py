# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Numbers of a model or a state from which no positions come are refused before their use."""

import numpy as np
import pytest

from fluid_sim_ros.errors import FluidSimError, ModelError
from fluid_sim_ros.scene import Scene
from fluid_sim_ros.simulation import Simulation

TREE = (
    '<body name="b{i}" pos="{i} 0 0"><freejoint/><geom size=".1" mass="1"/><site name="s{i}"/>'
    '<body><joint name="j{i}" type="slide" ref="0"/><geom size=".1" mass="1"/></body></body>'
)
BODIES = ''.join(TREE.format(i=i) for i in range(3))
ACTUATORS = ''.join(f'<motor name="a{i}" site="s{i}" gear="0 0 1 0 0 0"/>' for i in range(3))
MODEL = f"""<mujoco><worldbody>{BODIES}</worldbody><actuator>{ACTUATORS}</actuator>
<keyframe><key name="k" qpos="0 0 0 1 0 0 0 0 1 0 0 1 0 0 0 0 2 0 0 1 0 0 0 0"/></keyframe>
</mujoco>"""
PLACES = {
    'key': ('qpos="0 0', 'qpos="{} 0', "key 'k': qpos ="),
    'body': ('pos="1 0', 'pos="{} 0', "body 'b1': pos ="),
    'joint': ('name="j1" type="slide" ref="0"', 'name="j1" type="slide" ref="{}"', 'ref ='),
    'site': ('<site name="s2"/>', '<site name="s2" pos="0 {} 0"/>', "site 's2': pos ="),
    'gear': ('site="s1" gear="0 0 1', 'site="s1" gear="0 0 {}', "actuator 'a1': gear ="),
}


@pytest.mark.parametrize('place', PLACES)
@pytest.mark.parametrize('number', ['nan', 'inf', '1e308', '-1e11'])
def test_a_number_from_which_no_positions_come_is_refused(place, number, tmp_path):
    before, after, words = PLACES[place]
    path = tmp_path / 'a.xml'
    path.write_text(MODEL.replace(before, after.format(number), 1))
    with pytest.raises(ModelError) as refusal:
        Scene.load(path).compile()
    line = str(refusal.value)
    assert '\n' not in line
    assert str(path) in line
    if number != 'nan' or place in line:  # MuJoCo may find NaN first
        assert words in line


@pytest.mark.parametrize('number', [np.nan, np.inf, 1e308])
@pytest.mark.parametrize('at', [0, 1, 9, 30])
def test_a_saved_state_from_which_no_positions_come_is_refused(number, at, tmp_path):
    """Else MuJoCo would write moments beyond its memory when the forces are observed."""
    path = tmp_path / 'a.xml'
    path.write_text(MODEL)
    simulation = Simulation(Scene.load(path))
    state = simulation.save_state()
    state.engine[at] = number
    if at == 0 and number == 1e308:
        return simulation.load_state(state)  # a far time is one
    with pytest.raises(FluidSimError, match='no flight goes on from it'):
        simulation.load_state(state)
    return None


def test_a_name_that_is_no_utf_8_is_one_line(tmp_path):
    (tmp_path / 'm.xml').write_bytes(
        b'<mujoco><worldbody><body name="b"><freejoint/><geom size=".1"/><site name="s"/></body>'
        b'</worldbody><actuator><motor name="a\xa4b" site="s"/></actuator></mujoco>'
    )
    with pytest.raises(ModelError, match=r"name 'a\\xa4b': allowed is UTF-8") as error:
        Scene.load(tmp_path / 'm.xml').compile()
    assert str(error.value).isprintable()
