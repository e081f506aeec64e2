# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
What an autopilot costs: speed in lockstep with a peer over real sockets, and the bridge's share.

The peer is a process that answers each state at once with the thrust of hover, so that what is
measured is the bridge and the sockets, not a controller. The overhead of an exchange is the
processor time that the loop spends in the bridge, the simulated sensors and the system's sockets
included, without that of waiting for the peer, which it does awake for a while. ``physics`` is the
part of it in which the forces are evaluated that the sensors read, ``own`` the rest: sensors,
bytes, checksums, sockets and commands. ``parts`` are clocked in exchanges of their own, each clock
taking half a microsecond, ``python`` being what no other part has. ``bare`` are the system's calls
alone: as many bytes sent to and received from a process that answers them, in the same run. An
exchange of PX4 covers two steps of the quadrotor. Ratios are of one run. Targets: PX4 at 250 Hz at
least 20 times real time, median overhead of a step 50 us or less, median ``own`` 30 us or less.
``profile`` holds the shares of the parts of an exchange by cProfile's count of processor time,
which makes small functions look larger.
"""

import cProfile
import math
import multiprocessing
import pstats
import socket
import statistics
import struct
import time
from collections.abc import Callable, Sequence
from typing import Any

from benchmarks.common import arguments, wall_seconds, write
from benchmarks.node.bare_sockets import bare, free_port
from fluid_sim_ros import Simulation
from fluid_sim_ros.loop.autopilot_pacing import AutopilotPacing
from fluid_sim_ros.loop.autopilot_port import (
    AutopilotOptions,
    Surroundings,
    open_bridge,
)
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.mavlink.link import AutopilotLink
from fluid_sim_ros.mavlink.px4.hil_messages import dialect
from fluid_sim_ros.mavlink.px4.wire import Frame
from fluid_sim_ros.mavlink.sockets import Watch
from fluid_sim_ros.plugins.exchange import PARTS
from fluid_sim_ros.step_clock import NEVER

SCENE = 'x500_ground'
#: Share of full speed at which the x500 hovers: sqrt(2.06432 kg x 9.81 m/s^2 / 4 / 8.54858 N).
HOVER = 0.77
ARDUPILOT_RATE = 400  # [Hz]
TARGETS = {'real_time_factor': 20.0, 'overhead_per_step_us': 50.0, 'own_us': 30.0}
#: Exchanges before the measurement: the first answers, and caches.
_WARM_UP = 200
#: Exchanges in one round; bridged and bare rounds take turns, and their medians count.
_ROUND = 250


def px4_peer(port: int) -> None:
    """Answer every HIL_SENSOR of a connection."""
    answer = Frame(dialect.MAVLink_hil_actuator_controls_message)
    controls = [HOVER] * 4 + [0.0] * 12
    client = socket.create_connection(('127.0.0.1', port))
    client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    head = struct.Struct('<10xQ')
    rest = b''
    while data := client.recv(65536):
        rest += data
        at = 0
        while at + 12 <= len(rest) and at + 12 + rest[at + 1] <= len(rest):
            if rest[at + 7] == 107:
                (now_us,) = head.unpack_from(rest, at)
                client.sendall(answer.pack(0, 1, 1, now_us, 1, *controls, 129))
            at += 12 + rest[at + 1]
        rest = rest[at:]


def ardupilot_peer(port: int) -> None:
    """Send a servo packet for every state."""
    peer = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    peer.connect(('127.0.0.1', port))
    pulse = round(1000 + 1000 * HOVER)
    count = 0
    while True:
        packet = struct.pack('<HHI16H', 18458, ARDUPILOT_RATE, count, *[pulse] * 4, *[0] * 12)
        peer.send(packet)
        peer.recv(65536)
        count += 1


class Timed(AutopilotPacing):
    """
    Keeps the processor time that the loop spent in each exchange [s].

    ``exchanges`` has a row for each: all of it, and each of ``PARTS`` of plugins/exchange.py.
    """

    def __init__(self, bridge: AutopilotLink, simulation: Simulation) -> None:
        super().__init__(bridge, Pacing())
        self.exchanges: list[list[float]] = []
        self._all = 0.0
        self._peer = bridge.peer
        self._parts = [0.0] * len(PARTS)  # of what Python does of them
        self.clock_parts('waiting', 'observing')
        self._clock_python(Watch, 'readable', PARTS.index('waiting'))
        self._clock_python(simulation, 'observe', PARTS.index('observing'))

    def clock_parts(self, *parts: str) -> None:
        """Clock these parts of the exchange where the library has it, and no others."""
        self._peer.clocked = sum(1 << PARTS.index(part) for part in parts)

    def meet(self, simulation: Simulation, source: Any) -> bool:
        """Exchange under the clock."""
        begin = time.thread_time()
        met = super().meet(simulation, source)
        self._all += time.thread_time() - begin
        if met:
            both = zip(self._parts, self._peer.spent, strict=True)
            self.exchanges.append([self._all, *(ours + library for ours, library in both)])
            self._all, self._parts[:] = 0.0, [0.0] * len(PARTS)
            self._peer.spent[:] = self._parts
        return met

    def _clock_python(self, owner: Any, name: str, part: int) -> None:
        method = getattr(owner, name)

        def timed(*args: Any, **options: Any) -> Any:
            begin = time.thread_time()
            found = method(*args, **options)
            self._parts[part] += time.thread_time() - begin
            return found

        setattr(owner, name, timed)


#: Part of an exchange -> begins of the modules that do it.
MODULES = {
    'simulation': ('simulation/', 'scene/', 'plugins/'),
    'sensors and noise': ('sensors/', 'physics/'),
    'readings and packets': ('mavlink/px4/', 'mavlink/ardupilot/', 'mavlink/ned', 'mavlink/veh'),
    'commands and batteries': ('mavlink/',),
    'loop and clocks': ('loop/', 'step_clock/'),
    'sockets of the system': ('_socket', 'select'),
}


def profile(exchange: Callable[[int], None], exchanges: int) -> dict[str, float]:
    """Return each part's share of the loop's processor time; a built-in goes to its caller."""
    profiler = cProfile.Profile(time.thread_time)
    profiler.runcall(exchange, exchanges)
    spent = dict.fromkeys([*MODULES, 'rest'], 0.0)
    for (file, _, name), row in pstats.Stats(profiler).stats.items():  # type: ignore[attr-defined]
        own, callers = row[2], row[4]
        if file != '~' or 'socket' in name or 'poll' in name:
            spent[_part(file if file != '~' else '_socket')] += own
            continue
        for (caller, _, _), (_, _, share, _) in callers.items():
            spent[_part(caller)] += share
    whole = sum(spent.values())
    return {part: seconds / whole for part, seconds in spent.items()}


def _part(file: str) -> str:
    module = file.split('fluid_sim_ros/')[-1]
    for part, begins in MODULES.items():
        if module.startswith(begins):
            return part
    return 'rest'


def measure(protocol: str, exchanges: int) -> dict[str, Any]:
    """Fly with a peer; return speed, its ratio to bare stepping, and the overhead."""
    simulation = Simulation(SCENE)
    bridge = open_bridge(simulation, AutopilotOptions(protocol, port=free_port(protocol)),
                         Surroundings())  # fmt: skip
    assert isinstance(bridge, AutopilotLink)
    pacing = Timed(bridge, simulation)
    runner = Runner(simulation, NoSource(), [], pacing)
    rate = 250 if protocol == 'px4' else ARDUPILOT_RATE

    def exchange(count: int) -> None:
        target, runner.stopped = bridge.counters.answered + count, False
        runner.housekeeping = lambda: bridge.counters.answered >= target and runner.stop()
        runner.run(NEVER)

    per_exchange = 2 if protocol == 'px4' else math.ceil(1 / ARDUPILOT_RATE / simulation.timestep)
    bare_simulation, bridged, alone = Simulation(SCENE), [], []

    def step_alone() -> None:
        for _ in range(_ROUND):
            bare_simulation.step(per_exchange)

    peer = {'px4': px4_peer, 'ardupilot': ardupilot_peer}[protocol]
    process = multiprocessing.get_context('spawn').Process(
        target=peer, args=(bridge.port,), daemon=True
    )
    process.start()
    try:
        exchange(_WARM_UP)
        pacing.exchanges.clear()
        bare_simulation.load_state(simulation.save_state())
        for _ in range(exchanges // _ROUND):
            bridged.append(wall_seconds(lambda: exchange(_ROUND)))
            alone.append(wall_seconds(step_alone))
        steps = simulation.step_count
        rows = [pacing.exchanges[i] for i in range(len(bridged) * _ROUND)]
        pacing.clock_parts(*PARTS)
        pacing.exchanges.clear()
        exchange(exchanges // 10)
        parts = [_median_us(column) for column in zip(*pacing.exchanges, strict=True)]
        pacing.clock_parts('waiting', 'observing')
        shares = profile(exchange, exchanges // 10)
    finally:
        process.terminate()
        bridge.close()
    waiting, observing = (1 + PARTS.index(part) for part in ('waiting', 'observing'))
    overheads = sorted(1e6 * (row[0] - row[waiting]) for row in rows)
    own = sorted(1e6 * (row[0] - row[waiting] - row[observing]) for row in rows)
    wall, bare_wall = statistics.median(bridged), statistics.median(alone)
    return {
        'exchange_rate_hz': rate,
        'exchanges': exchanges,
        'steps': steps,
        'missed': bridge.counters.missed,
        'real_time_factor': _ROUND / rate / wall,
        'bare_real_time_factor': _ROUND / rate / bare_wall,
        'share_of_bare_speed': bare_wall / wall,
        'exchange_us': 1e6 * wall / _ROUND,
        'overhead_median_us': statistics.median(overheads),
        'overhead_p99_us': overheads[int(0.99 * len(overheads))],
        'overhead_per_step_median_us': statistics.median(overheads) / per_exchange,
        'physics_median_us': _median_us([row[observing] for row in rows]),
        'own_median_us': statistics.median(own),
        'own_p99_us': own[int(0.99 * len(own))],
        'parts_median_us': dict(zip(PARTS, parts[1:], strict=True))
        | {'python': parts[0] - sum(parts[1:])},
        'bare': bare(protocol),
        'profile': shares,
    }


def _median_us(seconds: Sequence[float]) -> float:
    return 1e6 * statistics.median(seconds)


def table(result: dict[str, Any]) -> str:
    """Return what an exchange takes with each autopilot, and how busy the machine was."""
    names = {'px4': 'PX4, 250 Hz', 'ardupilot': 'ArduPilot, 400 Hz'}
    load = f'Median processor time [us] (load {result["load_average"]:.1f})'
    lines = [f'| {load} | {" | ".join(names.values())} |', '|---|---|---|']

    def row(what: str, value: Callable[[dict[str, Any]], str]) -> None:
        lines.append(f'| {what} | {" | ".join(value(result[name]) for name in names)} |')

    row('without physics (99 %)', lambda r: f'{r["own_median_us"]:.1f} ({r["own_p99_us"]:.0f})')
    row('physics', lambda r: f'{r["physics_median_us"]:.1f}')
    for part in ('writing', 'sending', 'receiving', 'driving', 'python'):
        row(f'clocked: {part}', lambda r, part=part: f'{r["parts_median_us"][part]:.1f}')
    row('bare send, receive', lambda r: f'{r["bare"]["send_us"]:.1f}, '
                                        f'{r["bare"]["receive_us"]:.1f}')  # fmt: skip
    row('times real time', lambda r: f'{r["real_time_factor"]:.0f}')
    return '\n'.join(lines)


def main() -> None:
    """Measure both protocols and write the result."""
    options = arguments(__doc__, 'autopilot_bridge')
    exchanges = 2000 if options.quick else 20000
    rows = {protocol: measure(protocol, exchanges) for protocol in ('px4', 'ardupilot')}
    for protocol, row in rows.items():
        print(
            f'{protocol}: {row["real_time_factor"]:.1f} times real time '
            f'({row["share_of_bare_speed"]:.2f} of bare stepping), overhead of an exchange '
            f'{row["overhead_median_us"]:.0f} us (99 %: {row["overhead_p99_us"]:.0f} us)'
        )
        print(
            f'  of it physics {row["physics_median_us"]:.1f} us, own '
            f'{row["own_median_us"]:.1f} us (99 %: {row["own_p99_us"]:.0f} us); bare send '
            f'{row["bare"]["send_us"]:.1f} us, receive {row["bare"]["receive_us"]:.1f} us'
        )
        clocked = ', '.join(f'{k} {v:.1f}' for k, v in row['parts_median_us'].items())
        print(f'  parts [us]: {clocked}')
        parts = ', '.join(f'{part} {share:.0%}' for part, share in row['profile'].items())
        print(f'  of an exchange: {parts}')
    write(options.json, {'scene': SCENE, 'targets': TARGETS, **rows})


if __name__ == '__main__':
    main()
