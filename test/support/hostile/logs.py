# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Logs with right checksums whose records say what no recorder would write."""

import json
import struct
from random import Random
from typing import Any

from fluid_sim_ros.recording.description import MODEL, RUN, STATE
from fluid_sim_ros.recording.log import Log
from test.support import log_files as mcap
from test.support.hostile import values

#: Lines for message definitions.
_LINES = (
    'float64[2000000000] a', 'Empty[2000000000] e', 'A a', 'Nothing n', 'string[] s', 'uint8[] u',
    'int32[999999999999999999999999] i', 'float64 ' + 'n' * 100_000, 'float64 step', 'bool b',
    'geometry_msgs/Pose[] p', 'wstring w', 'float64<=3[<=2] x', '= 5', 'string<=4 s=""',
)  # fmt: skip
_TYPES = (
    '\n' + '=' * 80 + '\nMSG: x/A\nA a\n', '\n' + '=' * 80 + '\nMSG: x/Empty\n',
    '\n' + '=' * 80 + '\nMSG: \x1b[2J\nfloat64 x\n',
    ''.join(f'\n{"=" * 80}\nMSG: x/N{i}\nN{i + 1} n\n' for i in range(200)) + '\nN0 deep\n',
)  # fmt: skip
#: Attributes and elements for models.
_ATTRIBUTES = ('size', 'pos', 'mass', 'count', 'file', 'name', 'density', 'type', 'value', 'class')
_ELEMENTS = (
    '<include file="/etc/passwd"/>', '<include file="m.xml"/>', '<geom size="1e308"/>', '<mujoco>',
    '<body><freejoint/></body>', '<replicate count="100000000"><geom size="1"/></replicate>',
    '<asset><mesh file="/etc/passwd"/></asset>', '<option timestep="-1"/>', '<a>', '</body>',
    '<option timestep="1e-300"/>', '<option density="nan"/>', '<size memory="1000G"/>', '<!--',
    '<option integrator="RK4" iterations="2000000000"/>', '<joint type="ball"/>', ']]>', '\x00',
)  # fmt: skip


