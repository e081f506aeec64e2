# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Short recorded flights for the tests."""

import json

import numpy as np

from fluid_sim_ros import Simulation
from fluid_sim_ros.loop.pacing import Pacing
from fluid_sim_ros.loop.runner import NoSource, Runner
from fluid_sim_ros.messages.commands import DEFAULTS, MULTI_ARRAY, TWIST, Commands
from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.recording.sink import RecordingSink


def thrust_message(values):
    """Return a std_msgs/Float64MultiArray."""
    return Template.of(MULTI_ARRAY, {'data': values}).bytes()


def wind_message(velocity_w, stamp_ns=0):
    """Return a geometry_msgs/TwistStamped in the frame map."""
    seconds, nanoseconds = divmod(stamp_ns, 10**9)
    return Template.of(
        TWIST,
        {
            'header.stamp': {'sec': seconds, 'nanosec': nanoseconds},
            'header.frame_id': 'map',
            'twist.linear': dict(zip('xyz', velocity_w, strict=True)),
        },
    ).bytes()


class Pilot:
    """A source that sends random thrust, and now and then wind or a current, from a seed."""

    def __init__(self, simulation, sink, seed):
        self._random = np.random.default_rng(seed)
        self._sink = sink
        self._commands = {c.name: c for c in Commands(simulation, DEFAULTS).topics}
        self._thrusters = {
            name: len(v.thrusters) for name, v in simulation.vehicles.items() if v.thrusters
        }

    def poll(self, simulation):
        for vehicle, count in self._thrusters.items():
            self._send(f'{vehicle}/cmd/thrust', thrust_message(self._random.normal(3, 2, count)))
        if self._random.random() < 0.1:
            later = simulation.time_ns + 50_000_000 * int(self._random.integers(0, 2))
            velocity = self._random.normal(0, 1, 3)
            self._send(simulation.streams[0], wind_message(velocity, later))

    def _send(self, name, data):
        self._sink.command(name, data)
        self._commands[name].apply(data)


def record_flight(
    path,
    scene='quadrotor',
    seconds=1.0,
    seed=0,
    piloted=True,
    topics=('*',),
    assets_from=(),
    **options,
):
    """Record a flight; return the simulation at its end."""
    simulation = Simulation(scene, seed=seed, **options)
    sink = RecordingSink(simulation, path, topics=topics, allow_assets_from=assets_from)
    source = Pilot(simulation, sink, seed) if piloted else NoSource()
    try:
        steps = sink.period * round(seconds / sink.period / simulation.timestep)
        Runner(simulation, source, [sink], Pacing()).run(until=steps)
    finally:
        sink.close()
    assert not sink.recorder.fault
    return simulation


def events_of(messages):
    """Return the content of events, from std_msgs/String bytes."""
    return [json.loads(data[8:-1]) for data in messages]
