# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Hostile files of each kind that scenes name: YAML, NPZ, NetCDF, CSV, MJCF."""

import io
import math
import struct
import tempfile
import zipfile
from pathlib import Path
from random import Random

import numpy as np
import yaml
from scipy.io import netcdf_file

from test.support.hostile import values

KINDS = ('yaml', 'npz', 'nc', 'csv', 'xml')

_SCENE = """\
model: quadrotor
description: a test
medium: air
timestep: 0.002
duration: 1.5
keyframe: hover
vehicles:
  x500: {body: x500, thrusters: [m1, m2, m3, m4], sensors: {imu: {rate: 100}}}
wind:
  - {model: steady, velocity: [1, 0, 0]}
  - {model: gust, amplitude: [0, 3, 0], start: 1.0, length: 10, airspeed: 6, hold: 2}
schedule:
  - {at: 0.5, wind: [0.1, 0.2, 0.3]}
  - {at: 1.0, wrench: {x500: {force: [1, 2, 3], frame: map}}}
home: {latitude: 47.3, longitude: 8.5}
"""
_YAML = (
    '&a', '*a', '!!python/object/apply:os.system [id]', '!!int', '!!float', '!!binary', '!x',
    '<<:', '? ', ': ', '- ', '[', ']', '{', '}', '|', '>', '---\n', '...\n', '%YAML 3\n', '\t',
    '#', "'",
    '2020-13-45', '2020-02-30T99:00:00', '.nan', '-.inf', '0b2', '0x', '1:99:99', '"\\x', '~',
    '9' * 400, '[' * 3000, '{a: ' * 3000, '- ' * 3000, '!!set {a}', '!!omap [a: 1]', '"\\e[2J"',
    '1e-400000000',
    '&a [' + '*a,' * 5 + ']', '\n'.join(f'k{i}: &k{i} [{", ".join([f"*k{i - 1}"] * 9)}]' if i else
                                      'k0: &k0 [x]' for i in range(12)),
)  # fmt: skip


def hostile_file(kind: str, seed: int, folder: Path) -> Path:
    """Write the hostile file of a seed; return the scene (YAML) or model that leads to it."""
    random = Random(f'{kind} {seed}')
    path = folder / f'a.{kind}'
    path.write_bytes(_MAKERS[kind](random))
    if kind in ('yaml', 'xml'):
        return path
    model = 'series' if kind == 'csv' else 'grid'
    scene = folder / 'scene.yaml'
    scene.write_text(f'model: sphere\ncurrent: [{{model: {model}, file: a.{kind}}}]\n')
    return scene


def _yaml(random: Random) -> bytes:
    if random.random() < 0.5:  # right as YAML, wrong as a scene
        tree = yaml.safe_load(_SCENE)
        for _ in range(random.choice((1, 1, 2))):
            tree = values.mutated(random, tree)
        try:
            return yaml.safe_dump(tree, allow_unicode=True).encode('utf-8', 'surrogatepass')
        except (RecursionError, ValueError):  # lists in lists in lists
            return b'- ' * 3000
    lines = _SCENE.splitlines()
    for _ in range(random.choice((1, 1, 2, 4))):
        at = random.randrange(len(lines))
        kind = random.randrange(5)
        if kind == 0:
            lines.insert(at, random.choice(_YAML))
        elif kind == 1:
            place = random.randrange(len(lines[at]) + 1)
            lines[at] = lines[at][:place] + random.choice(_YAML) + lines[at][place:]
        elif kind == 2:
            key, colon, _ = lines[at].partition(':')
            made = random.choice((values.text(random), str(values.number(random)), '[]', '{}'))
            lines[at] = f'{key}{colon} {made}'
        elif kind == 3:
            lines[at : at + 1] = [lines[at]] * random.choice((0, 2, 30_000))
        else:
            lines[at] = values.text(random)
    data = '\n'.join(lines).encode('utf-8', 'surrogatepass')
    return values.damaged(random, data) if random.random() < 0.1 else data


def _arrays(random: Random) -> dict[str, np.ndarray]:
    shape = [random.randrange(1, 5) for _ in range(4)]
    axes = {name: np.arange(size) * 1.5 for name, size in zip('txyz', shape, strict=True)}
    found = {**axes, **{name: np.ones(shape) for name in 'uvw'}}
    for _ in range(random.randrange(3)):
        name = random.choice(list(found))
        array = np.atleast_1d(found[name])
        if array.dtype.kind != 'f':
            continue
        found[name] = random.choice((
            array[:0], array.astype('U3'), array.astype(complex), array.astype('>f2'),
            array[..., None], array * float('nan'), array * 1e308 * 10, np.array(5.0),
            array.astype('M8[s]'),
            np.zeros((3, 0, 2)), np.array([{}], dtype=object), array.astype(bool), array.T,
            np.zeros(2, dtype=[('a', 'f8')]), np.zeros(1000),
        ))  # fmt: skip
    return found


def _npz(random: Random) -> bytes:
    buffer = io.BytesIO()
    with np.errstate(all='ignore'):
        arrays = _arrays(random)
    kind = random.randrange(4)
    if kind == 0:
        np.savez_compressed(buffer, allow_pickle=True, **arrays)
        return values.damaged(random, buffer.getvalue())
    stored, deflated, bzip2, lzma = (
        zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA
    )  # fmt: skip
    method = random.choice((stored, deflated, bzip2, lzma))
    with zipfile.ZipFile(buffer, 'w', method) as archive:
        for name, array in arrays.items():
            member = io.BytesIO()
            np.save(member, array, allow_pickle=True)
            data = member.getvalue()
            if random.random() < 0.2:
                data = _lying_head(random)
            elif random.random() < 0.1:
                data = values.damaged(random, data)
            archive.writestr(f'{name}.npy', data)
            if random.random() < 0.05:
                archive.writestr(f'{name}.npy', data)
    data = buffer.getvalue()
    if kind == 1:  # other methods and flags in the directory than there are
        data = bytearray(data)
        at = data.rfind(b'PK\x01\x02')
        data[at + random.choice((8, 10, 16, 20, 24, 42))] ^= random.choice((1, 8, 255))
        data = bytes(data)
    return data


