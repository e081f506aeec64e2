"""An ArduPilot that is set to another frame than the model's is told of it."""

import socket
import threading

import pytest

from fluid_sim_ros.mavlink.ardupilot import frame_check
from test.support.autopilots import hil_wire
from test.support.autopilots.ardupilot_stand_in import Link, padded
from test.support.autopilots.autopilot_peers import BridgedFlight, waited

IDLE = padded([1000] * 4)


@pytest.fixture
def second_port(monkeypatch):
    """Serve MAVLink with the parameters that a test puts into the dictionary."""
    parameters: dict[str, float] = {}
    listener = socket.socket()
    listener.bind(('127.0.0.1', 0))
    listener.listen()
    monkeypatch.setattr(frame_check, 'SECOND_PORT', listener.getsockname()[1])

    def serve():
        client, rest = listener.accept()[0], b''
        client.sendall(hil_wire.pack('HEARTBEAT', autopilot=3, mavlink_version=3))
        while data := client.recv(4096):
            messages, rest = hil_wire.frames(rest + data)
            for name, fields in messages:
                assert name == 'PARAM_REQUEST_READ'
                key = fields['param_id']
                if (value := parameters.get(key.rstrip(b'\0').decode())) is not None:
                    answer = {'param_value': value, 'param_count': 9, 'param_type': 9}
                    client.sendall(hil_wire.pack('PARAM_VALUE', param_id=key, **answer))
        client.close()

    server = threading.Thread(target=serve, daemon=True)
    server.start()
    yield parameters
    listener.close()


def fly(second_port, **parameters):
    second_port.update(parameters)
    with BridgedFlight('x500_ground', 'ardupilot').running() as flight:
        link = Link(flight.port)
        link.exchange(IDLE)
        check = flight.bridge._frame
        assert waited(lambda: not check._thread.is_alive())
        for _ in range(5):
            link.exchange(IDLE)
    return [line for key, line in flight.reports if key == 'frame']


def test_a_plus_frame_is_named(second_port):
    assert fly(second_port, FRAME_CLASS=1.0, FRAME_TYPE=0.0) == [
        'ArduPilot flies another frame: FRAME_TYPE is 0, and must be 1'
    ]


def test_the_right_frame_needs_no_word(second_port):
    assert fly(second_port, FRAME_CLASS=1.0, FRAME_TYPE=1.0) == []
