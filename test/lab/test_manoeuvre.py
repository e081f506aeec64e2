# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What is judged of a scene: up to an impact, and an excitation where nothing moves."""

from dataclasses import replace

import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.lab.advisor.advice import settings, verify
from fluid_sim_ros.lab.advisor.advise import advise
from fluid_sim_ros.lab.charts.measure import measure, time_again
from fluid_sim_ros.lab.excitation import AXES, excitation, excited
from fluid_sim_ros.lab.manoeuvre import judged
from fluid_sim_ros.lab.problems.from_scene import of_scene
from fluid_sim_ros.lab.problems.problem import run_rung
from fluid_sim_ros.schema.scene import ScheduledEvent
from fluid_sim_ros.schema.settings import RunSettings
from test.support.volumes import quick

#: A neutral body that nothing moves, and two spheres that fly into each other.
NEUTRAL = """<mujoco><option timestep="0.005" density="1000" gravity="0 0 0"/><worldbody>
<body name="hull"><freejoint/><geom type="ellipsoid" size=".3 .2 .1" density="1000"
fluidshape="ellipsoid"/></body></worldbody></mujoco>"""
MEETING = """<mujoco><option timestep="0.002" density="1.2" gravity="0 0 0"/><worldbody>
<body name="left"><freejoint/><geom size=".1" fluidshape="ellipsoid"/></body>
<body name="right" pos="1 0 0"><freejoint/><geom size=".1" fluidshape="ellipsoid"/></body>
</worldbody><keyframe><key name="start" qpos="0 0 0 1 0 0 0 1 0 0 1 0 0 0"
qvel="1 0 0 0 0 0 0 0 0 0 0 0"/></keyframe></mujoco>"""


def model(tmp_path, mjcf, name='mine') -> Scene:
    path = tmp_path / f'{name}.xml'
    path.write_text(mjcf)
    return Scene.load(path)


def test_a_manoeuvre_is_judged_until_it_touches_the_ground():
    case = of_scene('x500', 12.0)
    found = judged(case)
    assert found.duration == pytest.approx(11.2)
    assert 'touches the ground at 11.2' in found.note
    found = judged(of_scene('sphere', 1.0))
    assert (found.duration, found.note, found.excitation) == (1.0, '', '')


def test_what_the_schedule_does_later_is_named():
    event = ScheduledEvent(at=11.5, wind=[0, 0, 0])
    scene = Scene.load('x500')
    scene = replace(scene, schedule=(*scene.schedule, event))
    assert judged(of_scene(scene, 12.0)).note.endswith(
        'without what the schedule changes at 11.5 s'
    )


def test_a_vehicle_that_rests_on_the_ground_is_refused():
    with pytest.raises(ConfigError, match=r'rests on the ground throughout.*: x500, x500_turb'):
        advise('x500_ground', 0.01, duration=1.0)


def test_a_vehicle_that_leaves_the_ground_is_judged():
    event = ScheduledEvent(at=0.5, thrust={'x500': [6.5] * 4})
    scene = replace(Scene.load('x500_ground'), schedule=(event,))
    found = judged(of_scene(scene, 1.5))
    assert (found.duration, found.note) == (1.5, '')


def test_an_impact_between_movable_bodies_ends_the_judging(tmp_path):
    """As the ground does: what comes after it is decided by the impact."""
    scene = replace(model(tmp_path, MEETING), keyframe='start')
    found = judged(of_scene(scene, 2.0))
    assert found.duration == pytest.approx(0.8)
    assert found.note.startswith('left and right touch each other at 0.8')
    # links of one vehicle, too; and a load that is held from the start on is no impact
    arm = MEETING.replace('gravity="0 0 0"', '').replace(
        '<body name="right" pos="1 0 0"><freejoint/>',
        '<body name="right" pos="0 0 .205"><freejoint/>',
    )
    dropped = judged(of_scene(model(tmp_path, arm.split('<keyframe>')[0] + '</mujoco>'), 1.0))
    assert dropped.duration == 1.0  # both fall alike
    held = MEETING.split('<keyframe>')[0].replace('pos="1 0 0"', 'pos=".195 0 0"') + '</mujoco>'
    push = ScheduledEvent.model_validate({'at': 0.1, 'wrench': {'left': {'force': [3, 0, 0]}}})
    scene = replace(model(tmp_path, held, 'held'), schedule=(push,))
    assert judged(of_scene(scene, 1.0)).note == ''


def test_an_impact_between_links_ends_the_judging(tmp_path):
    link = """<mujoco><option timestep="0.002" density="1.2" gravity="0 0 0"/><worldbody>
    <body name="base"><freejoint/><geom type="box" size=".2 .2 .05"/>
    <body name="fore" pos=".2 0 .1"><joint axis="0 1 0"/><geom size=".05" pos="0 0 .3"/></body>
    <body name="aft" pos="-.2 0 .1"><joint axis="0 1 0"/><geom size=".05" pos="0 0 .3"/></body>
    </body></worldbody>
    <keyframe><key name="start" qpos="0 0 0 1 0 0 0 0 0" qvel="0 0 0 0 0 0 -1 1"/></keyframe>
    </mujoco>"""
    scene = replace(model(tmp_path, link), keyframe='start')
    found = judged(of_scene(scene, 3.0))
    assert found.duration < 3.0
    assert 'fore and aft touch each other' in found.note


