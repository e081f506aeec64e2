# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Each kind of hostile file by name: how one is made, and what is done with it."""

import hashlib
from collections.abc import Callable
from pathlib import Path
from random import Random

from fluid_sim_ros.cli.main import main
from test.support.hostile.foreign import flights, meshes, robots, settings

#: Name -> ending of the file.
KINDS = (
    {kind: kind for kind in meshes.KINDS}
    | {kind: 'xml' if kind == 'mjcf' else kind for kind in robots.KINDS}
    | {kind: flights.ENDINGS.get(kind, kind) for kind in flights.KINDS}
    | {kind: settings.ENDINGS.get(kind, 'yaml') for kind in settings.KINDS}
)

#: Kind -> what makes a file of it, of the kind, choices, and the path of a file outside.
_MAKERS: dict[str, Callable[[str, Random, str], bytes]] = {
    **dict.fromkeys(meshes.KINDS, meshes.hostile_mesh),
    **dict.fromkeys(robots.KINDS, robots.hostile_robot),
    **dict.fromkeys(flights.KINDS, lambda kind, random, _: flights.hostile_flight(kind, random)),
    **dict.fromkeys(settings.KINDS, settings.hostile_settings),
}


def foreign_file(kind: str, seed: int, folder: Path, outside: Path) -> Path:
    """
    Write the hostile file of a seed.

    Parameters
    ----------
    kind
        One of ``KINDS``.
    seed
        A whole number.
    folder
        Where it is written.
    outside
        A file that must not be read.

    """
    random = Random(f'{kind} {seed}')
    path = folder / f'a.{KINDS[kind]}'
    path.write_bytes(_MAKERS[kind](kind, random, str(outside)))
    return path


def opened(kind: str, path: Path, seed: int) -> object:
    """
    Open a hostile file as its commands do.

    Parameters
    ----------
    kind
        One of ``KINDS``.
    path
        The file.
    seed
        Of the file. A mesh is read in a process of its own, which takes a second to start: one of
        ten is, the others are read by the same functions here.

    """
    if kind in meshes.KINDS:
        from fluid_sim_ros.hydro.meshes.reader_process import solid_of_file
        from fluid_sim_ros.hydro.meshes.reading import read_mesh

        return solid_of_file(path, 0.0) if seed % 10 else read_mesh(path)
    if kind in robots.KINDS:
        return _robot(path)
    if kind == 'mapping':
        table = path.with_name('flight.csv')
        table.write_bytes(flights.honest_table())
        return main(['info', str(table), '--mapping', str(path)])
    if kind in flights.KINDS:
        return main(['info', str(path), '--json', str(path.with_name('info.json'))])
    return _SETTINGS[kind](path)


def _robot(path: Path) -> object:
    from fluid_sim_ros.new_vehicle.importing.answers import answers_of
    from fluid_sim_ros.new_vehicle.importing.other_sources import read_source
    from fluid_sim_ros.new_vehicle.importing.skeleton import skeleton_of

    answers = answers_of(None, {'medium': 'water', 'mass': 30.0})
    return skeleton_of(read_source(path, [], None, None), answers)


def _answers(path: Path) -> object:
    from fluid_sim_ros.new_vehicle.importing.answers import answers_of

    return answers_of(path, {'medium': 'water'})


def _sweep(path: Path) -> object:
    from fluid_sim_ros.sweep.sweep_file import Cases, read_sweep

    cases = Cases(read_sweep(path))
    return [cases[index] for index in (0, len(cases) - 1)]


def _autopilot(path: Path) -> object:
    from fluid_sim_ros.mavlink.mapping import load_mapping

    return load_mapping('px4', 'x500', str(path))


def _vehicle(path: Path) -> object:
    from fluid_sim_ros.scene.vehicle_files import vehicle_file

    return vehicle_file(str(path), path)


def _chart(path: Path) -> object:
    return main(['chart', '--from', str(path), '--out', str(path.parent / 'out')])


def _map(path: Path) -> object:
    from fluid_sim_ros.lab.stability.stability_map import _kept

    planned = frozenset({('RK4', 0.1, 1.0)})
    return _kept({'problem': 'plate', 'x': 'timestep', 'y': 'size'}, path, planned)


def _resume(path: Path) -> object:
    from fluid_sim_ros.cli.reality.fit import _kept

    return _kept(path)


def _part(path: Path) -> object:
    from fluid_sim_ros.sweep.results import Results
    from test.support.sweeps import sweep_of

    parts = path.parent / 'out' / 'parts'
    parts.mkdir(parents=True)
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:16]
    path.rename(parts / f'000000000-{digest}.parquet')
    results = Results(path.parent / 'out', sweep_of(runs=2))
    return results.kept() and results.finish()


_SETTINGS: dict[str, Callable[[Path], object]] = {
    'answers': _answers, 'sweep': _sweep, 'autopilot': _autopilot, 'vehicle': _vehicle,
    'chart': _chart, 'map': _map, 'resume': _resume, 'part': _part,
}  # fmt: skip
