"""Markers stand where MuJoCo has the geoms, and their arrows show the forces."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.marker_topics import MARKERS
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.recording.decode import fields
from fluid_sim_ros.scene.vehicle import weight_in_air


def shown(simulation, vehicle, **settings):
    """Return the fields of a vehicle's markers, and the topic."""
    states = StateTopics(simulation, DEFAULTS | settings)
    topic = next(t for t in states.topics if t.name == f'{vehicle}/markers')
    states.take_state()
    return fields(definition(MARKERS).text, states.data(topic)), topic


def numbers(found, name, parts):
    return np.array([found[f'{name}.{part}'] for part in parts])


@pytest.mark.parametrize(('scene', 'vehicle'), [('x500', 'x500'), ('fish', 'fish')])
def test_geoms_stand_where_mujoco_has_them(scene, vehicle):
    simulation = Simulation(scene)
    simulation.step(150)
    found, _ = shown(simulation, vehicle)
    data = simulation.observed
    count = sum(name.endswith('.ns') for name in found)
    drawn = [i for i in range(count) if found[f'markers[{i}].ns'] == f'{vehicle}/geoms']
    assert len(drawn) == count - 2 > 3
    for i in drawn:
        geom, marker = found[f'markers[{i}].id'], f'markers[{i}].pose'
        position = numbers(found, f'{marker}.position', 'xyz')
        np.testing.assert_allclose(position, data.geom_xpos[geom], atol=1e-6)
        rotation = np.empty(9)
        mujoco.mju_quat2Mat(rotation, numbers(found, f'{marker}.orientation', 'wxyz'))
        np.testing.assert_allclose(rotation, data.geom_xmat[geom], atol=1e-6)


def test_an_arrow_as_long_as_a_metre_is_the_weight():
    simulation = Simulation('x500')
    simulation.step(150)
    found, _ = shown(simulation, 'x500')
    arrow = next(name.removesuffix('.text') for name, value in found.items() if value == 'thrust')
    begin, end = (numbers(found, f'{arrow}.points[{i}]', 'xyz') for i in (0, 1))
    force = np.linalg.norm(simulation.observe(forces=True)[0][nat.THRUST][:3])
    weight = weight_in_air(simulation.model, simulation.vehicles['x500'].body_id)
    assert np.linalg.norm(end - begin) == pytest.approx(force / weight, rel=1e-5)


@pytest.mark.parametrize(
    ('rate', 'timestep', 'steps'), [(20, 0.002, 25), (20, 0.008, 7), (100, 0.02, 1)]
)
def test_the_rate_is_an_upper_limit_in_whole_steps(rate, timestep, steps):
    rates = {name: 1 / timestep for name in DEFAULTS if name.endswith('.rate')}
    simulation = Simulation('sphere', timestep=timestep)
    _, topic = shown(simulation, 'sphere', **(rates | {'markers.rate': rate}))
    assert topic.period == steps