@pytest.mark.parametrize('kind', quick(['neutral', 'quadrotor'], 'neutral'))
def test_advice_never_removes_the_fluid_from_a_scene_at_rest(tmp_path, kind):
    """What a controller is to drive rests by itself: any model would do, even none."""
    scene = model(tmp_path, NEUTRAL)
    if kind == 'quadrotor':
        scene = replace(Scene.load('quadrotor'), name='calm', schedule=())
    found = advise(scene, 0.01, duration=4.0)
    assert found['excitation'].startswith('a ')
    assert "nothing moves in the scene's own manoeuvre" in found['note']
    assert found['choice']['rung'] in ('scene', 'ellipsoid')
    simulation = Simulation(scene, **settings(found))
    set_flow = simulation.set_wind if kind == 'quadrotor' else simulation.set_current
    set_flow([0.5, 0, 0])
    (name,) = simulation.vehicles
    simulation.step()
    force = sum(np.linalg.norm(term[0]) for term in simulation.wrench(name).values())
    assert force > 1e-4
    assert verify(scene, found)['within']


def test_advice_never_removes_a_term_that_acts_in_the_envelope():
    """In its own gust at 1.0 % a Crazyflie could do without air; not when it is flown."""
    found = advise('crazyflie', 0.01, duration=15.0)
    assert found['choice']['rung'] == 'scene'
    (why,) = [row['why'] for row in found['not_tried'] if row['rung'] == 'none']
    assert 'in the envelope of the scene' in why or "the model's own error is" in why


def test_a_poor_model_is_taken_where_it_is_good_enough():
    """Also in the envelope: a Crazyflie to 10 %."""
    assert advise('crazyflie', 0.1, duration=3.0)['choice']['rung'] == 'none'


def test_a_chart_of_a_scene_at_rest_is_excited(tmp_path):
    case = of_scene(model(tmp_path, NEUTRAL), 2.0)
    result = measure(case, integrators=('RK4',), timesteps=(0.02, 0.01), rounds=1)
    assert "nothing moves in the scene's own manoeuvre" in result['note']
    assert result['rungs']['none']['model_error'] > 0.1
    assert time_again(result, case, rounds=1)['note'] == result['note']


def test_the_excitation_is_the_same_each_time_and_within_the_limits():
    for name, axes in (('rov', AXES), ('quadrotor', ('heave', 'roll', 'pitch', 'yaw'))):
        scene = replace(Scene.load(name), schedule=())
        found = excitation(scene, 12.0, 0.1)
        assert found == excitation(scene, 12.0, 0.1)
        assert all(axis in found.words for axis in axes)
        simulation = Simulation(scene)
        (vehicle,) = simulation.vehicles.values()
        low, high = vehicle.thrust_range.T
        thrusts = np.array([e.thrust[vehicle.name] for e in found.events if e.thrust])
        assert np.all(thrusts >= low) and np.all(thrusts <= high)
        assert np.ptp(thrusts, axis=0).min() > 0.05 * (high - low).min()
        start = simulation.data.ctrl[vehicle.thruster_ids]
        # as much backward as forward, and back
        np.testing.assert_allclose(thrusts[0] - start, start - thrusts[1], atol=1e-12)
        np.testing.assert_array_equal(thrusts[2], start)


def test_a_scene_without_a_fluid_has_no_wind_in_its_excitation(tmp_path):
    scene = model(tmp_path, NEUTRAL.replace('density="1000" gravity', 'gravity'))
    words = excitation(scene, 2.0, 0.1).words
    assert words.startswith('doublets of force and torque on surge')
    assert advise(scene, 0.01, duration=1.0)['choice']


def test_a_poorer_model_may_lack_a_medium():
    """At the surface there is wind; a model without the surface has water only."""
    case = of_scene('bluerov2_surface', 2.0)
    moved, words = excited(case)
    assert 'wind' in words
    for name, rung in moved.rungs.items():
        compiled = rung.scene.compile(RunSettings(fluid=rung.fluid))
        winds = [event for event in rung.scene.schedule if event.wind]
        assert bool(winds) is ('wind' in compiled.streams)
        run_rung(replace(moved, duration=0.2), moved.rungs[name], 'implicitfast', 0.01)


def test_the_weather_of_the_scene_stays_in_the_excitation():
    event = ScheduledEvent(at=1.0, current=[0.2, 0, 0], thrust={'bluerov2_heavy': [1.0] * 8})
    found = excitation(replace(Scene.load('rov'), schedule=(event,)), 5.0, 0.1)
    flows = [e for e in found.events if e.current or e.wind]
    assert [(e.at, e.current, e.thrust) for e in flows] == [(1.0, [0.2, 0, 0], {})]
    assert "the scene's own wind and current" in found.words


def test_a_scene_that_nothing_can_move_is_refused(tmp_path):
    stuck = NEUTRAL.replace('<freejoint/>', '<joint axis="0 0 1" armature="1e9"/>')
    path = tmp_path / 'stuck.xml'
    path.write_text(stuck)
    (tmp_path / 'stuck.yaml').write_text(f'model: {path}\nvehicles: {{hull: {{body: hull}}}}\n')
    with pytest.raises(ConfigError, match='stuck: nothing moves in the scene, and'):
        judged(of_scene(str(tmp_path / 'stuck.yaml'), 1.0))
