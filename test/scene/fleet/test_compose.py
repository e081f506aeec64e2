# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Composed models: every vehicle is what it is alone, in the fluid and at the place stated."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.hold import Hold
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.resources import models_folder
from fluid_sim_ros.sensors import SensorSuite

MODELS = sorted(path.stem for path in models_folder().glob('*.xml'))
_BODY = ('mass', 'inertia', 'ipos', 'iquat', 'gravcomp', 'simple')
_ACTUATOR = (
    'gear', 'ctrlrange', 'ctrllimited', 'forcerange', 'gainprm', 'biasprm', 'dynprm', 'actnum',
)  # fmt: skip
_JOINT = ('type', 'range', 'stiffness', 'limited', 'axis')


@pytest.fixture
def write(tmp_path):
    def file(text):
        path = tmp_path / 'fleet.yaml'
        path.write_text(text)
        return path

    return file


def _moving(model):
    return [body for body in range(model.nbody) if model.body_treeid[body] >= 0]


@pytest.mark.parametrize('name', MODELS)
def test_a_model_in_a_fleet_is_the_model_alone(write, name):
    path = write(f'vehicles: {{a: {{model: {name}}}, b: {{model: {name}, position: [50, 0]}}}}')
    fleet, alone = Simulation(path), Simulation(name)
    one, both = alone.model, fleet.model
    assert (both.nq, both.nv, both.na, both.nu) == tuple(
        2 * getattr(one, n) for n in ('nq', 'nv', 'na', 'nu')
    )
    count = len(_moving(one))
    assert len(_moving(both)) == 2 * count
    for b in (0, 1):
        part = _moving(both)[b * count : (b + 1) * count]
        for field in _BODY:
            of_one = getattr(one, f'body_{field}')[_moving(one)]
            np.testing.assert_array_equal(getattr(both, f'body_{field}')[part], of_one)
        for kind, fields, size in (('actuator', _ACTUATOR, one.nu), ('jnt', _JOINT, one.njnt)):
            for field in fields:
                of_both = getattr(both, f'{kind}_{field}')[b * size : (b + 1) * size]
                np.testing.assert_array_equal(of_both, getattr(one, f'{kind}_{field}'))
    ((name_alone, vehicle),) = alone.vehicles.items()
    for member in fleet.vehicles.values():
        assert (member.thrusters, member.joints) == (vehicle.thrusters, vehicle.joints)
        assert fleet.terms[member.name] == alone.terms[name_alone]


class _Commands:
    """Keeps what each vehicle was told every 5 steps."""

    period = 5

    def __init__(self, simulation):
        self.kept = []
        self._vehicles = simulation.vehicles

    def write(self, simulation):
        control = simulation.data.ctrl
        self.kept.append({n: control[v.thruster_ids].copy() for n, v in self._vehicles.items()})


def test_the_fleet_of_four_flies_to_the_bits_of_four_single_flights():
    fleet = Simulation('fleet_x500')
    begins = {n: fleet.data.qpos[v.qpos_address :][:7].copy() for n, v in fleet.vehicles.items()}
    commands = _Commands(fleet)
    runner = Runner(fleet, NoSource(), [Hold(fleet), commands], Pacing())
    runner.run(until=250)
    fleet.set_wind([5.0, -3.0, 1.0])  # the schedule has another one, later
    runner.run(until=2000)
    assert len(begins) == 4
    for name, vehicle in fleet.vehicles.items():
        single = Simulation('x500')
        single.data.qpos[:] = begins[name]
        for i, told in enumerate(commands.kept[:-1]):
            if i == 50:
                single.set_wind([5.0, -3.0, 1.0])
            single.set_thrust('x500', told[name])
            single.step(5)
        q, v = vehicle.qpos_address, vehicle.dof_address
        assert abs(single.data.qpos - begins[name]).max() > 1e-3  # the gust was felt
        np.testing.assert_array_equal(fleet.data.qpos[q : q + 7], single.data.qpos)
        np.testing.assert_array_equal(fleet.data.qvel[v : v + 6], single.data.qvel)


def test_in_a_mixed_fleet_each_vehicle_meets_its_own_fluid():
    fleet = Simulation('fleet_mixed')
    assert fleet.streams == ('wind', 'current')
    assert 'buoyancy' in fleet.terms['rov'] and 'damping' in fleet.terms['rov']
    assert set(fleet.terms['one']) == {'drag', 'viscous'} == set(fleet.terms['two'])
    fleet.set_wind([5.0, 0.0, 0.0])
    fleet.step(500)
    # the same law in the same air: MuJoCo's own forces by its options
    alone = Simulation('x500')
    alone.model.opt.density, alone.model.opt.viscosity = 1.204, 1.81e-5
    one = fleet.vehicles['one']
    alone.data.qpos[:] = fleet.data.qpos[one.qpos_address :][:7]
    alone.data.qvel[:] = fleet.data.qvel[one.dof_address :][:6]
    alone.set_wind(fleet.observe(forces=True)[0][nat.MEDIUM_VELOCITY])
    ours, stock = (s.observe(forces=True)[0][nat.TOTAL].copy() for s in (fleet, alone))
    assert abs(stock).max() > 0.1
    np.testing.assert_allclose(ours, stock, rtol=1e-9, atol=1e-12)
    with pytest.raises(ConfigError, match="fluid 'inertia' knows one fluid everywhere"):
        Simulation('fleet_mixed', fluid='inertia')
    assert Simulation('fleet_mixed', fluid='none').vehicles


