# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Hostile settings and results: answers, sweeps, parts, charts, maps, autopilots, fits."""

import io
import json
from pathlib import Path
from random import Random
from typing import Any

import yaml

from test.support.hostile import values
from test.support.paths import ROOT

KINDS = ('answers', 'sweep', 'autopilot', 'vehicle', 'chart', 'map', 'resume', 'part')
ENDINGS = {'chart': 'json', 'map': 'jsonl', 'resume': 'json', 'part': 'parquet'}
_ANSWERS = """\
name: rov
medium: water
mass: 30
center_of_mass: [0, 0, -0.02]
inertia: [0.2, 0.3, 0.4]
unit: m
hull: collision
fluid_density: 1000
buoyancy: 5
thrusters: [{link: screw, max_thrust: 20, max_reverse: 10, spin: cw, direction: [1, 0, 0]}]
fins: [{link: fin, span: 0.3, chord: 0.1, along: [0, 1, 0]}]
servos: {j: {stiffness: 10, lag: 0.1}}
fixed: [a]
sensors: [imu, dvl]
panels: 40
"""
_SWEEP = """\
scene: sphere
duration: 0.1
seed: 1
runs: 2
hold: {law: multirotor, target: [0, 0, 1.5], rate: 100}
vary:
  timestep: {values: [0.001, 0.002]}
  wind.x: {uniform: [-8, 8]}
  wind.y: {linspace: [0, 1, 3]}
  mass.sphere: {normal: [1.1, 0.05]}
  gain.integral: {loguniform: [3.0, 6.0]}
"""
_SPECIAL = (
    '{linspace: [0, 1, 1000000000000]}', '{linspace: [0, 1, 9000000]}',
    '{linspace: [0, 1e308, 5]}',
    '{uniform: [-1e308, 1e308]}', '{values: [' + '1,' * 100_000 + ']}', '{normal: [1e308, 1e308]}',
    '{loguniform: [5e-324, 1e308]}', '{values: [yes, no]}', '{values: [2020-01-01]}',
)  # fmt: skip


def hostile_settings(kind: str, random: Random, outside: str) -> bytes:
    """
    Return a hostile file.

    Parameters
    ----------
    kind
        One of ``KINDS``.
    random
        Source of choices.
    outside
        Path of a file that must not be read or written.

    """
    if kind == 'part':
        return _part(random)
    if kind in ('chart', 'map', 'resume'):
        return _json(kind, random, outside)
    text = {
        'answers': _ANSWERS, 'sweep': _SWEEP,
        'autopilot': _read('autopilots/px4_x500.yaml'), 'vehicle': _read('vehicles/x500.yaml'),
    }[kind]  # fmt: skip
    if random.random() < 0.2:
        lines = text.splitlines()
        at = random.randrange(len(lines))
        lines[at] = lines[at].partition(':')[0] + ': ' + random.choice((*_SPECIAL, outside))
        return '\n'.join(lines).encode()
    tree = yaml.safe_load(text)
    for _ in range(random.choice((1, 1, 2, 4))):
        tree = values.mutated(random, tree)
    try:
        data = yaml.safe_dump(tree, allow_unicode=True).encode('utf-8', 'surrogatepass')
    except (RecursionError, ValueError):
        data = b'- ' * 3000
    return values.damaged(random, data) if random.random() < 0.2 else data


def _read(name: str) -> str:
    return (ROOT / 'config' / name).read_text(encoding='utf-8')


def _json(kind: str, random: Random, outside: str) -> bytes:
    special = random.random()
    if special < 0.1:
        return random.choice((
            b'', b'{', b'[' * 100_000, b'{"points":' * 100_000, b'NaN', b'null', b'\xff\xfe',
            b'{"points": [], "problem": 5}', b'9' * 10_000, b'{"points": {}, "problem": "a"}',
        ))  # fmt: skip
    tree: Any = {
        'chart': _chart, 'map': lambda: {'problem': 'plate', 'x': 'timestep', 'y': 'size'},
        'resume': lambda: {'drag': 1.0, 'mass': 2.0},
    }[kind]()  # fmt: skip
    if kind == 'chart' and special < 0.3:
        tree['problem'] = random.choice((
            '../../a', f'{outside}', '/tmp/x', '..', '.', '', 'a/b', 'x' * 300, '\x00', 'a\nb',
            '[bold]a', '</script><script>alert(1)</script>', '\x1b[2J', 'con', '~', '-rf',
        ))  # fmt: skip
    else:
        for _ in range(random.choice((1, 1, 3))):
            tree = values.mutated(random, tree)
    try:
        data = json.dumps(tree).encode('utf-8', 'replace')
    except (ValueError, RecursionError):
        data = b'[' * 3000
    if kind == 'map':
        row = {'integrator': 'RK4', 'x': 0.1, 'y': 1.0, 'outcome': 'stable', 'largest': 1.0,
               'last': 1.0, 'reset_at_s': None, 'alarm': False}  # fmt: skip
        rows = [values.mutated(random, dict(row)) for _ in range(3)]
        honest = json.dumps({'problem': 'plate', 'x': 'timestep', 'y': 'size'}).encode()
        lines = [honest if random.random() < 0.8 else data]
        for each in rows:
            try:
                lines.append(json.dumps(each).encode('utf-8', 'replace'))
            except (ValueError, RecursionError):
                lines.append(b'{' * 3000)
        data = b'\n'.join(lines)
    return values.damaged(random, data) if random.random() < 0.2 else data


def _chart() -> dict[str, Any]:
    charts = json.loads((Path(__file__).parent / 'chart.json').read_text(encoding='utf-8'))
    found: dict[str, Any] = charts
    return found


def _part(random: Random) -> bytes:
    """Return a part of a sweep whose digest is right and whose rows are not."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    rows: dict[str, Any] = {
        'run': [0, 1], 'status': ['done', 'done'], 'warnings': ['', ''], 'x.speed': [1.0, 2.0],
    }  # fmt: skip
    for _ in range(random.randrange(1, 3)):
        name = random.choice((*rows, values.text(random)[:200]))
        rows[name.encode('utf-8', 'replace').decode()] = random.choice((
            [None, None], ['a', 'b'], [5, 6], [-1, 2**62], [0.5, float('nan')], [[1], [2]],
            [{'a': 1}] * 2, [b'\xff', b''], [True, False], [0, 0],
        ))  # fmt: skip
    if random.random() < 0.1:
        rows = {'run': pa.array(range(5_000_000))}
    buffer = io.BytesIO()
    pq.write_table(pa.table(rows), buffer, write_page_checksum=True)
    data = buffer.getvalue()
    return values.damaged(random, data) if random.random() < 0.2 else data
