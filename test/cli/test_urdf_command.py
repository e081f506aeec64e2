# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""``fluid_sim urdf``."""

import json
from pathlib import Path

import pytest

from fluid_sim_ros.cli import main
from test.support.urdf_links import by_urdf_parser


def test_the_urdf_goes_to_standard_output_or_a_file(tmp_path, capsys):
    assert main(['urdf', 'x500']) == 0
    text = capsys.readouterr().out
    robot, _ = by_urdf_parser(text, {})
    assert robot.get_root() == 'x500/base_link'
    path = tmp_path / 'x500.urdf'
    assert main(['urdf', 'x500', '--out', str(path)]) == 0
    assert capsys.readouterr().out == ''
    assert path.read_text(encoding='utf-8') == text


def test_meshes_are_named_by_package_or_by_file(capsys):
    main(['urdf', 'bluerov2'])
    by_package = capsys.readouterr().out
    main(['urdf', 'bluerov2', '--files'])
    by_file = capsys.readouterr().out
    assert 'package://fluid_sim_ros/models/shapes/unit_sphere.stl' in by_package
    start = by_file.index('file://') + len('file://')
    assert Path(by_file[start : by_file.index('"', start)]).stat().st_size > 84
    assert 'package://' not in by_file


def test_json_holds_the_text_and_what_it_lacks(capsys):
    assert main(['urdf', 'fleet_mixed', '--vehicle', 'rov', '--json', '-']) == 0
    result = json.loads(capsys.readouterr().out)
    assert result['vehicle'] == 'rov' and result['notes'] == []
    assert '<robot name="rov">' in result['urdf']


@pytest.mark.parametrize(
    ('words', 'line'),
    [
        (['fleet_mixed'], '--vehicle: names one of the vehicles of fleet_mixed: one, two, rov'),
        (['x500', '--vehicle', 'x'], "--vehicle: 'x' is none of the vehicles of x500: x500"),
        (['x500', '--out', 'no/such/folder/a.urdf'], 'a.urdf: cannot be written'),
        (['x50'], "scene 'x50' is not known"),
    ],
)
def test_what_is_wrong_is_one_line(words, line, capsys):
    assert main(['urdf', *words]) == 2
    said = capsys.readouterr().err
    assert line in said and said.count('\n') == 1
