# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What of a model a log holds: enough to repeat it anywhere, and no file of somebody else's."""

import os
import shutil

import pytest

from fluid_sim_ros.cli.main import WRONG_INPUT, main
from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.recording.model.sources import model_of_disk
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from fluid_sim_ros.recording.sink import RecordingSink
from fluid_sim_ros.schema.limits import VARIABLE
from fluid_sim_ros.simulation import Simulation
from test.support.log_models import body_model as model
from test.support.model_places import tetrahedron
from test.support.recorded_flights import record_flight
from test.support.volumes import quick


@pytest.mark.parametrize('way', quick(['absolute', 'upwards', 'folder'], 'absolute', 'upwards'))
def test_a_log_repeats_from_its_copies_after_the_model_moved(way, tmp_path):
    folder, meshes = tmp_path / 'robot' / 'mjcf', tmp_path / 'robot' / 'meshes'
    folder.mkdir(parents=True)
    meshes.mkdir()
    (meshes / 'hull.obj').write_text(tetrahedron(1))
    name = {'absolute': f'{meshes}/hull.obj', 'upwards': '../meshes/hull.obj'}.get(way, 'hull.obj')
    head = f'<compiler meshdir="{meshes}"/>' if way == 'folder' else ''
    text = model(f'<mesh name="m" file="{name}"/>', geom='type="mesh" mesh="m"', head=head)
    (folder / 'm.xml').write_bytes(text)
    log = tmp_path / 'a.mcap'
    record_flight(log, folder / 'm.xml', seconds=0.2, piloted=False, assets_from=[meshes])
    first = open_log(log)
    assert first.attachments['fluid_sim/model/meshes/hull.obj'] == tetrahedron(1).encode()
    assert resimulate(first).difference is None
    (meshes / 'hull.obj').write_text(tetrahedron(2))  # another mesh stands there now
    assert resimulate(open_log(log)).difference is None
    shutil.rmtree(tmp_path / 'robot')
    moved = shutil.move(log, tmp_path / 'moved.mcap')
    outcome = resimulate(open_log(moved))
    assert outcome.difference is None and outcome.compared > 10


def test_a_scene_out_of_a_log_can_be_recorded_again(body_flight, tmp_path):
    simulation = Simulation(open_log(body_flight).description().scene())
    sink = RecordingSink(simulation, tmp_path / 'b.mcap')
    for _ in range(20):
        sink.write(simulation)
        simulation.step()
    sink.close()
    assert resimulate(open_log(tmp_path / 'b.mcap')).difference is None


@pytest.mark.parametrize('way', ['absolute', 'upwards', 'link', 'link to a folder', 'include'])
def test_files_outside_of_the_models_folder_are_not_packed(way, host_files, tmp_path, capsys):
    folder = tmp_path / 'stranger'
    folder.mkdir()
    name = {'absolute': f'{host_files}/x.obj', 'upwards': '../host/x.obj'}.get(way, 'link.obj')
    if way == 'link':
        (folder / name).symlink_to(host_files / 'x.obj')
    elif way == 'link to a folder':
        (folder / 'l').symlink_to(host_files)
        name = 'l/x.obj'
    text = model(f'<mesh name="m" file="{name}"/>', geom='type="mesh" mesh="m"')
    if way == 'include':
        (host_files / 'i.xml').write_text('<mujoco><option timestep="0.001"/></mujoco>')
        text = model(head='<include file="../host/i.xml"/>')
    (folder / 'm.xml').write_bytes(text)
    log = tmp_path / 'a.mcap'
    command = ['run', str(folder / 'm.xml'), '--duration', '0.02', '--record', str(log)]
    assert main(command) == WRONG_INPUT
    error = capsys.readouterr().err
    assert f'--allow-assets-from {host_files}' in error and 'outside of its folder' in error
    assert not log.exists()
    assert main([*command, '--allow-assets-from', str(host_files)]) == 0
    assert resimulate(open_log(log)).difference is None


def test_links_inside_of_the_folder_are_followed(tmp_path):
    (tmp_path / 'real').mkdir()
    (tmp_path / 'real' / 'x.obj').write_text(tetrahedron(1))
    (tmp_path / 'meshes').symlink_to('real')
    (tmp_path / 'm.xml').write_bytes(model('<mesh name="m" file="meshes/x.obj"/>'))
    (tmp_path / 'other.xml').symlink_to('m.xml')
    for name in ('m.xml', 'other.xml'):
        path, files = model_of_disk(tmp_path / name)
        assert path == name and set(files) == {name, 'meshes/x.obj'}


@pytest.mark.parametrize('kind', ['pipe', 'folder', 'device', 'unreadable', 'missing', 'large'])
def test_what_cannot_be_packed_is_one_line(kind, tmp_path, monkeypatch):
    place = tmp_path / 'x.obj'
    if kind == 'pipe':
        os.mkfifo(place)
    elif kind == 'folder':
        place.mkdir()
    elif kind == 'device':
        place.symlink_to('/dev/zero')
    elif kind in ('unreadable', 'large'):
        place.write_text('x')
        place.chmod(0 if kind == 'unreadable' else 0o644)
        monkeypatch.setenv(VARIABLE, 'log_attachment_bytes=20')
    (tmp_path / 'm.xml').write_bytes(model('<mesh name="m" file="x.obj"/>'))
    if kind == 'unreadable' and os.access(place, os.R_OK):
        pytest.skip('the superuser reads everything')
    with pytest.raises(ConfigError) as caught:
        model_of_disk(tmp_path / 'm.xml', [tmp_path])
    assert 'record: ' in str(caught.value) and '\n' not in str(caught.value)
