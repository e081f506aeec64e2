# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Where a flight takes place: home by option, heading, and the Earth as PX4 projects it."""

import contextlib
import json
import math
import threading

import numpy as np
import pytest

from fluid_sim_ros import Simulation
from fluid_sim_ros.cli import main
from fluid_sim_ros.cli.home import turn_to
from fluid_sim_ros.mavlink.px4.sphere import SphereFrame
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from fluid_sim_ros.schema.scene import Home
from fluid_sim_ros.sensors.geodesy import LocalFrame
from test.support.autopilots.autopilot_peers import free_port
from test.support.autopilots.px4_pilots import angles
from test.support.autopilots.px4_stand_in import Px4

CMAC = ('-35.363262', '149.165237', '584', '353')


def px4_metres(place, home):
    """Return north and east [m] by PX4's own projection (lib/geo, MapProjection::project)."""
    lat, lon = map(math.radians, place[:2])
    lat0, lon0 = math.radians(home.latitude), math.radians(home.longitude)
    share = math.sin(lat0) * math.sin(lat) + math.cos(lat0) * math.cos(lat) * math.cos(lon - lon0)
    angle = math.acos(min(1.0, share))
    scale = 6371000.0 * (angle / math.sin(angle) if angle else 1.0)
    north = math.cos(lat0) * math.sin(lat)
    north -= math.sin(lat0) * math.cos(lat) * math.cos(lon - lon0)
    return scale * north, scale * math.cos(lat) * math.sin(lon - lon0)


@pytest.mark.parametrize('place', [(1000.0, 0.0), (0.0, 1000.0), (-700.0, 2000.0)])
def test_on_its_own_sphere_px4_finds_the_metres_of_the_simulation(place):
    home, (east, north) = Home(), place
    sphere = px4_metres(SphereFrame(home).geodetic(east, north, 5.0), home)
    assert sphere == pytest.approx((north, east), abs=0.01)
    assert SphereFrame(home).geodetic(east, north, 5.0)[2] == home.altitude + 5.0
    ellipsoid = px4_metres(LocalFrame(home).geodetic(east, north, 5.0), home)
    if east:  # 0.3 % less
        assert ellipsoid[1] / east == pytest.approx(0.997, abs=0.001)


def test_home_and_heading_reach_px4_and_the_log(tmp_path, capsys):
    log, port, seen = tmp_path / 'flight.mcap', free_port('px4'), {}

    def fly():
        px4 = Px4(port, silent=0)
        px4.latest = seen
        with contextlib.suppress(AssertionError, OSError):  # until the run ends
            while True:
                px4.exchange([0.85] * 4)
        px4.close()

    autopilot = threading.Thread(target=fly)
    autopilot.start()
    arguments = ['run', 'x500_ground', '--autopilot', 'px4', '--port', str(port), '--home', *CMAC,
                 '--duration', '0.4', '--record', str(log), '--json', '-']  # fmt: skip
    assert main(arguments) == 0
    autopilot.join()
    json.loads(capsys.readouterr().out)
    truth = seen['HIL_STATE_QUATERNION']
    assert math.degrees(angles(truth['attitude_quaternion'])[2]) % 360 == pytest.approx(353)
    assert truth['lat'] == pytest.approx(-353632620, abs=100)
    assert truth['lon'] == pytest.approx(1491652370, abs=100)
    assert truth['alt'] == pytest.approx(584130, abs=1000)
    assert resimulate(open_log(log)).difference is None


def test_a_moving_vehicle_turns_with_its_velocity():
    simulation = Simulation('aerosonde')  # eastward, 25 m/s
    before = simulation.data.qvel[:6].copy()
    turn_to(simulation, 0.0)
    after = simulation.data.qvel[:6]
    assert after[:2] == pytest.approx([-before[1], before[0]], abs=0.01)
    assert np.array_equal(after[3:], before[3:])
    turn_to(simulation, 90.0)
    assert simulation.data.qvel[:6] == pytest.approx(before, abs=0.02)


@pytest.mark.parametrize(
    ('home', 'line'),
    [
        (('95', '0', '0', '0'), "--home: key 'latitude'"),
        (('0', '0', '0', 'nan'), '--home: heading nan: must be finite'),
    ],
)
def test_a_home_that_is_none_is_refused(home, line, capsys):
    arguments = ['run', 'x500_ground', '--autopilot', 'px4', '--port', str(free_port('px4'))]
    assert main([*arguments, '--home', *home]) == 2
    assert line in capsys.readouterr().err
