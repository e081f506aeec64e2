# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Text of others in messages: one line, nothing that a terminal acts on, cut."""

import datetime
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fluid_sim_ros.errors import (
    MOST_LINE,
    MOST_NAMES,
    MOST_TEXT,
    ConfigError,
    listed,
    printable,
)


@pytest.mark.parametrize(
    ('text', 'shown'),
    [
        ('hull 2', 'hull 2'),
        ('Schiff é 日本', 'Schiff é 日本'),
        ('a\x1b[2Jb', 'a\\x1b[2Jb'),
        ('two\nlines\r\t', 'two\\nlines\\r\\t'),
        ('\x07\x00\x9b31m', '\\x07\\x00\\x9b31m'),
        ('txt.\u202egpj', 'txt.\\u202egpj'),  # shown from right to left
        ('zero\u200bwidth\ufeff', 'zero\\u200bwidth\\ufeff'),
        ('half \ud800', 'half \\ud800'),
        (b'\x1b]0;title\x07', "b'\\x1b]0;title\\x07'"),
        (-1.5, '-1.5'),
        (None, 'None'),
        (True, 'True'),
        (datetime.date(2020, 1, 2), 'datetime.date(2020, 1, 2)'),
        (object(), '<object>'),
        (10**400, 'a number of about 399 digits'),
    ],
)
def test_text_is_shown_on_one_line_without_control(text, shown):
    assert printable(text) == shown


def test_long_text_is_cut_and_says_so():
    shown = printable('n' * 1_000_000)
    assert shown == 'n' * MOST_TEXT + f'... ({1_000_000 - MOST_TEXT} more characters)'
    assert len(printable('\x1b' * 1_000_000)) < 5 * MOST_TEXT


@pytest.mark.parametrize('make', [list, tuple, lambda parts: dict(enumerate(parts))])
def test_a_value_that_would_fill_the_memory_costs_nothing(make):
    value = make(['x'])
    for _ in range(60):
        value = make([value] * 9)
    begin = time.process_time()
    assert len(printable(value)) < 2 * MOST_TEXT
    assert time.process_time() - begin < 0.1
    assert len(printable(10**100_000)) < MOST_TEXT


@given(st.text() | st.binary() | st.recursive(st.integers(), st.lists))
def test_whatever_it_is_a_terminal_may_have_it(value):
    shown = printable(value)
    assert shown.isprintable()
    assert len(shown) < 12 * MOST_TEXT


def test_names_of_others_in_a_list():
    assert listed(['a', 'b\x1b']) == 'a, b\\x1b'
    assert listed([]) == '(none)'
    many = listed(f'n{i}' for i in range(1000))
    assert many.endswith(f'n{MOST_NAMES - 1}, and {1000 - MOST_NAMES} more')
    assert len(listed(['x' * 10**6] * 1000)) < 200 * MOST_NAMES


@pytest.mark.parametrize(
    'name', ['x' * 100_000, 'two words ' * 10_000, "it's " * 30_000, '\x1b' * 5000]
)
def test_behind_a_long_name_it_is_still_said_what_is_allowed(name):
    """Found by the hostile files: a keyframe of 100,000 letters, and nothing behind it."""
    line = str(ConfigError(f"a.yaml: keyframe '{name}' is not in the model; it has: hover, land"))
    assert len(line) < MOST_LINE + 100 and line.isprintable()
    assert line.startswith("a.yaml: keyframe '")
    if "'" not in name:
        assert line.endswith("more characters)' is not in the model; it has: hover, land")


def test_a_message_of_usual_length_stays_as_it_is():
    line = f"file '/{'folder/' * 60}a.xml' is not there"
    assert str(ConfigError(line)) == line
