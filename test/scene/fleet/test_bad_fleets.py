# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Scene files of several vehicles with a fault: one line with the file, the key and a remedy."""

import pytest

from fluid_sim_ros import Scene, Simulation
from fluid_sim_ros.errors import FluidSimError

#: A boat of one geom in water, by MuJoCo's own drag, with a motor.
BOAT = """
<mujoco>
  <option density="1000" viscosity="1e-3" timestep="0.002" integrator="implicitfast"/>
  <worldbody>
    <body name="boat"><freejoint/>
      <geom name="hull" type="sphere" size=".3" mass="100"/><site name="s1"/>
    </body>
  </worldbody>
  <actuator><motor name="m1" site="s1" gear="0 0 1 0 0 0"/></actuator>
  <keyframe><key name="deep" qpos="0 0 -5 1 0 0 0"/></keyframe>
</mujoco>
"""
TWO = '{one: {model: x500, position: [0, 0, 2]}, two: {model: x500, position: [3, 0, 2]}}'


@pytest.fixture
def write(tmp_path):
    (tmp_path / 'boat.xml').write_text(BOAT)
    (tmp_path / 'gone.xml').write_text(
        '<mujoco><asset><mesh name="m" file="gone.stl"/></asset><worldbody><body name="b">'
        '<freejoint/><geom type="mesh" mesh="m"/></body></worldbody></mujoco>'
    )
    (tmp_path / 'still.xml').write_text(BOAT.replace('<freejoint/>', ''))
    bare = (
        '<mujoco><worldbody><body name="boat"><freejoint/><inertial pos="0 0 0" mass="{}" '
        'diaginertia="{}"/></body></worldbody></mujoco>'
    )
    (tmp_path / 'light.xml').write_text(bare.format(-1, '1 1 1'))
    (tmp_path / 'flat.xml').write_text(bare.format(1, '.3 .4 1'))
    (tmp_path / 'fast.xml').write_text(BOAT.replace('timestep="0.002"', 'timestep="0.001"'))
    (tmp_path / 'rk4.xml').write_text(BOAT.replace('implicitfast', 'RK4'))
    (tmp_path / 'moon.xml').write_text(BOAT.replace('<option', '<option gravity="0 0 -1.62"'))
    (tmp_path / 'salt.xml').write_text(BOAT.replace('density="1000"', 'density="1025"'))
    two = '<body name="b"><freejoint/><geom size=".1"/></body></worldbody>'
    pair = BOAT.replace('</worldbody>', two).replace('<motor name="m1" site="s1" ', '<motor ')
    pair = pair.replace('<motor gear="0 0 1 0 0 0"/>', '')
    (tmp_path / 'pair.xml').write_text(pair)

    def file(text):
        path = tmp_path / 'fleet.yaml'
        path.write_text(text)
        return path

    return file


@pytest.mark.parametrize(
    ('text', 'line'),
    [
        ('vehicles: {}', "missing key 'model', or vehicles with a model each: vehicles: .one"),
        (
            'model: x500\nvehicles: {one: {model: x500}}',
            r"key 'vehicles\.one\.model': the scene has a model of its own; leave out 'model'",
        ),
        ('vehicles: {one: {model: still.xml}}', "moves by itself in the model 'still'; give its"),
        ('vehicles: {one: {model: x50}}', r"'vehicles\.one\.model'.*no model 'x50'; did you mean"),
        (
            'vehicles: {one: {model: x500, positon: [0, 0, 1]}}',
            r'vehicles\.one\.positon.*position',
        ),
        (
            'vehicles: {one: {model: x500}, two: {vehicle: x500}}',
            r"missing key 'vehicles\.two\.mod",
        ),
        ('vehicles: {one: {model: x500, position: [1]}}', r"key 'vehicles\.one\.position'"),
        ('vehicles: {one: {model: x500, yaw: .nan}}', r"key 'vehicles\.one\.yaw': must be finite"),
        ('vehicles: {1x: {model: x500}}', 'letters, digits and _ only, a letter first .got .1x'),
        ('vehicles: {one: {model: x500}, one: {model: x500}}', "key 'one' stands twice"),
        (
            'vehicles: {a: {model: x500, count: 2, spacing: 2}, a_2: {model: x500}}',
            "the name 'a_2' stands twice; choose another",
        ),
        ('vehicles: {a: {model: x500, count: 3}}', 'count and spacing .m. go together'),
        ('vehicles: {a: {model: x500, count: 100000, spacing: 1}}', 'limit fleet_vehicles = 1000'),
        ('vehicles: {one: {model: x500, vehicle: x5000}}', "vehicle file 'x5000' is not known"),
        ('vehicles: {one: {model: pair.xml}}', r'has 2 moving bodies .*boat, b.*vehicle: \{body:'),
        (f'world: nowhere\nvehicles: {TWO}', "key 'world': no model 'nowhere'"),
        (
            'vehicles: {one: {model: boat.xml}, two: {model: salt.xml}}',
            r"'boat' and 'salt' are in different fluids \(density 1000 .*1025.*'world: boat'",
        ),
        (
            'vehicles: {one: {model: x500, autopilot: px5}}',
            r"vehicles\.one\.autopilot\.protocol.*'px4' or 'ardupilot'",
        ),
    ],
)
def test_a_fault_of_the_file_is_one_line(write, text, line):
    with pytest.raises(FluidSimError, match=line) as caught:
        Scene.load(write(text))
    assert '\n' not in str(caught.value)
    assert 'fleet.yaml' in str(caught.value) or 'limit' in str(caught.value)