class Mutator:
    """
    Makes hostile logs of an honest one.

    Parameters
    ----------
    log
        The honest one.

    """

    def __init__(self, log: Log) -> None:
        attachments, heads, messages = mcap.records_of(log)
        self._attachments = attachments
        self._heads, self._messages = heads, messages

    def log(self, seed: int) -> bytes:
        """Return the hostile log of a seed."""
        random = Random(seed)
        attachments = dict(self._attachments)
        heads, messages = list(self._heads), list(self._messages)
        if random.random() < 0.5:  # a short one is quick, and hits more often
            begin = random.randrange(len(messages))
            messages = messages[begin : begin + random.randrange(1, 60)]
        for _ in range(random.choice((1, 1, 1, 2, 4))):
            change = random.choice((
                self._message, self._message, self._message, self._data, self._data, self._channel,
                self._schema, self._schema, self._records, self._run, self._run, self._run,
                self._state, self._model, self._model, self._attachment,
            ))  # fmt: skip
            change(random, attachments, heads, messages)
        return self._assembled(random, attachments, heads, messages)

    def _assembled(
        self, random: Random, attachments: dict[str, bytes], heads: list[bytes],
        messages: list[bytes],
    ) -> bytes:  # fmt: skip
        records = [mcap.attachment(name, data) for name, data in attachments.items()]
        if random.random() < 0.05:
            records.append(mcap.attachment(RUN, b'{}'))
        middle = random.randrange(len(messages) + 1)
        for part in (heads + messages[:middle], messages[middle:]):
            compression = random.choice(('zstd', 'zstd', '', 'lz4', values.text(random)[:40]))
            records.append(
                mcap.chunk(b''.join(part), compression if random.random() < 0.2 else 'zstd')
            )
        if random.random() < 0.05:
            records.insert(random.randrange(len(records)), _bomb(random))
        if random.random() < 0.05:
            records.append(mcap.record(random.randrange(256), random.randbytes(50)))
        return mcap.log_of(records, _index(random) if random.random() < 0.2 else b'')

    # ---- changes ---------------------------------------------------------------------------

    def _message(self, random: Random, _: Any, __: Any, messages: list[bytes]) -> None:
        at = random.randrange(len(messages)) if messages else 0
        if not messages or len(messages[at]) < 31:  # another change has cut it
            return
        channel, step, log_ns, publish = struct.unpack_from('<HIQQ', messages[at], 9)
        data = messages[at][31:]
        whole = [n for n in values.NUMBERS if isinstance(n, int) and n >= 0]
        which = random.randrange(5)
        channel = random.choice(whole) % 2**16 if which == 0 else channel
        step = random.choice((*whole, 4_000_000_000, step + 10**6)) % 2**32 if which == 1 else step
        log_ns = random.choice(whole) % 2**64 if which == 2 else log_ns
        publish = random.choice(whole) % 2**64 if which == 3 else publish
        data = data if which < 4 else values.damaged(random, data)
        messages[at] = mcap.message(channel, step, log_ns, data, publish)

    def _data(self, random: Random, _: Any, __: Any, messages: list[bytes]) -> None:
        """Damage the data of many messages, such as by numbers that are none."""
        share = random.choice((0.01, 0.1, 1.0))
        for at, record in enumerate(messages):
            if random.random() < share:
                head, data = record[9:31], values.damaged(random, record[31:])
                messages[at] = mcap.record(mcap.MESSAGE, head + data)

    def _channel(self, random: Random, _: Any, heads: list[bytes], __: Any) -> None:
        name = random.choice((values.text(random), '/x500/odom', '/a/b', '/a_b', '/A_b'))
        metadata = {'offered_qos_profiles': random.choice((
            values.text(random), '[' * 500, '- &a [*a]', '- {reliability: [1]}', '5', '- 5',
            'a: &a [x]\nb: &b [' + '*a,' * 50 + ']',
        ))}  # fmt: skip
        number, of = random.randrange(1, 40), random.choice((0, 1, 2, 3, 60000))
        heads.insert(
            random.randrange(len(heads) + 1),
            mcap.channel(number, of, name.encode('utf-8', 'replace'), metadata),
        )

    def _schema(self, random: Random, _: Any, heads: list[bytes], __: Any) -> None:
        at = random.choice([i for i, head in enumerate(heads) if head[0] == mcap.SCHEMA])
        record = heads[at][9:]
        size = int.from_bytes(record[2:6], 'little')
        name = record[6 : 6 + size].decode()
        definition = record[6 + size + 4 + 7 + 4 :].decode(errors='replace').splitlines()
        kind = random.randrange(5)
        if kind == 0:
            name = values.text(random)
        elif kind == 1:
            definition.insert(random.randrange(len(definition) + 1), random.choice(_LINES))
        elif kind == 2:
            definition.append(random.choice(_TYPES))
        elif kind == 3:
            del definition[random.randrange(len(definition))]
        else:
            definition = [values.text(random)] * random.choice((1, 100))
        number = int.from_bytes(record[:2], 'little')
        text = '\n'.join(definition).encode('utf-8', 'replace')
        heads[at] = mcap.schema(number, name.encode('utf-8', 'replace').decode(), text)

    def _records(self, random: Random, _: Any, heads: list[bytes], messages: list[bytes]) -> None:
        """Move, double, cut or make up whole records."""
        part = random.choice((heads, messages))
        if not part:
            return
        at = random.randrange(len(part))
        kind = random.randrange(6)
        if kind == 0:
            part[at : at + random.choice((1, 10))] = []
        elif kind == 1:
            part[at:at] = [part[at]] * random.choice((1, 50))
        elif kind == 2:
            random.shuffle(part)
        elif kind == 3:
            part[at] = part[at][: random.randrange(len(part[at]))]
        elif kind == 4:
            size = random.choice((0, 1, 2**32, 2**63, 2**64 - 1, 10**6))
            part[at] = part[at][:1] + struct.pack('<Q', size) + part[at][9:]
        else:
            part.insert(at, mcap.record(random.randrange(256), random.randbytes(30)))

    def _run(self, random: Random, attachments: dict[str, bytes], _: Any, __: Any) -> None:
        if RUN not in attachments:
            return
        if random.random() < 0.1:
            attachments[RUN] = random.choice((
                b'', b'[]', b'null', b'{', b'\xff', b'[' * 100_000, b'{"a":' * 100_000, b'NaN',
                b'{"format": 1}', b'1' * 10_000, values.damaged(random, attachments[RUN]),
            ))  # fmt: skip
            return
        try:
            run = json.loads(attachments[RUN])
        except (ValueError, RecursionError):
            return
        for _ in range(random.choice((1, 1, 3))):
            run = values.mutated(random, run)
        attachments[RUN] = _json(run)

    def _state(self, random: Random, attachments: dict[str, bytes], _: Any, __: Any) -> None:
        data = attachments.get(STATE, b'')
        attachments[STATE] = random.choice((
            b'', data[:-1], data[:-8], data + bytes(8), values.damaged(random, data),
            bytes(len(data)), b'\xff' * len(data), struct.pack('<d', 1e308) * (len(data) // 8),
            struct.pack('<d', float('inf')) + data[8:],
        ))  # fmt: skip

    def _model(self, random: Random, attachments: dict[str, bytes], _: Any, __: Any) -> None:
        names = [name for name in attachments if name.startswith(MODEL)]
        if not names:
            return
        name = random.choice(names)
        data = attachments[name]
        kind = random.randrange(5)
        if kind == 0 or not name.endswith('.xml'):
            attachments[name] = values.damaged(random, data)
            return
        text = data.decode(errors='replace')
        if kind == 1:
            at = text.find('>', random.randrange(len(text))) + 1
            text = text[:at] + random.choice(_ELEMENTS) + text[at:]
        elif kind == 2:
            key = random.choice(_ATTRIBUTES)
            at = text.find(f' {key}="', random.randrange(len(text)))
            end = text.find('"', at + len(key) + 3)
            made = random.choice((values.text(random), str(values.number(random)), '0 0 0', '-1'))
            if at >= 0:
                text = text[: at + len(key) + 3] + made.replace('"', '') + text[end:]
        elif kind == 3:
            begin = text.find('<', random.randrange(len(text)))
            text = text[:begin] + text[text.find('>', begin) + 1 :]
        else:
            del attachments[name]
            attachments[MODEL + values.text(random)[:60].encode('utf-8', 'replace').decode()] = (
                data
            )
            return
        attachments[name] = text.encode('utf-8', 'replace')

    def _attachment(self, random: Random, attachments: dict[str, bytes], _: Any, __: Any) -> None:
        if attachments and random.random() < 0.5:
            attachments.pop(random.choice(list(attachments)))
            return
        name = values.text(random)[:80].encode('utf-8', 'replace').decode()
        attachments[random.choice(('', MODEL)) + name] = random.randbytes(20)


def _json(value: Any) -> bytes:
    try:
        return json.dumps(value).encode()
    except (ValueError, RecursionError):  # numbers of many digits, deep lists
        return b'[' * 3000 + b'9' * 400


def _bomb(random: Random) -> bytes:
    """Return a chunk that is small in the file: zeros, or many messages of no length."""
    size = random.choice((1 << 20, 1 << 24, 1 << 26, 1 << 28))
    content = random.choice((bytes(size), mcap.message(1, 0, 0, b'') * (size // 31)))
    return mcap.chunk(content)


def _index(random: Random) -> bytes:
    """Return index entries that point anywhere."""
    entries = b''
    for _ in range(random.choice((1, 5, 500))):
        at, length = (random.choice((0, 8, 100, 10**6, 2**63, 2**64 - 1)) for _ in range(2))
        content = struct.pack('<QQQQ', 0, 0, at, length) + struct.pack('<I', 0) * 3
        entries += mcap.record(8, content[: random.choice((3, 32, 44))])
    return entries
