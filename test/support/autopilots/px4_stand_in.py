# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A stand-in for PX4: its bytes and its rules for sensor messages.

It knows nothing of this package. Bytes go through the codec by hand (hil_wire); the rules are
those of PX4's simulator module: groups of bits count only as a whole, time must go on, readings
must not stand still. Its clock is the time of the last HIL_SENSOR, and whatever else arrives is
stamped with that.
"""

import math
import select
import socket
import time

from test.support.autopilots import hil_wire

GROUPS = {'accel': 0x007, 'gyro': 0x038, 'mag': 0x1C0, 'baro': 0x1A00, 'airspeed': 0x400}
#: Readings of a group that never change for so many messages in a row count as stale.
STALE = 10


class Rules:
    """What PX4 asks of HIL_SENSOR, checked message by message."""

    def __init__(self) -> None:
        self.first = self.time = 0  # [us]
        self.counts = dict.fromkeys(GROUPS, 0)
        self.last: dict[str, tuple] = {}
        self.still = dict.fromkeys(GROUPS, 0)

    def check(self, message: dict) -> None:
        assert message['time_usec'] > self.time, 'time must go on'
        self.time = message['time_usec']
        self.first = self.first or self.time
        assert message['id'] == 0
        bits = message['fields_updated']
        groups = {name for name, mask in GROUPS.items() if bits & mask}
        for name in groups:
            assert bits & GROUPS[name] == GROUPS[name], f'{name}: only some of its bits'
            self.counts[name] += 1
        assert bits == sum(GROUPS[name] for name in groups), f'unknown bits in {bits:#x}'
        assert {'accel', 'gyro'} <= groups
        readings = {
            'accel': (message['xacc'], message['yacc'], message['zacc']),
            'gyro': (message['xgyro'], message['ygyro'], message['zgyro']),
            'mag': (message['xmag'], message['ymag'], message['zmag']),
            'baro': (message['abs_pressure'],),
        }
        for name in groups & readings.keys():
            same = readings[name] == self.last.get(name)
            self.still[name] = self.still[name] + 1 if same else 0
            assert self.still[name] < STALE, f'{name} is stale'
            self.last[name] = readings[name]
        if 'baro' in groups:
            assert 500 < message['abs_pressure'] < 1100
            assert -40 < message['temperature'] < 85
        if 'mag' in groups:
            assert 0.2 < math.hypot(*readings['mag']) < 0.7


class Px4:
    """Connects, reads what arrives, and answers HIL_SENSOR."""

    def __init__(self, port: int, silent: int = 15) -> None:
        self.silent = silent
        self.rules = Rules()
        self.latest: dict[str, dict] = {}
        self.counts: dict[str, int] = {}
        self.rest = b''
        self.clock_us = 0
        self.sequence = 0
        self.socket = self._connect(port)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.send('COMMAND_LONG', command=511, param1=115.0, param2=5000.0)
        self.send('HEARTBEAT', autopilot=12, mavlink_version=3)

    @staticmethod
    def _connect(port: int) -> socket.socket:
        deadline = time.monotonic() + 5.0
        while True:
            try:
                return socket.create_connection(('127.0.0.1', port), 5.0)
            except ConnectionRefusedError:
                assert time.monotonic() < deadline, f'nobody listens on port {port}'
                time.sleep(0.01)

    def send(self, name: str, **values) -> None:
        self.socket.sendall(hil_wire.pack(name, self.sequence, **values))
        self.sequence += 1

    def sensors(self) -> dict:
        """Return the next HIL_SENSOR; everything before it is kept in ``latest``."""
        while True:
            messages, self.rest = hil_wire.frames(self.rest)
            if messages:
                break
            data = self.socket.recv(65536)
            assert data, 'the simulator has closed the connection'
            self.rest += data
        sensors = [fields for name, fields in messages if name == 'HIL_SENSOR']
        for name, fields in messages:
            self.latest[name] = fields
            if name == 'HIL_SENSOR':
                self.clock_us = fields['time_usec']
            elif 'time_usec' in fields:
                assert fields['time_usec'] == self.clock_us, (
                    f'{name} gets the stamp of another time'
                )
            self.counts[name] = self.counts.get(name, 0) + 1
        if not sensors:
            return self.sensors()
        for fields in sensors:
            self.rules.check(fields)
        return sensors[-1]

    def answer(self, time_us: int, controls: list[float], armed: bool = True) -> None:
        controls = [*controls, *[0.0] * (16 - len(controls))]
        self.send(
            'HIL_ACTUATOR_CONTROLS', time_usec=time_us, flags=1, controls=controls,
            mode=129 if armed else 1,
        )  # fmt: skip

    def exchange(self, controls: list[float], armed: bool = True) -> dict:
        """Answer the next HIL_SENSOR, unless still starting up, and return it."""
        message = self.sensors()
        if self.silent > 0:
            self.silent -= 1
        else:
            self.answer(message['time_usec'], controls, armed)
        return message

    def sticks(self, parameters: dict[str, float]) -> list[int]:
        """Return the channels that PX4 looks at with its parameters; none is no radio."""
        message = self.latest.get('RC_CHANNELS')
        if message is None or not parameters.get('RC_CHAN_CNT', 0) > 0:
            return []
        if parameters.get('COM_RC_IN_MODE', 1) != 0:  # 1: a joystick of the ground station only
            return []
        return [message[f'chan{i}_raw'] for i in range(1, int(parameters['RC_CHAN_CNT']) + 1)]

    def nothing_comes(self, seconds: float) -> bool:
        return not select.select([self.socket], [], [], seconds)[0]

    def close(self) -> None:
        self.socket.close()