@pytest.mark.parametrize(
    ('text', 'line'),
    [
        ('vehicles: {one: {model: light.xml}}', "'boat'.*; give it a mass above 0 .kg.: mass or"),
        ('vehicles: {one: {model: flat.xml}}', "'boat'.*; no body has such moments: the two smal"),
        (
            'vehicles: {a: {model: x500, position: [0, 0, 2]}, '
            'b: {model: x500, position: [0.3, 0, 2]}}',
            r"'a' and 'b' overlap by 0\.1 m where they begin; move one",
        ),
        (
            'vehicles: {a: {model: kirchhoff}, b: {model: kirchhoff}}',
            r"'a' and 'b' begin at the same place \(0\.0, 0\.0, 0\.0\) m; move one",
        ),
        ('vehicles: {a: {model: gone.xml}}', r'gone\.xml: .*gone\.stl'),
        (
            'vehicles: {a: {model: x500, keyframe: hoover}}',
            "'hoover' .*did you mean 'hover'.* has",
        ),
        (
            'vehicles: {a: {model: x500, vehicle: {body: m1}}}',
            "body 'm1' is none that moves.* x500",
        ),
        (
            'vehicles: {a: {model: boat.xml}, b: {model: fast.xml, position: [3, 0]}}',
            r"'fast' has the timestep 0\.001 s, the world 0\.002 s; state 'timestep'",
        ),
        (
            'vehicles: {a: {model: boat.xml}, b: {model: rk4.xml, position: [3, 0]}}',
            "'rk4' has the integrator rk4, the world implicitfast; state 'integrator'",
        ),
        (
            'vehicles: {a: {model: boat.xml}, b: {model: moon.xml, position: [3, 0]}}',
            r"'moon' has another gravity than the world: .*-1\.62",
        ),
        (
            'vehicles: {a: {model: x500, autopilot: px4}, b: {model: sphere, position: [9, 0], '
            'autopilot: px4}}\nworld: x500\nintegrator: implicitfast',
            "vehicle 'b': its model 'sphere' has no thrusters.*leave out 'autopilot'",
        ),
    ],
)
def test_models_that_cannot_stand_together_are_one_line(write, text, line):
    with pytest.raises(FluidSimError, match=line) as caught:
        Scene.load(write(text)).compile()
    assert '\n' not in str(caught.value)


def test_what_the_scene_states_settles_timestep_and_integrator(write):
    vehicles = 'a: {model: boat.xml}, b: {model: fast.xml, position: [3, 0]}, '
    vehicles += 'c: {model: rk4.xml, position: [6, 0]}'
    path = write(f'vehicles: {{{vehicles}}}\ntimestep: 0.002\nintegrator: implicitfast')
    assert Simulation(path).timestep == 0.002
    path = write(f'vehicles: {{{vehicles}}}')
    assert Simulation(path, timestep=0.001, integrator='rk4').timestep == 0.001


def test_a_vehicle_that_begins_in_the_ground_is_warned_of(write):
    path = write('vehicles: {a: {model: x500, position: [0, 0, 0]}}')
    lines = Simulation(path).warnings.lines
    assert any(line.startswith("vehicle 'a' begins 0.13 m inside 'ground'") for line in lines)
    path = write('vehicles: {a: {model: x500, keyframe: ground}}')  # its height is the keyframe's
    assert not Simulation(path).warnings.lines
