# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import ast

import pytest

from test.packaging.docstrings import faults, lacks
from test.support.paths import ROOT

PACKAGE = ROOT / 'fluid_sim_ros'


def test_public_functions_explain_their_parameters_and_what_they_return():
    assert faults(PACKAGE) == []


SECTION = """Do.

    {title}
    ----------
    {entry}
        Something.

    """


@pytest.mark.parametrize(
    ('signature', 'title', 'entry', 'missing'),
    [
        ('f(a, b)', 'Parameters', 'a, b', []),
        ('f(a: int, b: int)', 'Parameters', 'a : int', ['Parameters: b']),
        ('f(*rows, key=1)', 'Parameters', '*rows', ['Parameters: key']),
        ('f(a, /, b, *, c, **d)', 'Notes', 'a, b, c, d', ['Parameters: a, b, c, d']),
        ('f(self) -> int', 'Returns', 'count', []),
        ('f(self) -> int', 'Raises', 'ValueError', ['Returns']),
        ('f() -> None', 'Raises', 'ValueError', []),
    ],
)
def test_what_sections_lack(signature, title, entry, missing):
    docstring = SECTION.format(title=title, entry=entry)
    assert lacks(ast.parse(f'def {signature}: pass').body[0], docstring) == missing


def test_what_one_line_lacks():
    function = ast.parse('def f() -> int: pass').body[0]
    assert lacks(function, 'Return the count.') == []
    assert lacks(function, 'Count.') == ['Returns']
    assert lacks(function, None) == ['a docstring']


SOURCE = {
    'sink.py': '''
class Sink:
    def write(self, row):
        """
        Write.

        Parameters
        ----------
        row
            A row.

        """
class _Hidden:
    def write(self, row):
        pass
''',
    'file.py': '''
from sink import Sink
class File(Sink):
    """
    A file.

    Parameters
    ----------
    path
        Where.

    """
    def __init__(self, path, mode): ...
    def write(self, row):
        """Write into the file."""
    def close(self, reason):
        """Close it."""
''',
    '_inner.py': 'def f(a): pass',
}


def test_a_method_may_rely_on_what_its_parent_says(tmp_path):
    for name, text in SOURCE.items():
        (tmp_path / name).write_text(text)
    assert faults(tmp_path) == [
        'file.py:13 File lacks Parameters: mode',
        'file.py:16 File.close lacks Parameters: reason',
    ]
