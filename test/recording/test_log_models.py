# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A log's scene is made of its attachments alone: whatever it names, nothing else is opened."""

import time

import pytest

from fluid_sim_ros.cli.main import WRONG_INPUT, main
from fluid_sim_ros.recording.reader import open_log
from fluid_sim_ros.recording.replay.resimulate import resimulate
from test.support.log_files import rewritten
from test.support.log_models import body_model as model
from test.support.opened_files import opened_files

#: Ways to name a file of the host: HOST is its folder, UP the way to it from the attachments.
REFERENCES = {
    'mesh': model('<mesh name="m" file="HOST/x.obj"/>'),
    'mesh upwards': model('<mesh name="m" file="UP/x.stl"/>'),
    'mesh of a pipe': model('<mesh name="m" file="HOST/pipe" content_type="model/obj"/>'),
    'mesh in a folder': model('<mesh name="m" file="x.obj"/>', head='<compiler meshdir="HOST"/>'),
    'mesh in assetdir': model('<mesh name="m" file="x.obj"/>', head='<compiler assetdir="HOST"/>'),
    'height field': model('<hfield name="h" size="1 1 1 1" file="HOST/x.png"/>'),
    'binary height field': model('<hfield name="h" size="1 1 1 1" file="HOST/x.txt"/>'),
    'texture': model('<texture name="t" type="2d" file="HOST/x.png"/>'),
    'texture as ktx': model('<texture type="2d" file="HOST/x.txt" content_type="image/ktx"/>'),
    'texture of a pipe': model('<texture type="2d" file="HOST/pipe" content_type="image/ktx"/>'),
    'texture in a folder': model(
        '<texture name="t" type="2d" file="x.png"/>', head='<compiler texturedir="HOST"/>'
    ),
    **{
        f'side {side} of a cube': model(f'<texture name="t" type="cube" {side}="HOST/x.png"/>')
        for side in ('fileright', 'fileleft', 'fileup', 'filedown', 'filefront', 'fileback')
    },
    'skin': model('<skin name="s" file="HOST/x.skn"/>'),
    'flex': model(
        inner='<flexcomp name="f" dim="2" type="mesh" file="HOST/x.obj" radius=".01"/>'
    ),
    'flex of gmsh': model(
        inner='<flexcomp name="f" dim="3" type="gmsh" file="HOST/x.msh" radius=".01"/>'
    ),
    'attached model': model('<model name="q" file="HOST/x.xml"/>'),
    'attached model of a pipe': model('<model name="q" file="HOST/pipe"/>'),
    'include': model(head='<include file="HOST/x.xml"/>'),
    'include upwards': model(head='<include file="UP/x.xml"/>'),
    'include of no XML': model(head='<include file="HOST/x.txt"/>'),
    'include of a pipe': model(head='<include file="HOST/pipe"/>'),
    'include in capitals': model(head='<INCLUDE file="HOST/x.xml"/>'),
    'include behind a comment': model(head='<!-- > --><include file="HOST/x.xml"/><!-- < -->'),
    'include by an entity': b'<!DOCTYPE m [<!ENTITY x SYSTEM "HOST/x.txt">]>' + model(more='&x;'),
    'URDF': b'<robot name="r"><link name="b"><visual><geometry><mesh filename="HOST/x.obj"/>'
    b'</geometry></visual></link></robot>',
    'URDF, as a web address': b'<robot name="r"><link name="b"><collision><geometry>'
    b'<mesh filename="file://HOST/x.obj"/></geometry></collision></link></robot>',
    'an attribute of nothing': model(geom='fileleft="HOST/x.png"'),
    'a file that is only named': model(geom='file="HOST/x.png"'),
}  # fmt: skip


@pytest.mark.parametrize('kind', REFERENCES)
def test_no_file_of_the_host_is_opened(kind, body_flight, host_files, tmp_path, capsys):
    text = REFERENCES[kind].replace(b'HOST', str(host_files).encode())
    up = '../' * 30 + str(host_files).lstrip('/')
    log = rewritten(
        body_flight, tmp_path / 'bad.mcap', files={'m.xml': text.replace(b'UP', up.encode())}
    )
    begin = time.monotonic()
    with opened_files(host_files) as names:
        assert main(['replay', str(log), '--resimulate']) == WRONG_INPUT
    assert not names and time.monotonic() - begin < 20
    line = capsys.readouterr().err
    assert line.startswith(f'fluid_sim: {log}: ') and line.count('\n') == 1


@pytest.mark.parametrize('road', ['render', 'what if'])
def test_other_roads_to_the_model(road, body_flight, host_files, tmp_path, capsys):
    text = REFERENCES['mesh'].replace(b'HOST', str(host_files).encode())
    log = rewritten(body_flight, tmp_path / 'bad.mcap', files={'m.xml': text})
    with opened_files(host_files) as names:
        if road == 'render':
            code = main(['render', str(log), '--out', str(tmp_path / 'a.png')])
        else:
            code = main(['replay', str(log), '--with', 'timestep=0.001'])
    assert (code, names) == (WRONG_INPUT, [])
    assert 'is not there' in capsys.readouterr().err


@pytest.mark.parametrize(
    'path', ['HOST/x.xml', 'UP/x.xml', '../m.xml', '/m.xml', '', '.', 'n.xml']
)
def test_the_model_itself_is_an_attachment(path, body_flight, host_files, tmp_path):
    path = path.replace('HOST', str(host_files)).replace(
        'UP', '../' * 30 + str(host_files).lstrip('/')
    )
    log = rewritten(body_flight, tmp_path / 'bad.mcap', scene={'model_path': path})
    with opened_files(host_files) as names:
        if path == '/m.xml':  # the end of an absolute path is that of an attachment
            assert resimulate(open_log(log)).difference is None
        else:
            with pytest.raises(Exception, match='is not there'):
                resimulate(open_log(log))
    assert not names


def test_a_model_as_text_in_the_description(body_flight, host_files, tmp_path):
    text = REFERENCES['texture'].replace(b'HOST', str(host_files).encode()).decode()
    log = rewritten(body_flight, tmp_path / 'bad.mcap', scene={'mjcf': text})
    with opened_files(host_files) as names, pytest.raises(Exception, match='is not there'):
        resimulate(open_log(log))
    assert not names


def test_files_of_weather_in_the_description(body_flight, host_files, tmp_path):
    (host_files / 'w.csv').write_text('t,x,y,z\n0,1,0,0\n1,1,0,0\n')
    for wind in ({'model': 'series'}, {'model': 'grid'}):
        wind['file'] = str(host_files / 'w.csv')
        log = rewritten(body_flight, tmp_path / f'{wind["model"]}.mcap', scene={'wind': [wind]})
        with opened_files(host_files) as names, pytest.raises(Exception, match=str(log)):
            resimulate(open_log(log))
        assert not names