def test_place_heading_and_keyframe_of_a_vehicle(write):
    simulation = Simulation(write(
        'vehicles: {a: {model: aerosonde, position: [100, 0], yaw: 90, keyframe: level}, '
        'b: {model: aerosonde, position: [0, 0, 50], yaw: -45}}'
    ))  # fmt: skip
    alone = Simulation('aerosonde')
    a, b = simulation.snapshot().vehicles.values()
    own = alone.snapshot().vehicles['aerosonde']
    np.testing.assert_array_equal(a.position_w[:2], [100.0, 0.0])
    assert a.position_w[2] == own.position_w[2]  # that of the keyframe
    np.testing.assert_allclose(a.velocity_b, own.velocity_b, atol=1e-12)  # it turns with it
    np.testing.assert_allclose(b.quat_wb_wxyz, [np.cos(np.pi / 8), 0, 0, -np.sin(np.pi / 8)])
    np.testing.assert_array_equal(b.position_w, [0.0, 0.0, 50.0])
    assert not b.velocity_b.any()
    controls = {n: simulation.data.ctrl[v.thruster_ids] for n, v in simulation.vehicles.items()}
    assert controls['a'] == alone.data.ctrl[alone.vehicles['aerosonde'].thruster_ids] > 0
    assert controls['b'] == 0


def test_a_keyframe_of_a_model_puts_its_vehicles_there_and_the_others_to_their_start():
    simulation = Simulation('fleet_mixed')
    simulation.reset('ground')
    heights = {n: s.position_w[2] for n, s in simulation.snapshot().vehicles.items()}
    assert heights == {'one': 0.13, 'two': 0.13, 'rov': -2.0}
    assert simulation.snapshot().vehicles['one'].position_w[0] == -2.0
    simulation.reset()
    assert simulation.snapshot().vehicles['one'].position_w[2] == 2.0


def test_one_line_makes_fifty_on_a_grid():
    simulation = Simulation('fleet_swarm')
    assert list(simulation.vehicles) == [f'swarm_{i}' for i in range(1, 51)]
    places = np.array([s.position_w for s in simulation.snapshot().vehicles.values()])
    np.testing.assert_array_equal(places[:9, 0], [0, 3, 6, 9, 12, 15, 18, 21, 0])
    np.testing.assert_array_equal(places[7:9, 1], [0, 3])
    assert simulation.model.ntex < 10  # looks are shared


TWO_PARTS = """
<mujoco>
  <compiler angle="radian"/>
  <option density="1.2"/>
  <worldbody>
    <geom type="plane" size="5 5 .1"/>
    <body name="tug" pos="0 0 1"><freejoint/><geom name="g" size=".1"/>
      <body pos=".2 0 0"><joint name="fin" axis="0 0 1" range="-.5 .5"/><geom size=".05"/></body>
    </body>
    <body name="barge" pos="1 0 1"><freejoint/><geom size=".1"/>
      <site name="s"/><site name="t" pos=".1 0 0"/>
    </body>
  </worldbody>
  <contact><exclude body1="tug" body2="barge"/></contact>
  <equality><connect body1="tug" body2="barge" anchor=".5 0 0"/></equality>
  <tendon><spatial name="rope" range="0 2"><site site="s"/><site site="t"/></spatial></tendon>
  <actuator><position name="fin" joint="fin" kp="1"/></actuator>
  <sensor><jointpos name="angle" joint="fin"/></sensor>
  <keyframe><key name="k" qpos="0 0 3 1 0 0 0 .1 1 0 3 1 0 0 0"/></keyframe>
</mujoco>
"""


def test_what_belongs_to_a_model_comes_with_it(write, tmp_path):
    (tmp_path / 'tug.xml').write_text(TWO_PARTS)
    entry = 'model: tug.xml, vehicle: {body: tug}, keyframe: k'
    simulation = Simulation(write(
        f'vehicles: {{a: {{{entry}}}, b: {{{entry}, position: [0, 4], yaw: 90}}}}'
    ))  # fmt: skip
    model = simulation.model
    assert (model.nexclude, model.neq, model.ntendon, model.nsensor) == (2, 2, 2, 2)
    np.testing.assert_array_equal(model.joint('b/fin').range, [-0.5, 0.5])
    assert simulation.vehicles['b'].joints == ('fin',)
    barge = simulation.data.qpos[model.jnt_qposadr[model.body_jntadr[model.body('b/barge').id]] :]
    np.testing.assert_allclose(barge[:3], [0, 5, 3], atol=1e-12)  # beside the tug, turned with it
    assert simulation.data.ctrl[model.actuator('a/fin').id] == 0.0
    assert simulation.data.qpos[model.joint('b/fin').qposadr[0]] == 0.1


def test_sensors_find_their_sites_and_differ_by_vehicle():
    simulation = Simulation('fleet_x500', seed=3)
    readings = []
    for name in ('one', 'two'):
        suite = SensorSuite(simulation, name)
        suite.update()
        readings.append(suite.imu.specific_force.copy())
    assert not np.array_equal(*readings)
    assert abs(readings[0][2] - 9.81) < 0.5


def test_the_world_is_that_of_the_model_with_most_of_one(write):
    text = 'vehicles: {one: {model: x500, position: [0, 0, 2]}, two: {model: bluerov2}}'
    assert Scene.load(write(text)).model_path.stem == 'bluerov2'
    simulation = Simulation(write(text))
    names = [simulation.model.geom(i).name for i in range(simulation.model.ngeom)]
    assert 'bed' in names and 'ground' not in names
    lake = Simulation(write(f'{text}\nworld: amphibious\ntimestep: 0.002'))
    assert list(lake.vehicles) == ['one', 'two']
    model = lake.model
    assert mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, 'amphibious') < 0
