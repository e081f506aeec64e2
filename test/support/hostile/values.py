# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Texts, numbers and structures that readers stumble over."""

from random import Random
from typing import Any

#: Texts for names, paths, values.
TEXTS = (
    '', ' ', '.', '..', '/', '//', '~', '-', '--help', '/etc/passwd', '../../../etc/passwd',
    'a/../../b', 'con', 'NUL', 'a' * 300, 'x' * 100_000, '\x1b[2J\x1b[31mred', '\x1b]0;title\x07',
    '\r\nfluid_sim: ok', '[bold red]hi[/]', '[link=file:///etc]x[/link]', '[/]', '\\', "'", '"',
    '"; rm -rf /', '$(id)', '`id`', '%s%n', '{0.__class__}', '{', '}', '{}', '=1+1', '@SUM(1)',
    '+1', '\x00', 'a\x00b', '\ud7ff\ue000', '\u202eevil', '\u200b', '\U0010ffff', 'ﬁ', 'İ', 'ß',
    '</script><script>alert(1)</script>', '<!--', ']]>', '&amp;', 'NaN', 'nan', 'inf', '-inf',
    '1e999', '1e-400000000', '0x1', '1_0', '1' * 5000, '__import__("os")', 'this/msg/Y',
    'antigravity/msg/X', 'os/msg/system', 'std_msgs/msg/../../os', 'None', 'null', 'true',
    'package://x', 'file:///etc/passwd', 'http://localhost/', 'C:\\x', '\\\\host\\share', 'a\tb',
)  # fmt: skip
#: Numbers for every field.
NUMBERS = (
    0, 1, -1, 2, 255, 256, 2**15, 2**16, 2**31 - 1, 2**31, -(2**31), 2**32 - 1, 2**32, 2**53,
    2**63 - 1, 2**63, 2**64 - 1, 2**64, -(2**63), 10**30, 10**400, 0.0, -0.0, 0.5, 1e-300, 5e-324,
    1e30, 1e300, 1.7976931348623157e308, -1e308, 1e-9, 3.3, float('nan'), float('inf'),
    float('-inf'),
)  # fmt: skip


def number(random: Random) -> Any:
    """Return a number that is seldom seen."""
    return random.choice(NUMBERS)


def text(random: Random) -> str:
    """Return a text that is seldom seen."""
    if random.random() < 0.1:
        return ''.join(
            chr(
                random.choice((0, 9, 10, 27, 34, 39, 91, 93, 123, 0x202E, 0x10FFFF))
                if random.random() < 0.3
                else random.randrange(32, 127)
            )
            for _ in range(random.randrange(40))
        )
    return random.choice(TEXTS)


def value(random: Random, depth: int = 0) -> Any:
    """Return any value that JSON or YAML may hold."""
    kind = random.randrange(9)
    if kind < 3:
        return number(random)
    if kind < 5:
        return text(random)
    if kind == 5:
        return random.choice((None, True, False))
    if kind == 6 or depth > 3:
        deep: Any = []
        for _ in range(random.choice((1, 20, 200, 3000)) if depth == 0 else 1):
            deep = [deep]
        return deep
    if kind == 7:
        return [value(random, depth + 1) for _ in range(random.randrange(5))]
    return {text(random): value(random, depth + 1) for _ in range(random.randrange(4))}


#: Places of a tree that is not made a thousand times larger.
_MANY = 10_000


def mutated(random: Random, tree: Any) -> Any:
    """Return a JSON-like value with one thing in it replaced, taken away, renamed or doubled."""
    places = list(_places(tree)) if isinstance(tree, dict | list) else []
    if not places:
        return value(random)
    owner, key = random.choice(places)
    kind = random.randrange(6)
    if kind == 0 and isinstance(owner, dict):
        owner[text(random)] = owner.pop(key)
    elif kind == 1:
        del owner[key]
    elif kind == 2 and isinstance(owner, list):
        times = random.choice((1, 2, 1000))
        # a thousand times a thousand times a thousand is no file that anybody could send
        owner[key:key] = [owner[key]] * (times if len(places) < _MANY else min(times, 2))
    elif kind == 3 and isinstance(owner[key], int | float):
        owner[key] = number(random)
    elif kind == 4 and isinstance(owner[key], str):
        owner[key] = text(random)
    else:
        owner[key] = value(random)
    return tree


def _places(tree: Any) -> Any:
    waiting = [tree]
    while waiting:
        owner = waiting.pop()
        keys = owner if isinstance(owner, dict) else range(len(owner))
        for key in keys:
            yield owner, key
            if isinstance(owner[key], dict | list):
                waiting.append(owner[key])


def damaged(random: Random, data: bytes) -> bytes:
    """Return bytes with some of them changed, cut, doubled, or read as other lengths."""
    content = bytearray(data)
    for _ in range(random.choice((1, 1, 2, 5))):
        at = random.randrange(len(content) + 1)
        kind = random.randrange(6)
        if kind == 0:
            del content[at:]
        elif kind == 1:
            content[at:at] = random.randbytes(random.choice((1, 4, 100)))
        elif kind == 2:
            del content[at : at + random.choice((1, 4, 8, 100))]
        elif kind == 3:
            content[at : at + 4] = random.choice((0, 1, 2**31, 2**32 - 1, 10**6)).to_bytes(
                4, 'little'
            )
        elif kind == 4:
            content[at : at + 8] = random.choice((
                b'\xff' * 8, bytes(8), b'\x00\x00\x00\x00\x00\x00\xf8\x7f',
                b'\x00\x00\x00\x00\x00\x00\xf0\x7f', b'\xff\xff\xff\xff\xff\xff\xef\x7f',
            ))  # fmt: skip
        elif content:
            content[min(at, len(content) - 1)] ^= random.randrange(1, 256)
    return bytes(content)
