# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
The stand-in for ArduPilot as a program, with the ways of the real one.

It ignores SIGTERM; it waits on TCP port 5760 + 10 instance for a ground station before its first
packet, unless SERIAL0 says otherwise; it starts another process; it writes brackets.
"""

import argparse
import os
import signal
import socket
import subprocess
from itertools import count
from pathlib import Path

from test.support.autopilots.ardupilot_stand_in import Copter, Link, padded


def wait_for_station(port: int) -> None:
    with socket.socket() as listener:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind(('127.0.0.1', port))
        listener.listen(5)
        print('Waiting for connection ....', flush=True)
        listener.accept()


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument('-I', type=int, default=0, dest='instance')
    parser.add_argument('--serial0', default='tcp:0:wait')
    parser.add_argument('--sim-port-out', type=int)
    parser.add_argument('--pids', type=Path)  # of this stand-in: where to write process ids
    parser.add_argument('--flying', type=Path)  # of this stand-in: what to write once it flies
    for option in ('--model', '--home', '--speedup', '--defaults'):
        parser.add_argument(option)
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    assert arguments.model.startswith('JSON:')
    print('[init] storage in [/fs/x], [commander] ready :warning:', flush=True)
    if arguments.defaults:
        for path in arguments.defaults.split(','):
            print('defaults:', *Path(path).read_text().split('\n'), flush=True)
    if arguments.pids:
        child = subprocess.Popen(['sleep', '1000'])
        arguments.pids.write_text(f'{os.getpid()} {child.pid}')
    if arguments.serial0.endswith(':wait'):
        wait_for_station(5760 + 10 * arguments.instance)
    link = Link(arguments.sim_port_out or 9002 + 10 * arguments.instance)
    copter, pulses = Copter((0.0, 0.0, -2.0), 0.77), padded([1000] * 4)
    for exchange in count():
        pulses = copter.pulses(link.exchange(pulses))
        if exchange == 10 and arguments.flying:
            arguments.flying.touch()


if __name__ == '__main__':
    main()
