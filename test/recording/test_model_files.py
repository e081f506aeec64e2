# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Gathering a model finds the files that MuJoCo finds, and gives the same model to the bit."""

import mujoco
import numpy as np
import pytest

from fluid_sim_ros import load_plugins
from fluid_sim_ros.recording.model.files import gather
from fluid_sim_ros.recording.model.mjcf_text import MjcfError, mjcf_text, parse_mjcf
from fluid_sim_ros.recording.model.sources import AttachedFiles, model_of_disk
from fluid_sim_ros.resources import models_folder
from test.support.model_places import MODELS, PLACES, tetrahedron


def compiled(path):
    """Return the model as MuJoCo makes it of the disk, and as it is made of what was gathered."""
    name, files = model_of_disk(path)
    found = gather(name, AttachedFiles(files).read)
    again = mujoco.MjSpec.from_string(found.text, found.assets, found.assets).compile()
    return mujoco.MjSpec.from_file(str(path)).compile(), again, files


def differences(a, b):
    """Return the names of a model's arrays that are not the same to the bit."""
    of_paths = ('paths', '_sizes')  # names of files, and how long all of them are
    names = {name for name in dir(a) if isinstance(getattr(a, name), np.ndarray)} - {*of_paths}
    return [name for name in names if getattr(a, name).tobytes() != getattr(b, name).tobytes()]


@pytest.mark.parametrize('path', sorted(models_folder().glob('*.xml')), ids=lambda p: p.stem)
def test_our_models(path):
    load_plugins()
    model, again, files = compiled(path)
    assert not differences(model, again)
    assert (again.ngeom, again.nmesh) == (model.ngeom, model.nmesh)
    known = {p for p in mujoco.mju_getXMLDependencies(str(path))} | {str(path)}
    assert len(files) == len(known)


@pytest.mark.filterwarnings('ignore:flex')
@pytest.mark.parametrize('left_out', [(), *((place,) for place in PLACES)], ids=str)
@pytest.mark.parametrize('model', MODELS)
def test_files_are_found_where_mujoco_finds_them(model, left_out, tmp_path):
    """Meshes of another size stand in each place where the file could be meant to be."""
    texts = MODELS[model] | {
        place: tetrahedron(size) for size, place in enumerate(PLACES, 1) if place not in left_out
    }
    for name, text in texts.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    main = tmp_path / next(iter(MODELS[model]))
    try:
        mujoco.MjSpec.from_file(str(main)).compile()
    except ValueError as error:
        assert 'Error opening file' in str(error)
        with pytest.raises(Exception, match='is not there'):
            model_of_disk(main)
        return
    disk, again, _ = compiled(main)
    assert not differences(disk, again)


def test_references_become_names_of_assets(tmp_path):
    texts = {
        'a.xml': b'<mujoco><asset><mesh name="m" file="x.obj"/><mesh file="y y.obj"/></asset>'
        b'<include file="/b/i.xml"/></mujoco>',
        'b/i.xml': b'<mujoco><compiler meshdir="."/></mujoco>',
        'x.obj': b'1', 'y y.obj': b'1',
    }  # fmt: skip
    found = gather('a.xml', AttachedFiles(texts).read)
    assert set(found.assets.values()) == {b'1'} and len(found.assets) == 2
    assert set(found.used) == {'a.xml', 'x.obj', 'y y.obj', '/b/i.xml'}
    tree = parse_mjcf(found.text.encode())
    named = [(mesh.get('name'), mesh.get('file')) for mesh in tree.iter('mesh')]
    assert [name for name, _ in named] == ['m', 'y y']
    assert all(file in found.assets for _, file in named)
    assert tree.find('compiler').attrib == {}


def test_two_files_of_one_name_are_two_assets():
    texts = {
        'a.xml': b'<mujoco><asset><mesh name="m" file="p/x.obj"/><mesh name="n" file="q/x.obj"/>'
        b'</asset></mujoco>',
        'p/x.obj': b'1', 'q/x.obj': b'2',
    }  # fmt: skip
    assert sorted(gather('a.xml', AttachedFiles(texts).read).assets.values()) == [b'1', b'2']


