# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Connections that say nothing do not keep a PX4 out."""

import contextlib
import resource
import socket

import pytest

from fluid_sim_ros.mavlink.px4 import lobby
from test.support.autopilots.autopilot_peers import waited
from test.support.autopilots.px4_stand_in import Px4

IDLE = [0.0] * 4


@contextlib.contextmanager
def idle_clients(port, count):
    with contextlib.ExitStack() as stack:
        yield [
            stack.enter_context(socket.create_connection(('127.0.0.1', port), 5.0))
            for _ in range(count)
        ]


def closed(client):
    """Return whether the other side has closed, after reading what has come."""
    client.setblocking(False)
    try:
        while client.recv(65536):
            pass
    except BlockingIOError:
        return False
    except ConnectionResetError:
        return True
    return True


def test_200_idle_connections_do_not_keep_an_autopilot_out(flight):
    with idle_clients(flight.port, 200):
        px4 = Px4(flight.port, silent=0)
        for _ in range(20):
            px4.exchange(IDLE)
        assert waited(lambda: flight.bridge.counters.answered == 20)
        assert flight.bridge._server.peer.endswith(str(px4.socket.getsockname()[1]))
        px4.close()


def test_an_autopilot_that_answers_is_not_disturbed_by_idle_connections(flight, px4):
    px4.exchange(IDLE)
    with idle_clients(flight.port, 200):
        for _ in range(100):
            px4.exchange(IDLE)
    counters = flight.bridge.counters
    assert (counters.connections, counters.disconnections, counters.malformed) == (1, 0, 0)


def test_a_client_that_says_nothing_is_dropped(flight, monkeypatch):
    monkeypatch.setattr(lobby, 'QUIET', 0.3)
    with idle_clients(flight.port, 3) as clients:
        assert waited(lambda: all(map(closed, clients)))
        assert waited(lambda: not flight.bridge._server.connected)
    assert any('has said nothing; listening on port' in line for _, line in flight.reports)
    px4 = Px4(flight.port, silent=0)  # and the next one finds the vehicle at the start
    assert px4.exchange(IDLE)['time_usec'] == 4000
    px4.close()


def test_who_has_spoken_and_is_silent_gives_way_to_one_who_speaks_alone(flight, monkeypatch):
    monkeypatch.setattr(lobby, 'QUIET', 0.3)
    halted = Px4(flight.port, silent=0)
    halted.exchange(IDLE)
    assert waited(lambda: flight.bridge._silence.reported)
    assert flight.bridge.counters.disconnections == 0  # nobody else is there
    with idle_clients(flight.port, 1) as (idle,):
        assert waited(lambda: closed(idle))
    assert flight.bridge.counters.disconnections == 0
    successor = Px4(flight.port, silent=0)
    assert successor.exchange(IDLE)['time_usec'] == 4000
    assert any('is silent, and another speaks' in line for _, line in flight.reports)
    successor.close()
    halted.close()


def test_few_file_handles_are_no_end(flight, px4):
    """A flood that takes all handles of the process leaves the autopilot in its place."""
    px4.exchange(IDLE)
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    with idle_clients(flight.port, 30):
        assert waited(lambda: len(flight.bridge._server._lobby._silent) == 30)
        with pytest.MonkeyPatch.context():
            resource.setrlimit(resource.RLIMIT_NOFILE, (3, hard))
            try:
                more = 0
                for _ in range(50):
                    px4.exchange(IDLE)
                    more += 1
            finally:
                resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))
    assert more == 50
    assert flight.bridge.counters.connections == 1
