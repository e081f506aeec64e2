import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def script(name):
    """Import a script of .ci, which is no package."""
    spec = importlib.util.spec_from_file_location(name, ROOT / '.ci' / f'{name}.py')
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope='module')
def check_docs():
    return script('check_docs')


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


@pytest.mark.parametrize('name', ['scenes', 'accuracy', 'parameters'])
def test_a_table_is_up_to_date(name):
    doc_tables = script('doc_tables')
    page, table = doc_tables.TABLES[name]
    text = (ROOT / page).read_text()
    # when this fails: make docs
    assert doc_tables.with_table(text, name, table()) == text


def test_a_table_without_marks_is_found():
    with pytest.raises(ValueError, match='no <!-- begin x -->'):
        script('doc_tables').with_table('text', 'x', '| a |')