def test_unusual_names_mean_nothing_to_mujoco():
    name = 'zip:x?y=1;ARGS:content_type=.obj'
    texts = {'a.xml': f'<mujoco><asset><mesh file="{name}"/></asset></mujoco>'.encode()}
    found = gather('a.xml', AttachedFiles(texts | {name: b'1'}).read)
    (key,) = found.assets
    assert key.endswith('/zip_x_y_1_ARGS_content_type_.obj')


# ---- text --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        (b'', 'no well-formed XML'),
        (b'PK\x03\x04', 'no well-formed XML'),
        (b'\xff\xfe', 'not UTF-8: byte 0'),
        (b'<mujoco>', 'no well-formed XML'),
        (b'<mujoco/><mujoco/>', 'no well-formed XML'),
        (b'<mujoco\x00/>', 'no well-formed XML'),
        (b'<!DOCTYPE m [<!ENTITY a "b">]><mujoco/>', 'only elements are allowed'),
        (b'<mujoco><![CDATA[<a/>]]></mujoco>', 'only elements are allowed'),
        (b'<mujoco><!-- <a/></mujoco>', 'only elements are allowed'),
        (b'<mujoco><a b="&c;"/></mujoco>', ''),
        (b'<m>' * 5000, 'deep in one another'),
        (b'<m a="' + b'<' * 100 + b'"/>', ''),
    ],
)
def test_text_that_is_none(text, words):
    if not words:
        assert mjcf_text(parse_mjcf(text))
        return
    with pytest.raises(MjcfError, match=words):
        parse_mjcf(text)


def models(**texts):
    return AttachedFiles({f'{name}.xml': text.encode() for name, text in texts.items()}).read


@pytest.mark.parametrize(
    ('read', 'words'),
    [
        (models(a='<mujoco><include file="a.xml"/></mujoco>'), 'included twice'),
        (models(a='<mujoco><include file="./a.xml"/></mujoco>'), 'included twice'),
        (
            models(a='<m><include file="b.xml"/></m>', b='<m><include file="b.xml"/></m>'),
            'included twice',
        ),
        (models(a='<mujoco><include/></mujoco>'), 'names no file'),
        (models(b=''), "the file 'a.xml' is not there"),
        (models(a='<mujoco><asset><model file="a.xml"/></asset></mujoco>'), 'attaches itself'),
        (
            models(
                a='<mujoco><asset><model file="b.xml"/></asset></mujoco>',
                b='<mujoco><asset><model file="a.xml"/></asset></mujoco>',
            ),
            'attaches itself',
        ),
        (
            models(**{
                f'{"abcdefghij"[i]}': f'<mujoco><model file="{"bcdefghijk"[i]}.xml"/></mujoco>'
                for i in range(10)
            }),
            'more than 8 deep',
        ),
        (models(a='<mujoco><worldbody><geom file="x"/></worldbody></mujoco>'), 'names a file'),
        (models(a='<mujoco><asset><mesh fileup="x"/></asset></mujoco>'), 'names a file'),
        (models(a='<mujoco><asset><mesh file="x\x1b"/></asset></mujoco>'), 'no well-formed'),
        (
            models(a='<m><model file="b.xml" content_type="model/usd"/></m>', b='<m/>'),
            'only XML can be attached',
        ),
    ],
    ids=range(12),
)  # fmt: skip
def test_models_that_cannot_be_gathered(read, words):
    with pytest.raises(MjcfError) as caught:
        gather('a.xml', read)
    assert words in str(caught.value) and str(caught.value).isprintable()


def test_a_model_that_is_attached_a_million_times_over_is_read_once():
    many = ''.join(f'<model name="m{i}" file="{{}}.xml"/>' for i in range(100))
    texts = {name: f'<mujoco><asset>{many}</asset></mujoco>' for name in 'abcde'}
    texts = {name: text.replace('{}', chr(ord(name) + 1)) for name, text in texts.items()}
    asked = []

    def read(path):
        asked.append(path)
        return (texts | {'f': '<mujoco/>'})[path[0]].encode()

    gather('a.xml', read)
    assert sorted(asked) == [f'{name}.xml' for name in 'abcdef']
