# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Every axis in every message, for motions whose signs are written by hand."""

import math

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.mavlink.ardupilot.json_packets import write_state
from fluid_sim_ros.mavlink.ardupilot.json_state import StateReader
from fluid_sim_ros.mavlink.mapping import load_mapping
from fluid_sim_ros.mavlink.px4.hil_messages import HilWriter
from fluid_sim_ros.mavlink.px4.hil_state import HilState
from fluid_sim_ros.mavlink.sticks import Sticks
from test.support.autopilots import hil_wire
from test.support.autopilots.autopilot_peers import BridgedFlight
from test.support.autopilots.json_reader import JsonReader

#: Heading north, level: east, north, up of the nose and so on.
NORTH = np.array([math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)])
#: Small turn [rad] of the attitudes, and all speeds [m/s] and rates [rad/s].
ANGLE, SPEED = 0.2, 1.0

# Motion -> (turn about the body's x, y, z (FLU), velocity (ENU), rates (FLU), push (FLU) [m/s^2])
STILL = (0, 0, 0)
CASES = {
    'level': (STILL, STILL, STILL, STILL),
    'rolled right': ((ANGLE, 0, 0), STILL, STILL, STILL),
    'pitched up': ((0, -ANGLE, 0), STILL, STILL, STILL),
    'yawed right': ((0, 0, -ANGLE), STILL, STILL, STILL),
    'rolling right': (STILL, STILL, (SPEED, 0, 0), STILL),
    'pitching up': (STILL, STILL, (0, -SPEED, 0), STILL),
    'yawing right': (STILL, STILL, (0, 0, -SPEED), STILL),
    'going north': (STILL, (0, SPEED, 0), STILL, STILL),
    'going east': (STILL, (SPEED, 0, 0), STILL, STILL),
    'going up': (STILL, (0, 0, SPEED), STILL, STILL),
    'pushed ahead': (STILL, STILL, STILL, (5, 0, 0)),
    'pushed to the right': (STILL, STILL, STILL, (0, -5, 0)),
    'pushed up': (STILL, STILL, STILL, (0, 0, 5)),
}
# Motion -> roll, pitch, yaw; rates about forward, right, down; velocity north, east, down
EXPECTED = {
    'level': ((0, 0, 0), (0, 0, 0), (0, 0, 0)),
    'rolled right': ((ANGLE, 0, 0), (0, 0, 0), (0, 0, 0)),
    'pitched up': ((0, ANGLE, 0), (0, 0, 0), (0, 0, 0)),
    'yawed right': ((0, 0, ANGLE), (0, 0, 0), (0, 0, 0)),
    'rolling right': ((0, 0, 0), (1, 0, 0), (0, 0, 0)),
    'pitching up': ((0, 0, 0), (0, 1, 0), (0, 0, 0)),
    'yawing right': ((0, 0, 0), (0, 0, 1), (0, 0, 0)),
    'going north': ((0, 0, 0), (0, 0, 0), (1, 0, 0)),
    'going east': ((0, 0, 0), (0, 0, 0), (0, 1, 0)),
    'going up': ((0, 0, 0), (0, 0, 0), (0, 0, -1)),
    'pushed ahead': ((0, 0, 0), (0, 0, 0), (0, 0, 0)),
    'pushed to the right': ((0, 0, 0), (0, 0, 0), (0, 0, 0)),
    'pushed up': ((0, 0, 0), (0, 0, 0), (0, 0, 0)),
}
# Specific force forward, right, down [m/s^2] in free fall but for the push
FORCE = {'pushed ahead': (5, 0, 0), 'pushed to the right': (0, 5, 0), 'pushed up': (0, 0, -5)}
#: Earth's field at Zurich [G] north, east, down
FIELD = (0.2142, 0.0090, 0.4297)


def placed(scene, case, height):
    """Return a simulation of a vehicle in a state, at step 2, and its mass."""
    turn, velocity_w, rates_b, push_b = (np.array(part, dtype=float) for part in CASES[case])
    simulation = Simulation(scene)
    simulation.step(2)
    data, (vehicle,) = simulation.data, simulation.vehicles.values()
    data.qpos[:3] = (20.0, 10.0, height)  # east, north, up
    quat = NORTH.copy()
    mujoco.mju_quatIntegrate(quat, turn, 1.0)
    data.qpos[3:7], data.qvel[:3], data.qvel[3:6] = quat, velocity_w, rates_b
    data.act[:] = 0
    data.ctrl[:] = 0
    mass = float(simulation.model.body_mass[vehicle.body_id])
    mujoco.mju_rotVecQuat(data.qfrc_applied[:3], mass * push_b, quat)
    return simulation


def messages(scene, case, height):
    """Return the newest of each PX4 message; those of the first exchange, and of the 25th."""
    simulation = placed(scene, case, height)
    (vehicle,) = simulation.vehicles
    file, _ = load_mapping('px4', vehicle)
    state, codec = HilState(simulation, vehicle, file, Sticks((), 0.0)), HilWriter()
    found = {}
    for step in (2, 4, 6, 50, 56):  # the magnetometer is due at 6, the receiver's fix of 50 at 56
        simulation._step = step
        decoded, _ = hil_wire.frames(state.messages(codec, 2000 * step))
        for name, fields in decoded:
            mag = name == 'HIL_SENSOR' and fields['fields_updated'] & 0x1C0
            found['mag' if mag else name] = fields
    return found


