# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Pipes, sockets, devices and folders in place of files: one line at once, for every command."""

import json
import os
import re
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from fluid_sim_ros.errors import FluidSimError
from fluid_sim_ros.scene import Scene

BODY = '<body name="b"><freejoint/><geom size=".1"/></body>'
MODELS = {
    'include': '<mujoco>{dirs}<include file="{name}"/><worldbody>{body}</worldbody></mujoco>',
    'mesh': '<mujoco>{dirs}<asset><mesh name="m" file="{name}"/></asset>'
    '<worldbody>{body}</worldbody></mujoco>',
    'texture': '<mujoco>{dirs}<asset><texture type="2d" file="{name}"/></asset>'
    '<worldbody>{body}</worldbody></mujoco>',
    'cube': '<mujoco>{dirs}<asset><texture type="cube" fileright="{name}"/></asset>'
    '<worldbody>{body}</worldbody></mujoco>',
    'hfield': '<mujoco>{dirs}<asset><hfield name="h" size="1 1 1 1" file="{name}"/></asset>'
    '<worldbody>{body}</worldbody></mujoco>',
    'skin': '<mujoco>{dirs}<asset><skin file="{name}"/></asset>'
    '<worldbody>{body}</worldbody></mujoco>',
    'model': '<mujoco>{dirs}<asset><model name="o" file="{name}"/></asset>'
    '<worldbody>{body}</worldbody></mujoco>',
    'urdf': '<robot name="r"><link name="b"><visual><geometry><mesh filename="{name}"/>'
    '</geometry></visual></link></robot>',
}  # fmt: skip
ENDINGS = {'mesh': 'stl', 'urdf': 'stl', 'texture': 'png', 'cube': 'png', 'hfield': 'bin'}
KINDS = {'pipe': 'a pipe', 'socket': 'a socket', 'device': 'a device', 'folder': 'a folder'}


def special(path, kind):
    """Make what is no regular file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if kind == 'pipe':
        os.mkfifo(path)
    elif kind == 'folder':
        path.mkdir()
    elif kind == 'device':
        path.symlink_to('/dev/zero')
    else:
        here = path.parent.resolve()
        before = Path.cwd()  # the name of a socket may have 107 characters
        os.chdir(here)
        try:
            with socket.socket(socket.AF_UNIX) as made:
                made.bind(path.name)
        finally:
            os.chdir(before)


def model(folder, named, kind, dirs='', place=''):
    name = f'x.{ENDINGS.get(named, "xml")}'
    special(folder / place / name, kind)
    path = folder / f'main.{"urdf" if named == "urdf" else "xml"}'
    path.write_text(MODELS[named].format(dirs=dirs, name=name, body=BODY))
    return path, folder / place / name


@pytest.mark.parametrize('kind', KINDS)
@pytest.mark.parametrize('named', MODELS)
def test_a_model_that_names_what_is_no_file_is_one_line_at_once(tmp_path, named, kind):
    path, place = model(tmp_path, named, kind)
    with pytest.raises(FluidSimError) as caught:
        Scene.load(path).compile()
    line = str(caught.value)
    assert '\n' not in line and line.startswith(f'{path}: names ')
    assert f'{place} is {KINDS[kind]}; only regular files are read' in line


@pytest.mark.parametrize(
    ('named', 'dirs', 'place'),
    [
        ('mesh', '<compiler meshdir="m"/>', 'm'), ('texture', '<compiler texturedir="t"/>', 't'),
        ('hfield', "<compiler assetdir = 'a/b'/>", 'a/b'),
    ],
)  # fmt: skip
def test_folders_of_the_compiler_are_looked_into(tmp_path, named, dirs, place):
    path, _ = model(tmp_path, named, 'pipe', dirs, place)
    with pytest.raises(FluidSimError, match='is a pipe; only regular files are read'):
        Scene.load(path).compile()


def test_a_pipe_behind_includes_is_found(tmp_path):
    os.mkfifo(tmp_path / 'deep.stl')
    (tmp_path / 'main.xml').write_text(MODELS['include'].format(dirs='', name='a.xml', body=BODY))
    (tmp_path / 'a.xml').write_text('<mujoco><include file="b.xml"/></mujoco>')
    (tmp_path / 'b.xml').write_text('<mujoco><asset><mesh file="deep.stl"/></asset></mujoco>')
    with pytest.raises(FluidSimError, match=r'names .deep.stl.*a pipe'):
        Scene.load(tmp_path / 'main.xml').compile()


def test_a_folder_that_only_shares_a_name_with_a_file_is_let_be(tmp_path):
    (tmp_path / 'part.xml').write_text('<mujoco><statistic extent="1"/></mujoco>')
    (tmp_path / 'm' / 'part.xml').mkdir(parents=True)
    (tmp_path / 'main.xml').write_text(MODELS['include'].format(
        dirs='<compiler meshdir="m"/><!-- file="/dev/zero" -->', name='part.xml', body=BODY
    ))  # fmt: skip
    assert Scene.load(tmp_path / 'main.xml').compile()


COMMANDS = {
    'run': 'run x.xml', 'doctor': 'doctor x.xml', 'advise': 'advise x.xml --tolerance .1',
    'stability': 'stability x.xml', 'chart': 'chart x.xml', 'view': 'view x.xml',
    'record': 'run x.xml --record new.mcap', 'scene': 'run x.yaml', 'sweep': 'sweep x.yaml',
    'info': 'info x.mcap', 'replay': 'replay x.mcap --resimulate', 'plot': 'plot x.mcap',
    'export': 'export x.mcap --csv out', 'repair': 'repair x.mcap new.mcap',
    'render': 'render x.mcap', 'hydro': 'hydro x.stl --density 1000',
    'import': 'import x.urdf --out out', 'import_mesh': 'import x.stl --out out',
    'compare': 'compare x.ulg --model x500', 'mapping': 'info none.ulg --mapping x.yaml',
    'fit': 'fit x.csv --model x500 --parameters mass', 'json': 'scenes --json x.json',
}  # fmt: skip
SAID = r'fluid_sim: .*(is (a|no) |regular file|holds 0|no bag|cannot be written)'
#: Several commands in one process, which a pipe would hold up.
PROGRAM = """
    import json, sys
    from fluid_sim_ros import cli
    for name, words in json.loads(sys.argv[1]).items():
        sys.stderr.write(f'== {name}\\n')
        try:
            code = cli.main(words)
        except SystemExit as end:
            code = end.code
        sys.stderr.write(f'{code}\\n')
"""


@pytest.mark.parametrize(
    'kind', ['pipe', *(pytest.param(k, marks=pytest.mark.full) for k in list(KINDS)[1:])]
)
def test_every_command_that_opens_a_path_says_so_in_one_line(tmp_path, kind):
    words = {name: command.split() for name, command in COMMANDS.items()}
    for file in {word for command in words.values() for word in command if word[:2] == 'x.'}:
        special(tmp_path / file, kind)
    code = '\n'.join(line[4:] for line in PROGRAM.splitlines())
    done = subprocess.run(
        [sys.executable, '-c', code, json.dumps(words)], cwd=tmp_path, capture_output=True,
        text=True, timeout=60, check=False,
    )  # fmt: skip
    parts = done.stderr.split('== ')[1:]
    assert len(parts) == len(words), done.stderr
    for part in parts:
        name, *lines, status = part.splitlines()
        if name == 'doctor':  # shows it in its table
            assert status == '1' and not lines
            continue
        if name == 'json' and kind == 'device':
            continue
        assert status == '2' and len(lines) == 1, part
        assert re.match(SAID, lines[0])
