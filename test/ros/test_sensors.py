# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Sensor topics of the node over real DDS."""

import numpy as np
import pytest
from geometry_msgs.msg import TwistWithCovarianceStamped
from sensor_msgs.msg import FluidPressure, Imu, MagneticField, NavSatFix, Range

from fluid_sim_ros import Simulation
from fluid_sim_ros.sensors import SensorSuite
from test.support.ros_processes import Peer, node, stamp_ns, wait_until

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures('ros_domain')]


def test_sensor_topics_are_those_of_the_simulation():
    with Peer() as peer:
        imu = peer.collect(Imu, 'x500/imu/data_raw', reliable=False)
        others = [
            peer.collect(kind, f'x500/{name}', reliable=False)
            for kind, name in (
                (MagneticField, 'imu/mag'), (FluidPressure, 'pressure'), (Range, 'range'),
                (NavSatFix, 'gps/fix'), (TwistWithCovarianceStamped, 'gps/vel'),
            )
        ]  # fmt: skip
        with node(scene='x500', realtime__factor=4.0):
            wait_until(lambda: len(imu) > 100 and min(map(len, others)) > 5, 'every sensor')
    last = imu[-1]
    assert last.header.frame_id == 'x500/imu'
    assert last.orientation_covariance[0] == -1
    simulation = Simulation('x500')
    simulation.step(round(stamp_ns(last) / 2_000_000))
    suite = SensorSuite(simulation, 'x500')
    suite.update()
    force, rates = last.linear_acceleration, last.angular_velocity
    assert [force.x, force.y, force.z] == suite.imu.specific_force.tolist()
    assert [rates.x, rates.y, rates.z] == suite.imu.angular_velocity.tolist()
    gaps = np.diff([stamp_ns(message) for message in others[0]])
    assert set(gaps) == {20_000_000}


def test_the_former_name_of_imu_data_raw_is_there_for_one_release_with_a_word():
    """REP-145: imu/data has an orientation, imu/data_raw has none."""
    with Peer() as peer:
        raw = peer.collect(Imu, 'x500/imu/data_raw', reliable=False)
        with node(scene='x500') as process:
            wait_until(lambda: len(raw) > 10, 'the IMU')
            assert 'is called' not in process.output
            old = peer.collect(Imu, 'x500/imu/data', reliable=False)
            wait_until(lambda: len(old) > 10, 'the former name')
            line = 'x500/imu/data is called x500/imu/data_raw now; the next release does not'
            assert process.output.count(line) == 1
    shared = {stamp_ns(m): m for m in raw}
    both = [(m, shared[stamp_ns(m)]) for m in old if stamp_ns(m) in shared]
    assert len(both) > 3 and all(one == other for one, other in both)


def test_bottom_track_of_the_rov():
    with Peer() as peer:
        velocity = peer.collect(TwistWithCovarianceStamped, 'bluerov2_heavy/dvl/twist',
                                reliable=False)  # fmt: skip
        with node(scene='rov', realtime__factor=4.0):
            wait_until(lambda: len(velocity) > 3, 'the DVL')
    assert velocity[0].header.frame_id == 'bluerov2_heavy/dvl'
    assert velocity[0].twist.covariance[0] > 0


def test_values_beyond_a_range_are_reported(tmp_path):
    scene = tmp_path / 'high.yaml'
    scene.write_text(
        'model: x500\nkeyframe: hover\nvehicles:\n  x500:\n    body: x500\n'
        '    sensors: {rangefinder: {rate: 50, distance: {range: [0.1, 0.2]}}}\n'
    )
    with Peer() as peer:
        peer.watch_diagnostics()
        ranges = peer.collect(Range, 'x500/range', reliable=False)

        def reported():
            values = peer.diagnostics.get('vehicle x500', (0, '', {}))[2]
            return values.get('sensor_values_beyond_range', '').startswith('rangefinder ')

        with node(scene=str(scene)):
            wait_until(reported, 'the count')
    assert ranges[0].range == float('inf')
