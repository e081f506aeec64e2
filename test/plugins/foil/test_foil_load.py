# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What fluid_sim.foil refuses when a model is loaded, where foils may be, and how they run."""

import copy
from pathlib import Path

import mujoco
import numpy as np
import pytest
from mujoco.batch import Batch

from fluid_sim_ros.physics.environment.waves import regular_waves, wave_flow
from fluid_sim_ros.physics.foil import WingParams, wing_wrench
from fluid_sim_ros.plugins.native import native
from test.support.foil_models import AEROSONDE, foil_world, generalized
from test.support.plugin_models import config, load, refusal

WING = {'span': 1.0, 'chord': 0.2}


def without(values, *keys):
    return {key: value for key, value in values.items() if key not in keys}


BAD = {
    # case: (values, what the line must name)
    'no span': ({'chord': 1}, ['span is missing', '> 0 [m]']),
    'zero span': ({**WING, 'span': 0}, ['span', "'0'", '> 0 [m]']),
    'negative chord': ({**WING, 'chord': -1}, ['chord', "'-1'", '> 0 [m]']),
    'no number': ({**WING, 'drag_0': 'low'}, ['drag_0', 'low', '>= 0']),
    'nan': ({**WING, 'lift_0': 'nan'}, ['lift_0', 'nan']),
    'unknown kind': ({**WING, 'kind': 'sail'}, ['kind', 'sail', 'wing, aircraft']),
    'unknown site': ({**WING, 'site': 'wing fin'}, ['site', "'fin' is none"]),
    'stall beyond': ({**WING, 'stall_angle': 1.5}, ['stall_angle', '0.01..1.2 [rad]']),
    'too soft a stall': (
        {**WING, 'stall_angle': 1.2, 'stall_sharpness': 10}, ['stall_sharpness', '90 deg']
    ),
    'two slopes': ({**WING, 'lift_slope': 4, 'section_slope': 5}, ['exclude each other']),
    'unknown plate': ({**WING, 'plate': 'cosine'}, ['plate', 'cosine', 'newton, sine']),
    'half a panel': ({**WING, 'panels': 1.5}, ['panels', '1..64']),
    'unknown joint': ({**WING, 'deflection': 'joint flap'}, ['deflection', 'joint NAME']),
    'deflection of what': ({**WING, 'deflection': 'flap'}, ['deflection', 'actuator NAME']),
    'bad gain': ({**WING, 'deflection': 'joint flap x'}, ['deflection', 'gain']),
    'derivative on a wing': ({**WING, 'roll_p': -1}, ['roll_p', 'kind="aircraft"']),
    'wing key on an aircraft': ({**AEROSONDE, 'panels': 3}, ['panels', 'kind="wing"']),
    'aircraft without chord': (without(AEROSONDE, 'chord'), ['chord is missing']),
}  # fmt: skip


def line_of(xml):
    return refusal(xml, 'fluid_sim.foil: ')


@pytest.mark.parametrize('case', BAD)
def test_bad_values_are_refused_with_one_line(case):
    values, words = BAD[case]
    line = line_of(foil_world(values))
    assert line.startswith("fluid_sim.foil: instance 'foil': ")
    for word in words:
        assert word in line


def test_unknown_key():
    line = line_of(foil_world({**WING, 'drag0': 1}))
    assert "unknown key 'drag0'" in line
    assert 'drag_0' in line


def test_a_foil_must_be_somewhere_that_moves_in_a_fluid():
    xml = foil_world(WING).replace('<config key="site" value="wing"/>', '')
    assert 'is nowhere' in line_of(xml)
    moved = foil_world(WING).replace('<worldbody>', '<worldbody><site name="ground"/>')
    assert 'cannot move' in line_of(moved.replace('value="wing"', 'value="ground"'))
    assert 'no density' in line_of(foil_world(WING, medium={'density': 0}))


def test_stock_drag_on_the_same_body():
    xml = foil_world(WING).replace('<option ', '<option density="1.2682" ')
    assert 'stock_drag="keep"' in line_of(xml)
    load(
        foil_world({**WING, 'stock_drag': 'keep'}).replace('<option ', '<option density="1.2682" ')
    )