def _lying_head(random: Random) -> bytes:
    shape = random.choice((
        '(1000000000000,)', '(2, 2, 2, 2)', '(-1,)', '(99999999999999999999999999,)', '()',
        '(1e9,)',
        '(' + '1,' * 3000 + ')', "('a',)", '(0, 10000000000)', '(True,)', '(' * 2000, '[3]',
    ))  # fmt: skip
    dtype = random.choice(
        ('<f8', '|O', '<U1000000000', 'V99999999999', '>i2', '<m8[ns]', 'x', '<f16')
    )
    head = f"{{'descr': '{dtype}', 'fortran_order': {random.choice(('False', 'True', '5'))}, "
    head = (head + f"'shape': {shape}, }}").ljust(117) + '\n'
    count = random.choice((0, 1000, 200_000_000)) if random.random() < 0.05 else 64
    version = random.choice((b'\x01\x00', b'\x01\x00', b'\x02\x00', b'\x03\x00', b'\x09\x00'))
    return b'\x93NUMPY' + version + struct.pack('<H', len(head)) + head.encode() + bytes(count)


def _nc(random: Random) -> bytes:
    with tempfile.NamedTemporaryFile() as written:
        _write_netcdf(random, written.name)
        data = Path(written.name).read_bytes()
    for _ in range(random.choice((0, 0, 1, 1, 3))):
        data = values.damaged(random, data)
    if random.random() < 0.3:  # its lengths are big-endian
        at = random.randrange(4, len(data) + 5)
        made = random.choice((b'\xff' * 4, b'\x7f\xff\xff\xff', bytes(4)))
        data = data[:at] + made + data[at + 4 :]
    return data


def _write_netcdf(random: Random, path: str) -> None:
    with netcdf_file(path, 'w') as file:
        sizes = {name: random.randrange(1, 5) for name in 'txyz'}
        for name, size in sizes.items():
            file.createDimension(name, None if name == 't' and random.random() < 0.3 else size)
            axis = file.createVariable(name, random.choice('dfi'), (name,))
            axis[:] = np.arange(size)
            odd = values.text(random).encode('utf-8', 'replace')[:99]
            right = b's' if name == 't' else b'm'
            axis.units = (
                right if random.random() < 0.9 else random.choice((b'furlong', odd or b'?'))
            )
        for name in 'uvw':
            dimensions = random.choice(('txyz', 'zyxt', 'tx', 'xyz'))
            if file.dimensions['t'] is None:
                dimensions = 't' + dimensions.replace('t', '')
            variable = file.createVariable(name, random.choice('dfhb'), tuple(dimensions))
            variable[:] = np.ones([sizes[d] for d in dimensions])
            if random.random() < 0.3:
                key = random.choice(('scale_factor', 'add_offset', 'missing_value', '_FillValue'))
                if variable.typecode() in 'df' or key in ('scale_factor', 'add_offset'):
                    setattr(variable, key, random.choice((2.0, np.ones(5), math.nan, 1)))


def _csv(random: Random) -> bytes:
    lines = ['t,x,y,z', '0,1,2,3', '1,1,2,3', '2.5,0,0,0']
    for _ in range(random.randrange(1, 4)):
        at = random.randrange(len(lines))
        cells = lines[at].split(',')
        made = random.choice(
            (values.text(random), str(values.number(random)), '', '"', '1,2', '\x00')
        )
        cells[random.randrange(len(cells))] = made
        lines[at] = random.choice((',', ';', '\t', ', '))[:1].join(cells)
        if random.random() < 0.1:
            lines[at:at] = [lines[at]] * 20_000
    return '\n'.join(lines).encode('utf-8', 'surrogatepass')


_MODEL = """\
<mujoco><option density="1000" viscosity="0.001" timestep="0.002"/>
<asset><texture name="t" type="2d" builtin="flat" width="8" height="8"/>
<mesh name="m" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>
<worldbody><body name="b" pos="0 0 1"><freejoint/><geom name="g" type="sphere" size="0.1" mass="1"
fluidshape="ellipsoid"/><site name="s"/></body></worldbody>
<actuator><motor name="a" site="s" gear="0 0 1 0 0 0" ctrlrange="-1 1"/></actuator>
<keyframe><key name="k" qpos="0 0 1 1 0 0 0"/></keyframe></mujoco>
"""


def _xml(random: Random) -> bytes:
    text = _MODEL
    for _ in range(random.choice((1, 1, 2))):
        at = text.find('"', random.randrange(len(text)))
        end = text.find('"', at + 1)
        made = random.choice((values.text(random)[:500], str(values.number(random)), '0 0 0', ''))
        if 0 <= at < end:
            text = text[: at + 1] + made.replace('"', '') + text[end:]
    data = text.encode('utf-8', 'replace')
    return values.damaged(random, data) if random.random() < 0.3 else data


_MAKERS = {'yaml': _yaml, 'npz': _npz, 'nc': _nc, 'csv': _csv, 'xml': _xml}
