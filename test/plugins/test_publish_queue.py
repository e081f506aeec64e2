# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Messages go out in their order and whole, by a thread or not, and none is left out."""

import ctypes
import random
import threading
import time

import pytest

from fluid_sim_ros.plugins.tick import PublishQueue


class Message(ctypes.Structure):
    """rcl_serialized_message_t, as far as it is read."""

    _fields_ = [('buffer', ctypes.c_void_p), ('length', ctypes.c_size_t)]


class Middleware:
    """Keeps what it is given, and in which thread; it may be slow, or stand still."""

    def __init__(self, delay=0.0):
        self.delay, self.taken, self.threads = delay, [], set()
        self.open = threading.Event()
        self.open.set()
        kind = ctypes.CFUNCTYPE(
            ctypes.c_int, ctypes.c_void_p, ctypes.POINTER(Message), ctypes.c_void_p
        )
        self._function = kind(self._publish)
        self.addresses = (ctypes.cast(self._function, ctypes.c_void_p).value, 0, 0)

    def _publish(self, publisher, message, allocation):
        self.open.wait(10.0)
        if self.delay:
            time.sleep(self.delay)
        data = ctypes.string_at(message[0].buffer, message[0].length)
        self.taken.append((publisher, data))
        self.threads.add(threading.get_native_id())
        return 0


@pytest.fixture
def made():
    """Return what makes a queue, and free those that were made."""
    queues = []

    def make(middleware, size):
        queues.append(PublishQueue(middleware.addresses, size))
        return queues[-1]

    yield make
    for queue in queues:
        queue.free()


def messages(count, longest, seed=3):
    draw = random.Random(seed)
    return [(draw.randrange(1, 9), draw.randbytes(draw.randrange(longest))) for _ in range(count)]


@pytest.mark.parametrize('size', [64, 300, 4096, 1 << 20])
@pytest.mark.parametrize('threaded', [False, True])
def test_all_go_out_in_their_order(made, size, threaded):
    """Rings that are smaller than a message, that wrap around, and that never fill."""
    middleware = Middleware()
    queue = made(middleware, size)
    if threaded:
        queue.start()
    sent = messages(3000, 200)
    for each in sent:
        queue.send(*each)
    assert queue.stop(10.0) == 0
    assert middleware.taken == sent
    own = threading.get_native_id()
    assert threaded or middleware.threads == {own}
    assert not threaded or middleware.threads - {own}


def test_who_sends_does_not_wait_while_there_is_room_and_waits_while_there_is_none(made):
    middleware = Middleware()
    queue = made(middleware, 1024)
    queue.start()
    middleware.open.clear()
    for _ in range(5):
        queue.send(1, bytes(100))
    assert middleware.taken == []  # it stands still, and we came here
    done = threading.Event()

    def send_more():
        for _ in range(20):
            queue.send(2, bytes(100))
        done.set()

    sender = threading.Thread(target=send_more)
    sender.start()
    assert not done.wait(0.1)
    middleware.open.set()
    assert done.wait(5.0)
    sender.join()
    assert queue.stop(5.0) == 0
    assert [publisher for publisher, _ in middleware.taken] == [1] * 5 + [2] * 20


def test_the_end_comes_in_time_and_says_what_was_left_out(made):
    middleware = Middleware(delay=0.05)
    queue = made(middleware, 1 << 16)
    queue.start()
    for _ in range(100):
        queue.send(1, b'abc')
    begin = time.monotonic()
    left = queue.stop(0.2)
    assert time.monotonic() - begin < 2.0
    assert left > 50 and len(middleware.taken) == 100 - left


def test_a_thread_may_come_and_go(made):
    middleware = Middleware()
    queue = made(middleware, 512)
    sent = messages(400, 60)
    for i, each in enumerate(sent):
        if i % 100 == 0:
            queue.start()
        if i % 100 == 50:
            assert queue.stop(5.0) == 0
        queue.send(*each)
    assert queue.stop(5.0) == 0 and queue.stop(5.0) == 0
    assert middleware.taken == sent
