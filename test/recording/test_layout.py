"""The layout file for Foxglove and Lichtblick names topics and fields that a log has."""

import json
import re
from pathlib import Path

from fluid_sim_ros.recording.decode import columns
from fluid_sim_ros.recording.reader import open_log
from test.support.recorded_flights import record_flight

LAYOUT = Path(__file__).resolve().parents[2] / 'config/foxglove/quadrotor.json'


def panels(node):
    """Return the panels that a layout's tree places."""
    if isinstance(node, str):
        return [node]
    return panels(node['first']) + panels(node['second'])


def test_every_plotted_field_is_in_a_log(tmp_path):
    layout = json.loads(LAYOUT.read_text())
    assert sorted(panels(layout['layout'])) == sorted(layout['configById'])
    path = tmp_path / 'a.mcap'
    record_flight(path, 'quadrotor', seconds=0.05, piloted=False)
    log = open_log(path)
    fields = {}
    for topic in log.topics.values():
        data = [m.data for m in log.messages([topic.name])]
        fields[topic.name] = columns(topic.definition, data) if data else {}
    values = [
        entry['value']
        for panel in layout['configById'].values() for entry in panel.get('paths', ())
    ]  # fmt: skip
    scene = layout['configById']['3D!scene']
    assert set(scene['topics']) <= {name for name, table in fields.items() if table}
    assert len(values) > 12
    for value in values:
        topic, field = re.match(r'(/[^.]*)\.(.*)', value).groups()
        assert field in fields[topic], value
