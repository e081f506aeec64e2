# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A browser's side of the page's protocol, without a browser: what is shown, and what is moved."""

import contextlib
import threading
import time

import msgspec
import viser
import zstandard
from websockets.sync.client import connect

#: What a browser tells first; from then on it counts as looking.
_CAMERA = {
    'type': 'ViewerCameraMessage', 'wxyz': [1.0, 0.0, 0.0, 0.0], 'position': [0.0, -5.0, 2.0],
    'fov': 1.0, 'near': 0.01, 'far': 1000.0, 'image_height': 600, 'image_width': 800,
    'look_at': [0.0, 0.0, 0.0], 'up_direction': [0.0, 0.0, 1.0],
}  # fmt: skip


class ViewClient:
    """What a browser knows of a page."""

    def __init__(self, socket, url):
        self._socket, self.url = socket, url
        self.controls, self.nodes, self.moved_at = {}, {}, []
        self.changed = threading.Condition()
        self.send(_CAMERA)
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def send(self, message):
        self._socket.send(msgspec.msgpack.encode(message))

    def _read(self):
        with contextlib.suppress(Exception):
            while True:
                raw = self._socket.recv()
                size = int.from_bytes(raw[8:16], 'little')
                packed = zstandard.ZstdDecompressor().decompress(raw[16 : 16 + size])
                with self.changed:
                    messages = msgspec.msgpack.decode(packed)['messages']
                    for message in messages:
                        self._take(message)
                    if any(m.get('name', '').startswith('/world') for m in messages):
                        self.moved_at.append(time.monotonic())
                    self.changed.notify_all()

    def _take(self, message):
        kind = message['type']
        if kind.startswith('Gui') and 'props' in message:
            name = message['props'].get('label') or message['uuid']
            self.controls[name] = message
        elif kind == 'GuiUpdateMessage':
            for control in self.controls.values():
                if control['uuid'] == message['uuid']:
                    for key, value in message['updates'].items():
                        (control if key == 'value' else control['props'])[key] = value
        elif kind == 'RegisterCommandMessage':
            self.controls[message['props']['label']] = message
        elif kind == 'SetPositionMessage':
            self.nodes[message['name']] = message['position']
        elif 'name' in message and 'props' in message:
            self.nodes.setdefault(message['name'], None)

    def wait_for(self, test, timeout=20.0):
        """Return the first true value of a test of what is shown."""
        end = time.monotonic() + timeout
        with self.changed:
            while not (found := test(self)):
                assert time.monotonic() < end, 'the page does not show it'
                self.changed.wait(0.02)  # the test may be about what is behind the page
            return found

    def control(self, label):
        return self.wait_for(lambda page: page.controls.get(label))

    def set(self, label, value):
        """Move a slider, tick a box, choose of a list."""
        uuid = self.control(label)['uuid']
        self.send({'type': 'GuiUpdateMessage', 'uuid': uuid, 'updates': {'value': value}})

    def click(self, label):
        self.set(label, True)

    def press(self, label):
        """Press the key of a command."""
        self.send({'type': 'CommandTriggerMessage', 'uuid': self.control(label)['uuid']})

    def value(self, label):
        return self.control(label)['value']

    def texts(self):
        """Return all texts that are shown as HTML."""
        return [c['props'].get('content', '') for c in self.controls.values() if 'props' in c]


@contextlib.contextmanager
def client(url, **options):
    """Give a client of a page."""
    address = url.replace('http', 'ws', 1)
    with connect(
        address, subprotocols=[f'viser-v{viser.__version__}'], max_size=None, **options
    ) as socket:
        yield ViewClient(socket, url)
