# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The floor of an exchange with an autopilot: one send and one receive on the loopback device."""

import multiprocessing
import select
import socket
import statistics
import time

#: Bytes of a state and of an answer.
SIZES = {'px4': (77, 93), 'ardupilot': (400, 40)}


def bare(protocol: str, rounds: int = 4000) -> dict[str, float]:
    """Return the medians of the processor time of one send and one receive [us]."""
    kind = socket.SOCK_STREAM if protocol == 'px4' else socket.SOCK_DGRAM
    out, back = SIZES[protocol]
    process = multiprocessing.get_context('spawn').Process(
        target=echo, args=(port := free_port(protocol), kind, back), daemon=True
    )
    with socket.socket(socket.AF_INET, kind) as end:
        end.bind(('127.0.0.1', port))
        if kind == socket.SOCK_STREAM:
            end.listen(1)
        process.start()
        try:
            if kind == socket.SOCK_STREAM:
                link = end.accept()[0]
                link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            else:
                link = end.dup()
                link.connect(link.recvfrom(65536)[1])
            with link:
                spent = [_echoed(link, bytes(out)) for _ in range(rounds)]
        finally:
            process.terminate()
    send, receive = (1e6 * statistics.median(part) for part in zip(*spent, strict=True))
    return {'send_us': send, 'receive_us': receive}


def echo(port: int, kind: int, size: int) -> None:
    """Answer whatever comes with so many bytes."""
    with socket.socket(socket.AF_INET, kind) as end:
        end.connect(('127.0.0.1', port))
        answer = bytes(size)
        if kind == socket.SOCK_DGRAM:
            end.send(answer)
        while end.recv(65536):
            end.send(answer)


def _echoed(link: socket.socket, data: bytes) -> tuple[float, float]:
    """Return the processor time of a send and of a receive without waiting [s]."""
    poll = select.poll()
    poll.register(link, select.POLLIN)
    begin = time.thread_time()
    link.send(data)
    sent = time.thread_time()
    while not poll.poll(0):
        pass
    came = time.thread_time()
    link.recv(65536)
    return sent - begin, time.thread_time() - came


def free_port(protocol: str) -> int:
    kind = socket.SOCK_STREAM if protocol == 'px4' else socket.SOCK_DGRAM
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(('127.0.0.1', 0))
        return int(probe.getsockname()[1])
