# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Layouts for Foxglove and Lichtblick name topics and fields that their vehicle has."""

import importlib.util
import json
import re
from pathlib import Path

import pytest

from fluid_sim_ros import Simulation, cli
from fluid_sim_ros.messages.definitions import definition
from fluid_sim_ros.messages.foxglove import vehicle_layout
from fluid_sim_ros.messages.state_topics import DEFAULTS, StateTopics
from fluid_sim_ros.recording.decode import fields

ROOT = Path(__file__).resolve().parents[2]


def script():
    spec = importlib.util.spec_from_file_location('layouts', ROOT / '.ci/foxglove_layouts.py')
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


LAYOUTS = script().shown()


def panels(node):
    """Return the panels that a layout's tree places."""
    if isinstance(node, str):
        return [node]
    assert 0 < node['splitPercentage'] < 100
    return panels(node['first']) + panels(node['second'])


def messages(scene):
    """Return the fields of the message of each topic."""
    topics = StateTopics(Simulation(scene), DEFAULTS).topics
    return {
        '/' + t.name.lstrip('/'): fields(definition(t.type).text, t.template.bytes())
        for t in topics
    }


@pytest.mark.parametrize('name', LAYOUTS)
def test_the_layout_of_each_vehicle_is_up_to_date_and_names_what_there_is(name):
    scene, vehicle = LAYOUTS[name]
    text = (ROOT / f'config/foxglove/{name}.json').read_text(encoding='utf-8')
    assert text == script().text_of(scene, vehicle), 'make docs writes it'
    layout = json.loads(text)
    assert sorted(panels(layout['layout'])) == sorted(layout['configById'])
    there = messages(scene)
    assert set(layout['configById']['3D!scene']['topics']) <= there.keys()
    values = [
        entry['value']
        for panel in layout['configById'].values() for entry in panel.get('paths', ())
    ]  # fmt: skip
    assert len(values) >= 9
    for value in values:
        topic, field = re.match(r'(/[^.]*)\.(.*)', value).groups()
        assert field in there[topic], value
        assert topic.startswith(f'/{vehicle}/')


def test_every_layout_in_the_folder_is_of_a_vehicle():
    assert {path.stem for path in (ROOT / 'config/foxglove').glob('*.json')} == LAYOUTS.keys()


def test_a_vehicle_is_shown_with_what_it_has():
    def titles(scene, vehicle):
        layout = vehicle_layout(StateTopics(Simulation(scene), DEFAULTS), vehicle)
        return [
            panel.get('title', '').partition(' [')[0] for panel in layout['configById'].values()
        ]

    assert {'thrust', 'wind', 'gyroscope, body axes'} <= set(titles('x500', 'x500'))
    assert {'thrust', 'current', 'joint positions'} <= set(titles('remus100', 'remus100'))
    assert not {'thrust', 'joint positions'} & set(titles('sphere', 'sphere'))


def test_the_command_writes_the_layout_of_a_vehicle_of_ones_own(tmp_path, capsys):
    path = tmp_path / 'mine.json'
    assert cli.main(['layout', 'rov', '--out', str(path), '--json', '-']) == 0
    result = json.loads(capsys.readouterr().out)
    assert result['vehicle'] == 'bluerov2_heavy' and 'Plot!thrust' in result['panels']
    labels = [
        p['label'] for p in json.loads(path.read_text())['configById']['Plot!thrust']['paths']
    ]
    assert labels == [f't{i}' for i in range(1, 9)]
    assert cli.main(['layout', 'rov', '--vehicle', 'moon']) == 2
    assert 'bluerov2_heavy' in capsys.readouterr().err
    assert cli.main(['layout', 'rov', '--out', '/proc/none/x.json']) == 2
