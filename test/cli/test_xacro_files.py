# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What a xacro file of others may read: what lies beside it, and no more."""

import pytest

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.new_vehicle.importing.strangers.xml_source import expand_xacro

HEAD = '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">'


@pytest.mark.parametrize(
    'text',
    [
        '<xacro:if value="${{xacro.load_yaml({file!r})}}"/>',
        '<link name="${{load_yaml({file!r})}}"/>',
        '<xacro:property name="y" value="${{xacro.load_yaml({file!r})}}"/><link name="${{y}}"/>',
        '<xacro:include filename="{file}"/>',
    ],
)
def test_a_xacro_file_reads_nothing_outside(tmp_path, text):
    (tmp_path / 'kept').write_text('secret\n')
    (tmp_path / 'theirs').mkdir()
    path = tmp_path / 'theirs' / 'a.xacro'
    path.write_text(f'{HEAD}{text.format(file=str(tmp_path / "kept"))}</robot>')
    with pytest.raises(ConfigError, match='lies outside of') as caught:
        expand_xacro(path, [])
    assert 'secret' not in str(caught.value)


def test_a_xacro_file_reads_what_lies_beside_it(tmp_path):
    (tmp_path / 'v.yaml').write_text('v: mine\n')
    path = tmp_path / 'a.xacro'
    path.write_text(f"{HEAD}<link name=\"${{xacro.load_yaml('v.yaml')['v']}}\"/></robot>")
    assert expand_xacro(path, [])[0].get('name') == 'mine'
