# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The site is made of the repository's own pages: what changes on the way, and what must not."""

import sys
from pathlib import PurePosixPath
from types import SimpleNamespace

import pytest

from test.support.paths import DOC, ROOT

pytest.importorskip('sphinx', reason='needs the extra docs, as make site installs')
sys.path.insert(0, str(DOC / '_ext'))
import repository_pages as pages


@pytest.mark.parametrize(
    ('text', 'expected'),
    [
        ('[x](physics.md#waves)', '[x](physics.md#waves)'),
        ('[waves.md](waves.md)', '[](waves.md)'),
        ('[CI](../.ci/run)', 'CI (`.ci/run`)'),
        ('[`.ci/run`](../.ci/run)', '`.ci/run`'),
        ('[S](../SECURITY.md#limits)', '[S](project/security.md#limits)'),
        ('![p](../benchmarks/results/a.png)', '![p](../benchmarks/results/a.png)'),
        ('[web](https://mujoco.org) [here](#waves)', '[web](https://mujoco.org) [here](#waves)'),
        ('`[x](../.ci/run)`', '`[x](../.ci/run)`'),
        ('```\n[x](../.ci/run)\n```', '```\n[x](../.ci/run)\n```'),
    ],
)
def test_links_of_a_page(text, expected):
    page = PurePosixPath('weather.md')
    assert pages.with_site_links(text, PurePosixPath('doc/weather.md'), page) == expected


def test_links_of_a_page_from_the_top():
    text = '[a](doc/waves.md) <img src="doc/img/a.png" width="24%"> [b](CONTRIBUTING.md)'
    changed = pages.with_site_links(
        text, PurePosixPath('README.md'), PurePosixPath('project/readme.md')
    )
    assert changed == '[a](../waves.md) <img src="../img/a.png" width="24%"> [b](contributing.md)'


def test_the_changelog_as_a_page():
    text = '^^\nHead\n^^\n\n0.1.0 (2026-11-27)\n---\n* ``a``\n'
    assert pages.markdown_of(text) == '# Changes\n\n## 0.1.0 (2026-11-27)\n\n* `a`\n'


def test_a_page_that_the_contents_forget_is_shown_under_more():
    app = SimpleNamespace(config=SimpleNamespace(site_contents={'All': ['p*', 'vehicles/README']}))
    pages.complete_contents(app)
    assert 'weather' in app.config.site_contents['More']
    assert 'physics' not in app.config.site_contents['More']


def test_contents_that_name_no_page_are_refused():
    app = SimpleNamespace(config=SimpleNamespace(site_contents={'All': ['physics', 'no_page']}))
    with pytest.raises(pages.ExtensionError, match='names no page: no_page'):
        pages.complete_contents(app)


def test_each_page_from_the_top_is_there():
    for page, source in pages.TOP.items():
        assert (ROOT / source).is_file()
        assert source in (DOC / f'{page}.md').read_text()
