# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A client of the Foxglove WebSocket protocol, as the viewers speak it."""

import contextlib
import json
import struct
import time

from websockets.sync.client import connect

PROTOCOL = 'foxglove.sdk.v1'
#: Binary messages of the server: its time, a message of a channel, an answer of a service.
_MESSAGE, _TIME, _ANSWER = 1, 2, 3


class FoxgloveClient:
    """What a viewer knows of a run."""

    def __init__(self, socket):
        self._socket = socket
        self.info, self.channels, self.services, self.parameters = {}, {}, {}, {}
        self.messages, self.times, self.answers, self.sessions = [], [], {}, []
        self._calls = 0

    def send(self, operation, **fields):
        self._socket.send(json.dumps({'op': operation, **fields}))

    def receive(self, timeout):
        """Take one message, if there is one in time."""
        try:
            message = self._socket.recv(timeout=timeout)
        except TimeoutError:
            return
        if isinstance(message, bytes):
            self._take_binary(message)
            return
        message = json.loads(message)
        kind = message['op']
        if kind == 'serverInfo':
            self.info = message
            self.sessions.append(message.get('sessionId'))
        elif kind == 'advertise':
            self.channels |= {channel['topic']: channel for channel in message['channels']}
        elif kind == 'advertiseServices':
            self.services |= {service['name']: service for service in message['services']}
        elif kind == 'parameterValues':
            self.parameters |= {p['name']: p.get('value') for p in message['parameters']}

    def _take_binary(self, message):
        if message[0] == _MESSAGE:
            subscription, stamp = struct.unpack_from('<IQ', message, 1)
            self.messages.append((subscription, stamp, message[13:]))
        elif message[0] == _TIME:
            self.times.append(struct.unpack_from('<Q', message, 1)[0])
        elif message[0] == _ANSWER:
            _, call, length = struct.unpack_from('<III', message, 1)
            self.answers[call] = json.loads(message[13 + length :])

    def wait_for(self, test, timeout=20.0):
        """Take messages until a test of what is known is true; return its value."""
        end = time.monotonic() + timeout
        while not (found := test(self)):
            assert time.monotonic() < end, 'the server does not say it'
            self.receive(0.1)
        return found

    def subscribe(self, topic):
        channel = self.wait_for(lambda client: client.channels.get(topic))
        number = channel['id']
        self.send('subscribe', subscriptions=[{'id': number, 'channelId': channel['id']}])
        return number

    def call(self, service, request=None):
        """Call a service with JSON; return its answer."""
        number = self.wait_for(lambda client: client.services.get(service))['id']
        self._calls += 1
        call, encoding = self._calls, b'json'
        self._socket.send(
            struct.pack('<BIII', 2, number, call, len(encoding)) + encoding
            + json.dumps(request or {}).encode()
        )  # fmt: skip
        return self.wait_for(lambda client: client.answers.get(call))


@contextlib.contextmanager
def foxglove_client(port):
    """Give a client of a server on this machine."""
    with connect(f'ws://127.0.0.1:{port}', subprotocols=[PROTOCOL], max_size=None) as socket:
        assert socket.subprotocol == PROTOCOL
        yield FoxgloveClient(socket)
