# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
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


def test_a_slung_load_and_its_cord_are_drawn():
    simulation = Simulation('x500_slung_load')
    simulation.step(200)
    found, _ = shown(simulation, 'x500')
    model, data = simulation.model, simulation.observed
    load = model.geom('load').id
    place = next(
        name.removesuffix('.id') for name, value in found.items()
        if name.endswith('.id') and value == load and found[name[:-3] + '.ns'] == 'x500/geoms'
    )  # fmt: skip
    position = numbers(found, f'{place}.pose.position', 'xyz')
    np.testing.assert_allclose(position, data.geom_xpos[load], atol=1e-6)
    cord = next(name.removesuffix('.ns') for name, value in found.items() if value == 'x500/cords')
    assert found[f'{cord}.type'] == 4  # LINE_STRIP
    assert found[f'{cord}.pose.orientation.w'] == 1.0
    for i, site in enumerate(('hook', 'eye')):
        point = numbers(found, f'{cord}.points[{i}]', 'xyz')
        np.testing.assert_allclose(point, data.site(site).xpos, atol=1e-6)


def test_every_segment_of_a_tether_is_drawn():
    simulation = Simulation('bluerov2_tether')
    simulation.step(100)
    found, _ = shown(simulation, 'bluerov2')
    model = simulation.model
    drawn = {found[name] for name in found if name.endswith('.id')}
    segments = [
        geom for geom in range(model.ngeom)
        if model.body(model.geom_bodyid[geom]).name.startswith('tether_')
    ]  # fmt: skip
    assert len(segments) >= 16
    assert set(segments) <= drawn


def test_what_is_tied_to_one_vehicle_of_a_fleet_is_drawn_with_that_one(tmp_path):
    path = tmp_path / 'pair.yaml'
    path.write_text("""vehicles:
  one: {model: x500_slung_load, vehicle: x500, keyframe: hover}
  two: {model: x500, position: [5, 0, 2], keyframe: hover}
timestep: 0.002
""")
    simulation = Simulation(path)
    one, _ = shown(simulation, 'one')
    two, _ = shown(simulation, 'two')
    assert 'one/cords' in one.values()
    load = simulation.model.geom('one/load').id
    assert load in [v for k, v in one.items() if k.endswith('.id')]
    assert not any(str(value).endswith('/cords') for value in two.values())
    assert load not in [v for k, v in two.items() if k.endswith('.id')]
