# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
import re

import check_docs
import doc_tables
import pytest
import reference_pages
import unit_sphere

from test.support.paths import ROOT


def test_every_link_of_the_documentation_leads_somewhere():
    assert check_docs.broken_links(ROOT) == []


def test_a_broken_link_is_found(tmp_path):
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


@pytest.mark.parametrize('name', doc_tables.TABLES)
def test_a_table_is_up_to_date(name):
    page, table = doc_tables.TABLES[name]
    text = (ROOT / page).read_text()
    # when this fails: make docs
    assert doc_tables.with_table(text, name, table()) == text


def test_a_table_without_marks_is_found():
    with pytest.raises(ValueError, match='no <!-- begin x -->'):
        doc_tables.with_table('text', 'x', '| a |')


def test_the_sphere_of_robot_descriptions_is_what_its_script_makes():
    assert (ROOT / 'models/shapes/unit_sphere.stl').read_bytes() == unit_sphere.stl()


def test_every_topic_of_the_node_is_in_the_reference():
    text = (ROOT / 'doc' / 'reference' / 'topics.md').read_text()
    rows = [line for line in text.splitlines() if line.startswith('| ')]
    terms = re.findall(r'`(\w+)`', next(line for line in rows if '<term>' in line))
    missing = []
    for name, types in reference_pages.topic_names().items():
        shown = re.sub(
            r'wrench/(\w+)$', lambda m: 'wrench/<term>' if m[1] in terms else m[0], name
        )
        row = next((line for line in rows if f'`{shown}`' in line), '')
        kinds = [kind.rpartition('/')[2] for kind in types]
        if not all(kind in row for kind in kinds):
            missing.append((name, kinds))
    assert missing == []