def test_several_sites_and_bodies_and_instances():
    """Two fins by one instance, one more on a body, one more by another instance: all add up."""
    inside = (
        '<site name="left" pos="-.5 .3 0"/><site name="right" pos="-.5 -.3 0"/>'
        '<site name="tail" pos="-1 0 0" euler="90 0 0"/>'
    )
    tail = {'span': 0.4, 'chord': 0.1}
    extension = (
        '<plugin plugin="fluid_sim.foil"><instance name="tail">'
        f'{config({"site": "tail", **tail})}</instance></plugin>'
    )
    xml = foil_world({**WING, 'site': 'left right'}, inside=inside, extension=extension)
    xml = xml.replace(
        '<inertial pos="0 0 0"',
        f'<plugin plugin="fluid_sim.foil">{config({"span": 0.3, "chord": 0.1})}</plugin>'
        '<inertial pos="0 0 0"',
    )
    model, data = load(xml)
    data.qvel[:] = [10, 1, -1, 0.2, 0.3, 0.4]
    found = generalized(model, data)
    wanted = np.zeros(6)
    turned = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    for point, axes, size in (
        ([-0.5, 0.3, 0], np.eye(3), WING), ([-0.5, -0.3, 0], np.eye(3), WING),
        ([0, 0, 0], np.eye(3), {'span': 0.3, 'chord': 0.1}), ([-1, 0, 0], turned, tail),
    ):  # fmt: skip
        v = data.qvel[:3] + np.cross(data.qvel[3:], point)
        force, torque = wing_wrench(
            WingParams(area=size['span'] * size['chord'], **size),
            axes.T @ v, axes.T @ data.qvel[3:], density=1.2682,
        )  # fmt: skip
        force, torque = axes @ force, axes @ torque
        wanted += np.r_[force, torque + np.cross(point, force)]
    np.testing.assert_allclose(found, wanted, rtol=1e-11, atol=1e-11)


SEA = {'surface': 0.0, 'density': 1000, 'density_above': 1.2}


@pytest.mark.parametrize('height', [-2.0, -0.02, 0.0, 0.05, 2.0])
def test_across_the_surface_the_panels_share(height):
    """A rudder that pierces the surface: the wet share of its span brings the force of water."""
    values = {'span': 0.4, 'chord': 0.1, 'panels': 40}
    model, data = load(foil_world(values, site='euler="90 0 0"', medium=SEA))
    data.qpos[2] = height
    data.qvel[:3] = [2, 0.2, 0]
    found = generalized(model, data)[1]
    wet = np.clip(0.5 - height / 0.4, 0, 1)
    alone, _ = wing_wrench(WingParams(area=0.04, span=0.4, chord=0.1), [2, 0, -0.2], density=1)
    wanted = -alone[2] * (1000 * wet + 1.2 * (1 - wet))
    assert found == pytest.approx(wanted, rel=0.01)


def test_a_wave_wets_a_rudder_and_moves_past_it():
    """Under a crest at the mean level: water everywhere, and its orbital velocity as inflow."""
    values = {'span': 0.04, 'chord': 0.02, 'panels': 1}
    sea = SEA | {'waves': 'regular 1 6', 'wave_direction': [0, 1]}
    option = 'timestep=".01" integrator="RK4" gravity="0 0 -9.81"'
    model, data = load(foil_world(values, site='euler="90 0 0"', medium=sea, option=option))
    data.qvel[0] = 2
    found = generalized(model, data)[1]
    along = wave_flow(regular_waves(1, 6, [0, 1]), [0, 0, 0], 0.0).velocity[1]
    assert along == pytest.approx(0.5 * 2 * np.pi / 6)
    # relative to the water the rudder slides to -y, its own z: lift towards +y
    wing = WingParams(area=0.0008, span=0.04, chord=0.02)
    alone, _ = wing_wrench(wing, [2, 0, along], density=1000)
    assert found == pytest.approx(-alone[2], rel=1e-9)
    data.time = 3.0  # the trough: dry
    assert abs(generalized(model, data)[1]) < 0.01 * found


@pytest.mark.parametrize('integrator', ['RK4', 'implicitfast', 'Euler'])
def test_every_way_to_run_gives_the_same_bits(integrator):
    option = f'timestep=".005" integrator="{integrator}"'
    model, data = load(foil_world(AEROSONDE, option=option))
    data.qvel[:] = [25, 1, -1, 0.1, 0.2, 0.3]
    first = copy.copy(data)
    batch = Batch(model, nsim=3, nthread=2)
    batch.bind('qvel')[:] = data.qvel
    mujoco.mj_step(model, data, 40)
    for _ in range(40):
        mujoco.mj_forward(model, first)
        mujoco.mj_step(model, first)
        batch.step()
    for other in (first, *(batch.get_data(i) for i in range(3))):
        np.testing.assert_array_equal(other.qpos, data.qpos)
        np.testing.assert_array_equal(other.qvel, data.qvel)


def test_every_key_is_documented():
    page = (Path(__file__).parents[3] / 'doc' / 'foil.md').read_text(encoding='utf-8')
    for key in native().plugin_keys('fluid_sim.foil'):
        assert f'`{key}`' in page
