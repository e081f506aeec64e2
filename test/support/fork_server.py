# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A process that has imported what our programs import, and forks one for each request.

``python -m test.support.fork_server SOCKET``, with a socket (SOCK_SEQPACKET) that it inherits. A
request is JSON (``module``, ``arguments``, ``environment``, ``folder``) with two descriptors: one
for the output, one for a socket that gets the process's id, and its exit code when it has ended.
It ends when nobody holds the other end of SOCKET.
"""

import gc
import importlib
import json
import os
import runpy
import select
import signal
import socket
import sys
from pathlib import Path

#: Most of what nodes, controllers and commands import. Not rclpy, whose libraries start threads,
#: which no fork has.
PRELOADED = tuple(
    f'fluid_sim_ros.{name}'
    for name in (
        'cli.run', 'cli.replay', 'control.fins', 'control.guidance.velocity',
        'control.propulsion', 'control.waypoints', 'loop.recorder_port',
        'messages.description_topics', 'messages.marker_topics', 'messages.sensor_topics',
        'messages.state_topics', 'messages.transform_topics', 'sensors', 'simulation.fin_effect',
    )
)  # fmt: skip
LONGEST_REQUEST = 1 << 17


def serve(control):
    """Fork for each request; return the request in each fork, and None at the end."""
    ended, ring = os.pipe2(os.O_NONBLOCK | os.O_CLOEXEC)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    signal.set_wakeup_fd(ring)
    children = {}
    while True:
        ready, _, _ = select.select([control, ended], [], [])
        if ended in ready:
            os.read(ended, 4096)
            report(children)
        if control not in ready:
            continue
        text, descriptors, _, _ = socket.recv_fds(control, LONGEST_REQUEST, 2)
        if not text:
            return None
        output, told = descriptors
        pid = os.fork()
        if pid == 0:
            signal.set_wakeup_fd(-1)
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            for descriptor in (ended, ring, told, *(s.fileno() for s in children.values())):
                os.close(descriptor)
            control.close()
            take_output(output)
            return json.loads(text)
        os.close(output)
        children[pid] = socket.socket(fileno=told)
        children[pid].send(str(pid).encode())


def report(children):
    """Tell of each process that has ended; whoever asked for it may be gone."""
    while children:
        pid, status = os.waitpid(-1, os.WNOHANG)
        if not pid:
            return
        with children.pop(pid) as told:
            try:
                told.send(str(os.waitstatus_to_exitcode(status)).encode())
            except OSError:
                continue


def take_output(descriptor):
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.dup2(descriptor, 1)
    os.dup2(descriptor, 2)
    os.close(nothing)
    os.close(descriptor)


def main():
    for name in PRELOADED:
        importlib.import_module(name)
    del sys.modules['fluid_sim_ros.cli']  # it takes signals when it is imported in a program
    assert len(list(Path('/proc/self/task').iterdir())) == 1
    gc.collect()
    gc.freeze()  # a fork need not copy what its collector would only look at
    request = serve(socket.socket(fileno=int(sys.argv[1])))
    if request is None:
        return
    os.chdir(request['folder'])
    os.environ.clear()
    os.environ.update(request['environment'])
    sys.argv = ['-m', *request['arguments']]  # as Python has it while it looks for the module
    runpy._run_module_as_main(request['module'])  # what ``python -m`` does


if __name__ == '__main__':
    main()
