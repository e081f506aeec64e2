# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Fingerprints of what every scene computes and of what a recorded flight writes, to compare trees.

Each scene flies with each integrator under seeded commands; its states, wrenches, poses and sensor
readings go into one hash. Two recorded flights go into one hash per topic. Two trees compute the
same to the last bit where their fingerprints are equal. Fingerprints depend on the processor and
the mathematical library, so make both on one machine:

    python -m benchmarks.simulation.trajectory_bits --json before.json          # in the old tree
    python -m benchmarks.simulation.trajectory_bits --against before.json       # in the new tree
"""

import argparse
import hashlib
import json
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from fluid_sim_ros import Simulation, scene_names
from fluid_sim_ros.cli import main as fluid_sim
from fluid_sim_ros.errors import FluidSimError

INTEGRATORS = (None, 'RK4', 'implicitfast', 'Euler', 'implicit')
FLUIDS = ('none', 'inertia', 'no_added_mass')
STEPS, BLOCK = 400, 10
FLIGHTS = {
    'x500_turbulence': ('--duration', '2', '--seed', '3', '--record-topics', '*'),
    'bluerov2_waves': ('--duration', '2', '--seed', '5', '--current', '.2', '.1', '0'),
    'aerosonde_turbulence': ('--duration', '1', '--integrator', 'RK4'),
}


def flight_hash(scene: str, **settings: Any) -> str:
    """Return the hash of a scene's flight under seeded commands."""
    simulation = Simulation(scene, seed=7, **settings)
    rng = np.random.default_rng(11)
    seen = hashlib.sha256()
    for block in range(STEPS // BLOCK):
        for name, vehicle in simulation.vehicles.items():
            for ranges, command in (
                (vehicle.thrust_range, simulation.set_thrust),
                (vehicle.joint_range, simulation.set_joints),
            ):
                low, high = np.clip(ranges, -1.0, 1.0).T
                if len(low):
                    command(name, low + (high - low) * rng.uniform(size=len(low)))
            if block % 4 == 0 and vehicle.dof_address >= 0:
                force, torque = 0.05 * rng.normal(size=(2, 3))
                simulation.set_wrench(name, force, torque, 'base_link')
        simulation.step(BLOCK)
        seen.update(simulation.data.qpos.tobytes())
        for name in simulation.vehicles:
            for force, torque in simulation.wrench(name).values():
                seen.update(force.tobytes() + torque.tobytes())
        for state in simulation.snapshot().vehicles.values():
            seen.update(state.velocity_b.tobytes() + state.medium_velocity_w.tobytes())
    seen.update(simulation.save_state().engine.tobytes())
    return seen.hexdigest()[:16]


def outcome(scene: str, **settings: Any) -> str:
    """Return the hash of a flight, or the name of the error that ended it."""
    try:
        return flight_hash(scene, **settings)
    except (FluidSimError, ValueError) as error:  # an error is a result to compare as well
        return type(error).__name__


def record(scene: str, options: tuple[str, ...]) -> dict[str, str]:
    """Return a hash of the messages (time and bytes) of each topic of a recorded flight."""
    from mcap.reader import make_reader

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'flight.mcap'
        fluid_sim(['run', scene, '--record', str(path), '--json', f'{folder}/o', *options])
        topics: dict[str, Any] = defaultdict(hashlib.sha256)
        with path.open('rb') as file:
            for _, channel, message in make_reader(file).iter_messages():
                stamp = f'{message.log_time} '.encode()  # publish_time is wall time
                topics[channel.topic].update(stamp + message.data)
    return {topic: seen.hexdigest()[:16] for topic, seen in sorted(topics.items())}


def fingerprints(chosen: Iterable[str]) -> dict[str, Any]:
    """Return the fingerprints of scenes and of recorded flights."""
    scenes: dict[str, dict[str, str]] = {}
    for scene in chosen:
        flights = {str(name or 'its own'): outcome(scene, integrator=name) for name in INTEGRATORS}
        flights |= {f'fluid {fluid}': outcome(scene, fluid=fluid) for fluid in FLUIDS}
        scenes[scene] = flights
    logs = {scene: record(scene, options) for scene, options in FLIGHTS.items()}
    return {'scenes': scenes, 'logs': logs}


def differences(old: Any, new: Any, where: str = '') -> list[str]:
    """Return a line for every fingerprint that differs or stands on one side alone."""
    if isinstance(old, dict) and isinstance(new, dict):
        keys = [*old, *(key for key in new if key not in old)]
        return [
            line
            for key in keys
            for line in differences(old.get(key), new.get(key), f'{where}/{key}')
        ]
    return [] if old == new else [f'{where}: {old} -> {new}']


if __name__ == '__main__':
    parser = argparse.ArgumentParser(description=(__doc__ or '').strip().splitlines()[0])
    parser.add_argument('--json', type=Path, help='write the fingerprints')
    parser.add_argument('--against', type=Path, help='compare with those of another tree')
    given = parser.parse_args()
    # a scene that is new has nothing to be compared with
    old = json.loads(given.against.read_text(encoding='utf-8')) if given.against else {}
    found = fingerprints(old['scenes'] if old and not given.json else scene_names())
    if given.json:
        given.json.write_text(json.dumps(found, indent=1) + '\n', encoding='utf-8')
    if given.against:
        known = {key: {n: v for n, v in found[key].items() if n in old[key]} for key in found}
        lines = differences(old, known)
        count = sum(map(len, found['scenes'].values())) + sum(map(len, found['logs'].values()))
        print(*lines, f'{count} fingerprints, {len(lines)} differ', sep='\n')
        sys.exit(1 if lines else 0)
