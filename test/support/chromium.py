# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A headless Chromium, driven over its DevTools protocol: to look at pages as a user does."""

import base64
import contextlib
import itertools
import json
import shutil
import subprocess
import time
from pathlib import Path

from websockets.sync.client import connect

PROGRAM = shutil.which('chromium') or shutil.which('chromium-browser') or shutil.which('chrome')
#: Draws 3D without a graphics card.
_OPTIONS = (
    '--headless=new', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--no-sandbox', '--no-first-run', '--disable-background-networking', '--disable-sync',
    '--remote-debugging-port=0', '--remote-allow-origins=*', '--hide-scrollbars',
)  # fmt: skip


class Browser:
    """One tab of a browser."""

    def __init__(self, socket):
        self._socket, self._ids = socket, itertools.count(1)
        self.console = []

    def call(self, method, timeout=60.0, **parameters):
        """Call a method of the protocol and return its result."""
        number = next(self._ids)
        self._socket.send(json.dumps({'id': number, 'method': method, 'params': parameters}))
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            with contextlib.suppress(TimeoutError):
                message = json.loads(self._socket.recv(timeout=end - time.monotonic()))
                self._note(message)
                if message.get('id') == number:
                    if 'error' in message:
                        raise RuntimeError(f'{method}: {message["error"]}')
                    return message['result']
        raise TimeoutError(method)

    def _note(self, message):
        if message.get('method') == 'Runtime.consoleAPICalled':
            words = [str(a.get('value', a.get('description'))) for a in message['params']['args']]
            self.console.append(' '.join(words))
        elif message.get('method') in ('Runtime.exceptionThrown', 'Log.entryAdded'):
            self.console.append(json.dumps(message['params']))

    def run(self, script):
        """Return the value of an expression of JavaScript in the page."""
        result = self.call('Runtime.evaluate', expression=script, awaitPromise=True,
                           returnByValue=True)  # fmt: skip
        return result['result'].get('value')

    def wait_for(self, script, timeout=30.0):
        """Return once an expression is true."""
        end = time.monotonic() + timeout
        while time.monotonic() < end:
            with contextlib.suppress(RuntimeError):  # the page is just being loaded
                if self.run(script):
                    return
            time.sleep(0.1)
        raise TimeoutError(f'not within {timeout} s: {script}')

    def press_button(self, label):
        """Click a button by the words on it."""
        words = f"b => b.innerText.trim() === '{label}'"
        self._click(f"[...document.querySelectorAll('button')].find({words})", 0.5)

    def set_slider(self, number, share):
        """Click into a slider, counted from the top, at a share of its length."""
        self._click(f"document.querySelectorAll('[role=slider]')[{number}]?.parentElement", share)

    def _click(self, element, share):
        """Click on an element, at a share of its width."""
        self.wait_for(f'!!{element}')
        box = f'{element}.getBoundingClientRect()'
        x, y, width, height = (self.run(f'{box}.{k}') for k in ('x', 'y', 'width', 'height'))
        for kind in ('mousePressed', 'mouseReleased'):
            self.call('Input.dispatchMouseEvent', type=kind, x=x + share * width,
                      y=y + height / 2, button='left', clickCount=1)  # fmt: skip

    def screenshot(self, path):
        """Write a PNG of the page."""
        data = self.call('Page.captureScreenshot', format='png')['data']
        Path(path).write_bytes(base64.b64decode(data))


@contextlib.contextmanager
def browser(folder, url, size=(1280, 800), webgl=True):
    """Give a tab that has opened a page."""
    command = [
        PROGRAM, *_OPTIONS, *([] if webgl else ['--disable-3d-apis']),
        f'--user-data-dir={folder}',
        f'--window-size={size[0]},{size[1]}', 'about:blank',
    ]  # fmt: skip
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        note, end = Path(folder) / 'DevToolsActivePort', time.monotonic() + 30.0
        while not (note.exists() and len(note.read_text().split()) == 2):
            assert time.monotonic() < end, 'chromium does not start'
            time.sleep(0.05)
        port, path = note.read_text().split()
        with connect(f'ws://127.0.0.1:{port}{path}', max_size=None) as root:
            tab = Browser(root)
            target = tab.call('Target.createTarget', url='about:blank')['targetId']
        with connect(f'ws://127.0.0.1:{port}/devtools/page/{target}', max_size=None) as socket:
            tab = Browser(socket)
            for domain in ('Page', 'Runtime', 'Log'):
                tab.call(f'{domain}.enable')
            tab.call('Emulation.setDeviceMetricsOverride', width=size[0], height=size[1],
                     deviceScaleFactor=1, mobile=False)  # fmt: skip
            tab.call('Page.navigate', url=url)
            yield tab
    finally:
        process.terminate()
        process.wait(timeout=20)
