import importlib.util
from pathlib import Path

import pytest

from fluid_sim_ros import scene_names
from fluid_sim_ros.ros import parameters

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope='module')
def check_docs():
    spec = importlib.util.spec_from_file_location('check_docs', ROOT / '.ci' / 'check_docs.py')
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_link_of_the_documentation_leads_somewhere(check_docs):
    assert check_docs.broken_links(ROOT) == []


def test_a_broken_link_is_found(check_docs, tmp_path):
    (tmp_path / 'doc').mkdir()
    (tmp_path / 'doc' / 'a.md').write_text('# Two words\n[ok](../README.md#head)')
    (tmp_path / 'README.md').write_text(
        '# Head\n[a](doc/a.md) [b](doc/a.md#two-words) [w](https://a.b) `[c](code.md)`\n'
        '[x](doc/x.md) [y](doc/a.md#three) <img src="z.png">\n'
    )

    assert check_docs.broken_links(tmp_path) == [
        'README.md: doc/x.md: no such file',
        'README.md: doc/a.md#three: no such heading',
        'README.md: z.png: no such file',
    ]


def test_the_readme_names_every_scene():
    readme = (ROOT / 'README.md').read_text()
    assert [name for name in scene_names() if f'`{name}`' not in readme] == []


def parameter_row(name, declared):
    """Return a parameter's row in doc/parameters.md."""
    default = declared.default
    if isinstance(default, bool):
        default = str(default).lower()
    default = '(empty)' if default in ('', ['']) else f'`{default}`'
    live = 'yes' if declared.live else 'no'
    return f'| `{name}` | {default} | {live} | {declared.description} |'


def test_the_documented_parameters_are_those_of_the_node():
    page = (ROOT / 'doc' / 'parameters.md').read_text()
    rows = [line for line in page.splitlines() if line.startswith('| `')]
    assert rows == [parameter_row(*item) for item in parameters.TABLE.items()]