def turned_by(quat_wxyz):
    w, x, y, z = quat_wxyz
    return (
        math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        math.asin(2 * (w * y - z * x)),
        math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    )


@pytest.mark.parametrize('case', CASES)
def test_px4_in_the_air(case):
    angles, rates, velocity = EXPECTED[case]
    found = messages('x500', case, 30.0)
    sensor, mag, gps = found['HIL_SENSOR'], found['mag'], found['HIL_GPS']
    gyro = [sensor['xgyro'], sensor['ygyro'], sensor['zgyro']]
    assert gyro == pytest.approx(rates, abs=0.05)
    force = [sensor['xacc'], sensor['yacc'], sensor['zacc']]
    if not any(velocity) and not any(rates):  # without drag
        assert force == pytest.approx(FORCE.get(case, (0, 0, 0)), abs=0.3)
    ned = np.array(FIELD)
    if angles == (0, 0, 0):  # nose to the north: the body's axes are north, east, down
        assert [mag['xmag'], mag['ymag'], mag['zmag']] == pytest.approx(ned, abs=0.02)
    if case == 'yawed right':  # the field seems to turn left
        assert mag['ymag'] == pytest.approx(-math.sin(ANGLE) * ned[0], abs=0.02)
    if case == 'pitched up':  # the downward field is seen from behind
        assert mag['xmag'] == pytest.approx(
            math.cos(ANGLE) * ned[0] - math.sin(ANGLE) * ned[2], abs=0.02
        )
    if case == 'rolled right':
        assert mag['ymag'] == pytest.approx(math.sin(ANGLE) * ned[2], abs=0.03)
    assert [gps['vn'], gps['ve'], gps['vd']] == pytest.approx([100 * v for v in velocity], abs=40)
    assert gps['lat'] > 473977420 and gps['lon'] > 85455940  # 10 m north, 20 m east
    assert gps['alt'] == pytest.approx(30e3, abs=10e3)
    truth = found['HIL_STATE_QUATERNION']
    assert turned_by(truth['attitude_quaternion']) == pytest.approx(angles, abs=1e-6)
    spins = [truth['rollspeed'], truth['pitchspeed'], truth['yawspeed']]
    assert spins == pytest.approx(rates, abs=1e-6)
    assert [truth['vx'], truth['vy'], truth['vz']] == [100 * v for v in velocity]
    assert truth['lat'] == pytest.approx(473977420 + 899, abs=30)
    assert truth['lon'] == pytest.approx(85455940 + 2654, abs=60)
    assert truth['alt'] == 30000
    if case in FORCE:  # and falling
        pushed = np.add(FORCE[case], (0, 0, 9.81))
        assert [truth[key] for key in ('xacc', 'yacc', 'zacc')] == pytest.approx(
            1000 * pushed, abs=200
        )


@pytest.mark.parametrize('case', CASES)
def test_px4_under_water(case):
    angles, rates, velocity = EXPECTED[case]
    found = messages('bluerov2_heavy', case, -5.0)
    seen = found['ODOMETRY']
    assert (seen['frame_id'], seen['child_frame_id'], seen['estimator_type']) == (1, 12, 2)
    assert [seen['x'], seen['y'], seen['z']] == pytest.approx([10, 20, 5])  # north, east, down
    assert turned_by(seen['q']) == pytest.approx(angles, abs=1e-6)
    # forward, right, down are north, east, down where it moves
    assert [seen['vx'], seen['vy'], seen['vz']] == pytest.approx(velocity, abs=1e-6)
    spins = [seen['rollspeed'], seen['pitchspeed'], seen['yawspeed']]
    assert spins == pytest.approx(rates, abs=1e-6)
    assert seen['pose_covariance'][0] > 0 and seen['velocity_covariance'][20] > 0
    assert 'HIL_GPS' not in found


@pytest.mark.parametrize('case', CASES)
def test_ardupilot(case):
    angles, rates, velocity = EXPECTED[case]
    flight = BridgedFlight('x500', 'ardupilot')
    flight.bridge.close()
    flight.simulation.step(2)
    source = placed('x500', case, 30.0).data
    data = flight.simulation.data
    for field in ('qpos', 'qvel', 'act', 'ctrl', 'qfrc_applied'):
        getattr(data, field)[:] = getattr(source, field)
    flight.simulation.model.opt.wind[:] = (3.0, 2.0, 0.0)  # to the east and north
    reader = StateReader(flight.simulation, 'x500', Sticks((), 0.0), None)
    read = JsonReader().read(write_state(reader.read(1.0)))
    assert read['attitude'] == pytest.approx(angles, abs=1e-6)
    assert turned_by(read['quaternion']) == pytest.approx(angles, abs=1e-6)
    assert read['gyro'] == pytest.approx(rates, abs=1e-6)
    assert read['velocity'] == pytest.approx(velocity, abs=1e-6)
    assert read['position'] == pytest.approx([10, 20, -30])
    assert read['velocity_wind'] == pytest.approx([2, 3, 0])
    if case == 'level':  # the wind comes from behind and from the left
        assert read['direction'] == [pytest.approx(math.atan2(-3, -2))]
        assert read['speed'] == [pytest.approx(math.hypot(2, 3))]
    if case in FORCE:
        assert read['accel_body'] == pytest.approx(FORCE[case], abs=0.6)  # the wind drags
