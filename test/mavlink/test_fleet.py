# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Several autopilots in one lockstep: two PX4, or a PX4 and an ArduSub, over real sockets."""

import json
import math
import shlex
import socket
import sys

import numpy as np
import pytest

from fluid_sim_ros import Scene
from fluid_sim_ros.cli import main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.loop.autopilot_fleet import autopilots_of
from fluid_sim_ros.mavlink.px4 import bridge as px4_bridge
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from test.support.autopilots.ardupilot_stand_in import VECTORED, Link, Submarine, padded
from test.support.autopilots.autopilot_peers import free_port, waited
from test.support.autopilots.fleet_peers import FleetFlight, Pilot
from test.support.autopilots.px4_pilots import Quad
from test.support.autopilots.px4_stand_in import Px4
from test.support.paths import ROOT

TWO_PX4 = """
vehicles:
  one: {model: x500, position: [0, 0], keyframe: ground, autopilot: px4}
  two: {model: x500, position: [4, 0], yaw: 90, keyframe: ground, autopilot: {protocol: px4}}
"""
PX4_AND_SUB = """
vehicles:
  air: {model: x500, position: [0, 0, 2], keyframe: hover, autopilot: px4}
  sub: {model: bluerov2, position: [0, 3, -2], autopilot: ardupilot}
"""
#: Where each stand-in flies to, from its own start [m, NED].
TARGETS = {'one': (1.0, 0.0, -2.0), 'two': (0.0, 2.0, -3.0), 'air': (1.0, 1.0, 0.0)}


@pytest.fixture(autouse=True)
def patient(monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 5.0)


@pytest.fixture
def write(tmp_path):
    def file(text):
        path = tmp_path / 'fleet.yaml'
        path.write_text(text)
        return path

    return file


def px4_pilot(flight, name, exchanges, stamps=None):
    """Fly a quadrotor for so many exchanges."""

    def fly():
        px4, quad = Px4(flight.ports[name], silent=0), Quad(TARGETS[name], hover=0.77)
        controls = [0.0] * 4
        for _ in range(exchanges):
            sensors = px4.exchange(controls)
            if stamps is not None:
                stamps.append(sensors['time_usec'])
            controls = quad.controls(px4, sensors)
        px4.close()

    return Pilot(fly)


def sub_pilot(flight, name, exchanges, stamps=None, rate=400):
    """Dive a submarine for so many frames."""

    def fly():
        link = Link(flight.ports[name], rate)
        sub, pulses = Submarine(VECTORED, 4.0, math.pi / 2), padded([1500] * 8)
        for _ in range(exchanges):
            state = link.exchange(pulses)
            if stamps is not None:
                stamps.append(state['timestamp'][0])
            pulses = sub.pulses(state)
        link.close()

    return Pilot(fly)


def two_px4(path, exchanges):
    """Fly both; return the simulation's state after the last answer of both."""
    flight = FleetFlight(path)
    with flight.running(until=2 * exchanges + 2):
        pilots = [px4_pilot(flight, name, exchanges) for name in ('one', 'two')]
        for pilot in pilots:
            pilot.join()
    for bridge in flight.bridges.values():
        assert bridge.counters.answered == exchanges
        assert (bridge.counters.missed, bridge.counters.malformed) == (0, 0)
    return flight.simulation


def test_two_px4_fly_their_own_vehicles_the_same_way_every_time(write):
    path = write(TWO_PX4)
    first, second = (two_px4(path, 1500) for _ in range(2))
    assert first.step_count == second.step_count == 3002
    np.testing.assert_array_equal(first.data.qpos, second.data.qpos)
    np.testing.assert_array_equal(first.data.qvel, second.data.qvel)
    places = [state.position_w for state in first.snapshot().vehicles.values()]
    assert places[0] == pytest.approx([0.0, 1.0, 2.13], abs=0.15)
    assert places[1] == pytest.approx([6.0, 0.0, 3.13], abs=0.15)


