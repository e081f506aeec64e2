# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Hostile logs of flights by other software, and mappings that say what is in them."""

import io
import struct
from functools import cache
from random import Random

import numpy as np
import yaml

from test.support import flight_logs as logs
from test.support import log_files as mcap
from test.support.hostile import values
from test.support.paths import ROOT

KINDS = ('ulg', 'bin', 'usd', 'flight_csv', 'parquet', 'bag', 'mapping')
#: Ends of file names.
ENDINGS = {'flight_csv': 'csv', 'bag': 'mcap', 'mapping': 'yaml'}
_NAMES = ('x' * 255, '', '\x1b[31m', '../../etc/passwd', '=1+1', '[bold]', 'a,b', '\n', '%s%n')
_LENGTHS = (0, 1, 2, 255, 2**16 - 1, 2**31 - 1, 2**32 - 1)


@cache
def _motion() -> logs.Motion:
    return logs.motion(seconds=1.0, rate=50.0)


def hostile_flight(kind: str, random: Random) -> bytes:
    """
    Return a hostile log, or for ``mapping`` the YAML file beside an honest one.

    Parameters
    ----------
    kind
        One of ``KINDS``.
    random
        Source of choices.

    """
    data = _MAKERS[kind](random)
    for _ in range(random.choice((0, 0, 1, 1, 3))):
        data = values.damaged(random, data)
    return data


def honest_table() -> bytes:
    """Return an honest log, as CSV."""
    return logs.csv_text(logs.table(_motion())).encode()


@cache
def _honest_ulog() -> bytes:
    return logs.ulog(logs.px4(_motion()))


def _ulog(random: Random) -> bytes:
    kind = random.randrange(4)
    if kind == 0:
        topics = logs.px4(_motion())
        name = random.choice(list(topics))
        times, fields = topics.pop(name)
        bad = np.full(len(times), random.choice((np.nan, np.inf, 1e30, -1e-30, 0.0)))
        fields = {
            random.choice((*_NAMES, key)): (letter, bad) for key, (letter, _) in fields.items()
        }
        step = random.choice((times, times * 0, times[::-1], times * 1e9))
        return logs.ulog(topics | {random.choice((*_NAMES[:4], name)): (step, fields)})
    data = _honest_ulog()
    if kind == 1:  # messages of every kind, with lengths that lie
        extra = b''
        for _ in range(random.randrange(1, 20)):
            body = random.randbytes(random.choice((0, 3, 40)))
            size = random.choice((len(body), *_LENGTHS)) % 2**16
            extra += struct.pack('<HB', size, random.choice(b'BFIMPQALRDSCOTXx\0')) + body
        at = random.choice((16, len(data)))
        return data[:at] + extra + data[at:]
    if kind == 2:  # formats that are of themselves, huge, or of unknown types
        texts = (
            'a:a x;', 'a:b x;b:a y;', 'a:uint64_t timestamp;float[1000000000] x;', 'a:;', ':', 'a',
            'a:zzz x;', 'a:float[-1] x;', 'a:float[x] y;', 'a:uint64_t timestamp;' * 5000,
            'vehicle_attitude:uint64_t timestamp;char[65535] q;', 'a:' + 'x' * 60_000,
        )  # fmt: skip
        text = random.choice(texts).encode()[: 2**16 - 1]
        made = struct.pack('<HB', len(text), ord('F')) + text
        made += struct.pack('<HBBH', 4, ord('A'), 0, 900) + b'a'
        made += struct.pack('<HBH', 10, ord('D'), 900) + bytes(8)
        return data[:16] + made + data[16:]
    return data


@cache
def _honest_dataflash() -> bytes:
    return logs.dataflash(logs.ardupilot(_motion()))


def _dataflash(random: Random) -> bytes:
    data = _honest_dataflash()
    kind = random.randrange(3)
    if kind == 0:  # descriptions that lie
        letters = random.choice(('Q', 'ZZZZ', 'a' * 16, '\xff', '', 'QfffffffffffffffX', 'M', 'g'))
        columns = random.choice(('', 'TimeUS', 'A,' * 31, 'TimeUS,' * 9, *_NAMES))
        made = struct.pack(
            '<BBBBB4s16s64s', 0xA3, 0x95, 128, random.choice((128, 131, 200)),
            random.choice((0, 3, 11, 89, 255)), random.choice((b'ATT', b'\xff\xff', b'FMT', b'')),
            letters.encode('latin-1')[:16], columns.encode()[:64],
        )  # fmt: skip
        at = random.choice((0, 89, len(data)))
        return data[:at] + made * random.choice((1, 1, 300)) + data[at:]
    if kind == 1:
        messages = logs.ardupilot(_motion())
        name, letters, columns, rows = messages.pop(random.randrange(len(messages)))
        bad = random.choice((np.nan, np.inf, 1e30, 0.0))
        spoilt = [
            (row[0], *(bad if letter == 'f' else word for letter, word in
                       zip(letters[1:], row[1:], strict=True)))
            for row in rows
        ]  # fmt: skip
        return logs.dataflash([*messages, (name, letters, columns, spoilt)])
    return data


