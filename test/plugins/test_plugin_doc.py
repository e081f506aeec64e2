# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Every configuration key is described in doc/plugins.md, and nothing else is."""

import re
from pathlib import Path

import pytest

from fluid_sim_ros.plugins.native import native

DOC = (Path(__file__).parents[2] / 'doc' / 'plugins.md').read_text(encoding='utf-8')


@pytest.mark.parametrize('plugin', ['fluid_sim.body', 'fluid_sim.medium'])
def test_keys_in_the_table_are_the_keys_of_the_plugin(plugin):
    section = DOC.split(f'## {plugin}')[1].split('\n## ')[0]
    rows = re.findall(r'^\| (`.*?) \|', section, re.MULTILINE)
    documented = [key for row in rows for key in re.findall(r'`(\w+)`', row)]
    assert sorted(documented) == sorted(native().plugin_keys(plugin))