def px4_and_sub(path, log=None, rate=400):
    flight, stamps = FleetFlight(path, log), ([], [])
    with flight.running(until=2000):  # 4 s
        pilots = [px4_pilot(flight, 'air', 998, stamps[0])]
        frames = math.ceil(998 * 4000 / (1_000_000 // rate))  # until the other one has flown
        pilots.append(sub_pilot(flight, 'sub', frames, stamps[1], rate))
        for pilot in pilots:
            pilot.join()
        flight.runner.stop()
    return flight, stamps


def test_a_px4_and_an_ardusub_share_one_lockstep_and_repeat(write, tmp_path):
    path, log = write(PX4_AND_SUB), tmp_path / 'a.mcap'
    (first, stamps), (second, _) = px4_and_sub(path, log), px4_and_sub(path)
    assert stamps[0] == [4000 * (i + 1) for i in range(998)]
    np.testing.assert_allclose(stamps[1], 0.0025 * np.arange(1, 1598), atol=1e-6)
    air, sub = first.simulation.snapshot().vehicles.values()
    assert air.position_w == pytest.approx([1.0, 1.0, 2.0], abs=0.2)
    assert sub.position_w[2] < -3.0
    for name in ('air', 'sub'):
        assert first.bridges[name].counters.missed == second.bridges[name].counters.missed == 0
    again = resimulate(open_log(log))
    assert again.commands > 2000 and again.difference is None
    np.testing.assert_array_equal(first.simulation.data.qpos, second.simulation.data.qpos)


def test_frames_that_never_meet_the_others_boundaries(write):
    flight, stamps = px4_and_sub(write(PX4_AND_SUB), rate=333)
    assert stamps[0] == [4000 * (i + 1) for i in range(998)]
    np.testing.assert_allclose(np.diff(stamps[1]), 0.003003, atol=1e-6)
    assert flight.bridges['air'].counters.missed == 0


def test_while_one_is_silent_time_stands_still_for_all(write):
    with FleetFlight(write(TWO_PX4)).running() as flight:
        one, two = (Px4(flight.ports[name], silent=0) for name in ('one', 'two'))
        for _ in range(20):
            for px4 in (one, two):
                px4.exchange([0.0] * 4)
        one.exchange([0.0] * 4)  # the other one does not answer this time
        two.sensors()
        assert waited(lambda: any('no answer for 1 s' in line for line in flight.reports))
        step = flight.simulation.step_count
        assert one.nothing_comes(0.3)
        assert flight.simulation.step_count == step
        assert flight.reports[-1].startswith('two: PX4: no answer')
        two.answer(two.clock_us, [0.0] * 4)
        for px4 in (one, two):
            px4.exchange([0.0] * 4)
        assert waited(lambda: flight.reports[-1].startswith('two: PX4 answers again'))
        one.close()
        two.close()


def test_one_that_restarts_finds_the_whole_fleet_at_its_start(write):
    with FleetFlight(write(TWO_PX4)).running() as flight:
        one, two = (Px4(flight.ports[name], silent=0) for name in ('one', 'two'))
        for _ in range(50):
            for px4 in (one, two):
                px4.exchange([0.9] * 4)
        one.close()
        two.exchange([0.9] * 4)
        one = Px4(flight.ports['one'], silent=0)
        before = two.clock_us
        assert two.exchange([0.0] * 4)['time_usec'] > before  # its time goes on
        assert one.exchange([0.0] * 4)['time_usec'] == 4000
        for _ in range(5):
            for px4 in (two, one):
                px4.exchange([0.0] * 4)
        assert flight.resets == 1
        assert flight.simulation.step_count < 30
        assert flight.bridges['one'].counters.restarts == 1
        assert flight.bridges['two'].counters.restarts == 0
        one.close()
        two.close()


def test_instances_count_by_protocol_and_ports_follow(write):
    stated = autopilots_of(Scene.load(write(
        'vehicles: {a: {model: x500, autopilot: px4}, '
        'b: {model: x500, position: [3, 0], autopilot: {protocol: px4, instance: 0}}, '
        'c: {model: x500, position: [6, 0], autopilot: ardupilot}, '
        'd: {model: x500, count: 2, spacing: 3, position: [9, 0], autopilot: ardupilot}}'
    )))  # fmt: skip
    assert [(s.vehicle, s.protocol, s.instance) for s in stated] == [
        ('a', 'px4', 1), ('b', 'px4', 0), ('c', 'ardupilot', 0), ('d_1', 'ardupilot', 1),
        ('d_2', 'ardupilot', 2),
    ]  # fmt: skip
    twice = TWO_PX4.replace('autopilot: px4', 'autopilot: {protocol: px4, instance: 3}')
    twice = twice.replace('autopilot: {protocol: px4}', 'autopilot: {protocol: px4, instance: 3}')
    with pytest.raises(
        ConfigError, match=r"'vehicles\.two\.autopilot\.instance': 3 of px4 stands"
    ):
        Scene.load(write(twice))


def consecutive_instances():
    """Return two numbers whose ports nobody listens on."""
    for first in range(20, 240, 2):
        try:
            with FleetPorts(first):
                return first, first + 1
        except OSError:
            continue
    raise AssertionError('no free ports')


class FleetPorts:
    """Binds the ports of two instances for a moment."""

    def __init__(self, first):
        self.sockets = [socket.socket() for _ in range(2)]
        for i, one in enumerate(self.sockets):
            one.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            one.bind(('127.0.0.1', 4560 + first + i))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for one in self.sockets:
            one.close()


def test_one_command_starts_the_program_of_each(write, capfd, monkeypatch):
    monkeypatch.setattr(px4_bridge, '_FREE_WHEEL', 0.004)
    first, second = consecutive_instances()
    text = TWO_PX4.replace('autopilot: px4', f'autopilot: {{protocol: px4, instance: {first}}}')
    path = write(text.replace('{protocol: px4}', f'{{protocol: px4, instance: {second}}}'))
    program = 'test.support.autopilots.px4_program'
    command = shlex.join(['env', f'PYTHONPATH={ROOT}', sys.executable, '-m', program])
    command = command.replace('env ', 'env WHO={vehicle} ', 1)
    assert main(['run', str(path), '--exec', command, '--duration', '3', '--json', '-']) == 0
    out, err = capfd.readouterr()
    result = json.loads(out)
    flown = result['autopilots']
    assert list(flown) == ['one', 'two']
    assert all(f['answered'] > 600 and f['fault'] == '' for f in flown.values())
    assert all(v['position_w_m'][2] > 0.5 for v in result['vehicles'].values())
    assert f'one: airframe 10016, instance {first}' in err
    assert f'two: airframe 10016, instance {second}' in err
    assert 'two: px4: ' in err


@pytest.mark.parametrize(
    ('arguments', 'line'),
    [
        (['--hold'], "--hold: the scene's autopilots command; --autopilot none leaves them out"),
        (['--vehicle', 'one'], '--vehicle needs --autopilot: the scene file states that'),
        (['--exec', 'a', '--exec', 'b'], '--exec b: is the second for the same; write VEHICLE='),
        (['--exec', 'one=a', '--param', 'A=1'], "--param needs --autopilot: state them as 'para"),
        (['--autopilot', 'px4'], 'name the vehicle that it flies, one of: one, two'),
    ],
)
def test_options_that_do_not_go_with_a_fleet_are_one_line(write, arguments, line, capsys):
    assert main(['run', str(write(TWO_PX4)), '--duration', '1', *arguments]) == 2
    assert line in capsys.readouterr().err


def test_without_its_autopilots_a_fleet_is_a_scene_like_others(write, capsys):
    arguments = ['run', str(write(TWO_PX4)), '--duration', '0.1', '--json', '-']
    assert main([*arguments, '--autopilot', 'none', '--hold']) == 0
    assert 'autopilot' not in capsys.readouterr().out


def test_a_port_in_use_closes_those_that_were_open(write):
    port = free_port('px4')
    text = TWO_PX4.replace('autopilot: px4', f'autopilot: {{protocol: px4, port: {port}}}')
    path = write(text.replace('{protocol: px4}', f'{{protocol: px4, port: {port}}}'))
    for _ in range(2):  # the second time the first of the two ports is free again
        assert main(['run', str(path), '--duration', '1']) == 2