def _usd(random: Random) -> bytes:
    data = logs.usd(_motion(), version=random.choice((1, 2)))
    kind = random.randrange(3)
    if kind == 0:
        head = struct.pack(
            '<BHH', 0xBC, random.choice((1, 2, 3, 65535)), random.choice((0, 9, 65535))
        )
        for _ in range(random.randrange(4)):
            name = random.choice(_NAMES).encode() + random.choice((b'\0', b'\0', b''))
            head += struct.pack('<H', random.choice((0, 1, 65535))) + name
            head += struct.pack('<H', random.choice((0, 1, 65535))) + b'a(f)\0b(Q)\0c(?)\0d\0'
        return head + data[5:]
    if kind == 1:
        letters = random.choice((b'(f)', b'(d)', b'(x)', b'()', b'(BBBBBBBBBB)', b'(99999999f)'))
        return data.replace(b'(f)', letters)
    return data


def _csv(random: Random) -> bytes:
    lines = honest_table().decode().splitlines()
    for _ in range(random.choice((1, 2, 4))):
        at = random.choice((0, random.randrange(len(lines))))
        cells = lines[at].split(',')
        made = (
            values.text(random)[:5000],
            str(values.number(random)),
            '',
            '"',
            'nan',
            'inf',
            '1e999',
        )
        cells[random.randrange(len(cells))] = random.choice(made)
        lines[at] = random.choice((',', ';', '\t')).join(cells)
        change = random.random()
        if change < 0.1 and len(lines[at]) < 1000:  # more than what is read, and no more
            lines[at:at] = [lines[at]] * 50_000
        elif change < 0.15:
            lines[0] += ',a' * random.choice((10, 60_000))
        elif change < 0.2:
            lines.reverse()
    return '\n'.join(lines).encode('utf-8', 'surrogatepass')


def _parquet(random: Random) -> bytes:
    import pyarrow as pa
    import pyarrow.parquet as pq

    columns: dict[str, object] = dict(logs.table(_motion()))
    for _ in range(random.randrange(4)):
        name = random.choice(list(columns))
        size = len(_motion().times)
        columns[random.choice((name, name, *_NAMES))] = random.choice((
            ['x'] * size, [None] * size, [[1.0]] * size, [True] * size, [2**63 - 1] * size,
            [{'a': 1}] * size, [b'\xff'] * size, np.full(size, np.nan), np.full(size, 1e308),
            ['y' * 10_000] * size, pa.array([0] * size, pa.timestamp('us')),
            pa.array([0] * size, pa.decimal128(30, 2)), pa.nulls(size),
        ))  # fmt: skip
    if random.random() < 0.1:
        columns = {f'c{i}': [1.0] for i in range(20_000)}
    elif random.random() < 0.1:
        columns = {'time': pa.array([0.0] * 30_000_000)}
    buffer = io.BytesIO()
    kinds = ('snappy', 'gzip', 'zstd', 'none')
    pq.write_table(pa.table(columns), buffer, compression=random.choice(kinds))
    return buffer.getvalue()


def _bag(random: Random) -> bytes:
    definition = random.choice((
        'float64 x', 'geometry_msgs/Pose pose', 'a b' * 9, 'float64[1000000000] x', 'string s',
        'Odometry o\n' * 50, 'uint8[] data', '=' * 80 + '\nMSG: a/B\nfloat64 x',
        values.text(random)[:500],
    ))  # fmt: skip
    name = random.choice((
        'nav_msgs/msg/Odometry', 'sensor_msgs/msg/Imu', 'os/msg/system', 'this/msg/Y',
        values.text(random)[:80],
    ))  # fmt: skip
    topic = random.choice(('/odom', '/imu', '/a/b', values.text(random)[:80]))
    text = definition.encode('utf-8', 'replace')
    heads = [
        mcap.schema(1, name.encode('utf-8', 'replace').decode(), text),
        mcap.channel(1, random.choice((1, 1, 0, 9)), topic.encode('utf-8', 'replace'), {}),
    ]  # fmt: skip
    sizes = (0, 4, 12, 100, 725)
    messages = [
        mcap.message(1, i, i * 10**7, b'\0\1\0\0' + random.randbytes(random.choice(sizes)), 0)
        for i in range(random.choice((1, 50)))
    ]
    return mcap.log_of([mcap.chunk(b''.join(heads + messages), 'zstd')], b'')


def _mapping(random: Random) -> bytes:
    name = random.choice(('table', 'px4', 'ardupilot', 'ros', 'bitcraze', 'fluid_sim'))
    tree = yaml.safe_load((ROOT / 'config' / 'flights' / f'{name}.yaml').read_text())
    for _ in range(random.choice((1, 1, 3))):
        tree = values.mutated(random, tree)
    try:
        return yaml.safe_dump(tree, allow_unicode=True).encode('utf-8', 'surrogatepass')
    except (RecursionError, ValueError):
        return b'- ' * 3000


_MAKERS = {
    'ulg': _ulog, 'bin': _dataflash, 'usd': _usd, 'flight_csv': _csv, 'parquet': _parquet,
    'bag': _bag, 'mapping': _mapping,
}  # fmt: skip
