# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Reading a mesh file: every format, units, and files that are none: one line, no hang."""

import json
import os
import struct
import subprocess
import sys

import numpy as np
import pytest

from fluid_sim_ros.errors import ConfigError
from fluid_sim_ros.hydro.meshes.reader_process import solid_of_file
from fluid_sim_ros.hydro.meshes.reading import read_mesh
from fluid_sim_ros.hydro.meshes.shapes import box, together, write_obj, write_stl
from fluid_sim_ros.hydro.meshes.surface import volume_and_center
from fluid_sim_ros.schema import limits

trimesh = pytest.importorskip('trimesh')
SIZE = (0.1, 0.2, 0.3)


def volume(solid):
    return volume_and_center(solid.in_mesh_axes().triangles)[0]


@pytest.mark.parametrize('kind', ['ply', 'glb', 'dae', 'off'])
def test_a_format_is_read(kind, tmp_path):
    path = tmp_path / f'box.{kind}'
    trimesh.creation.box(SIZE).export(path)
    solid, triangles = solid_of_file(path, 1.0)
    assert (triangles, solid.repairs) == (12, ())
    assert volume(solid) == pytest.approx(0.006, rel=1e-6)


def test_pieces_of_a_scene_stand_where_the_scene_puts_them(tmp_path):
    scene = trimesh.Scene()
    piece = trimesh.creation.box((1, 1, 1))
    for shift in ((0, 0, 0), (0.5, 0, 0)):
        scene.add_geometry(piece, transform=trimesh.transformations.translation_matrix(shift))
    mirrored = np.diag([-1.0, 1.0, 1.0, 1.0])
    mirrored[:3, 3] = (-3, 0, 0)
    scene.add_geometry(piece, transform=mirrored)
    scene.export(tmp_path / 'scene.glb')
    solid, _ = solid_of_file(tmp_path / 'scene.glb', 1.0)
    assert volume(solid) == pytest.approx(2.5, rel=1e-6)
    assert '3 parts united into 2' in solid.repairs[0]


def test_millimetres_are_asked_about_and_taken_when_stated(tmp_path):
    path = tmp_path / 'mm.obj'
    write_obj(box(np.array(SIZE) * 1000), path)
    with pytest.raises(ConfigError, match=r'100 x 200 x 300 m .* --unit mm'):
        read_mesh(path)
    assert volume(read_mesh(path, 'mm').solid) == pytest.approx(0.006, rel=1e-8)
    with pytest.raises(ConfigError, match="unit 'yd'"):
        read_mesh(path, 'yd')


def test_a_tiny_mesh_is_asked_about(tmp_path):
    path = tmp_path / 'tiny.stl'
    write_stl(box(np.array(SIZE) / 1000), path)
    with pytest.raises(ConfigError, match=r'smaller than 5 mm; give --unit'):
        read_mesh(path)
    assert volume(solid_of_file(path, 1.0)[0]) == pytest.approx(6e-12, rel=1e-6)


NO_MESH = {
    'words.stl': b'hello',
    'lies.stl': b'\0' * 80 + b'\xff\xff\xff\xff' + b'\0' * 50,
    'index.obj': b'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999\n',
    'points.ply': b'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n'
    b'property float z\nend_header\n0 0 0\n',
    'huge.ply': b'ply\nformat binary_little_endian 1.0\nelement vertex 99999999999\n'
    b'property float x\nproperty float y\nproperty float z\nelement face 1\n'
    b'property list uchar int vertex_indices\nend_header\n',
    'chunk.glb': b'glTF\x02\0\0\0' + b'\xff' * 40,
    'entities.dae': b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY a "aaaaaaaaaa">'
    + b''.join(
        f'<!ENTITY {chr(98 + k)} "{f"&{chr(97 + k)};" * 10}">'.encode() for k in range(9)
    )
    + b']><COLLADA>&j;</COLLADA>',
}  # fmt: skip


@pytest.mark.parametrize('name', NO_MESH)
def test_what_is_no_mesh_is_refused_in_one_line(name, tmp_path):
    path = tmp_path / name
    path.write_bytes(NO_MESH[name])
    with pytest.raises(ConfigError) as error:
        solid_of_file(path, 1.0)
    assert '\n' not in str(error.value)


def test_the_reading_process_names_the_file(tmp_path):
    path = tmp_path / 'lies.stl'
    path.write_bytes(NO_MESH[path.name])
    with pytest.raises(ConfigError, match=r'is no stl mesh|no triangles in it') as error:
        read_mesh(path)
    assert str(error.value).startswith(f'{path}: ')


def test_a_path_that_is_no_mesh_file_is_refused_without_opening_it(tmp_path):
    (tmp_path / 'empty.stl').touch()
    os.mkfifo(tmp_path / 'pipe.stl')
    (tmp_path / 'folder.stl').mkdir()
    with (tmp_path / 'sparse.stl').open('wb') as file:
        file.truncate(limits.limit('mesh_bytes') + 1)
    for name, words in {
        'none.stl': 'no such file', 'empty.stl': 'is empty', 'pipe.stl': 'no regular file',
        'folder.stl': 'no regular file', 'sparse.stl': 'limit mesh_bytes',
        'x.step': "'.step' is no",
    }.items():  # fmt: skip
        with pytest.raises(ConfigError, match=words):
            read_mesh(tmp_path / name)


@pytest.mark.full
def test_memory_and_time_of_the_reader_are_bounded(tmp_path, monkeypatch):
    path = tmp_path / 'many.ply'
    count = 40_000_000
    head = (
        f'ply\nformat binary_little_endian 1.0\nelement vertex {count}\nproperty double x\n'
        'property double y\nproperty double z\nelement face 0\n'
        'property list uchar int vertex_indices\nend_header\n'
    ).encode()
    with path.open('wb') as file:
        file.write(head)
        file.truncate(len(head) + 24 * count)
    monkeypatch.setenv(limits.VARIABLE, 'mesh_bytes=3e9,mesh_memory=1000')
    with pytest.raises(ConfigError, match=r'mesh_memory|no triangles'):
        read_mesh(path)
    monkeypatch.setenv(limits.VARIABLE, 'mesh_bytes=3e9,mesh_seconds=0')
    with pytest.raises(ConfigError, match='mesh_'):
        read_mesh(path)


def test_more_triangles_than_are_read(tmp_path):
    path = tmp_path / 'many.stl'
    kind = struct.Struct('<12fH')
    path.write_bytes(b' ' * 80 + struct.pack('<I', 1_000_001) + kind.pack(*range(13)) * 1_000_001)
    with pytest.raises(ConfigError, match='limit mesh_triangles = 1000000'):
        solid_of_file(path, 1.0)


def test_a_turned_file_gives_the_same_solid(tmp_path):
    shape = together([box(SIZE), box(SIZE, (0.05, 0.03, 0.2))])
    turn = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0], [0.48, 0.64, 0.6]])
    solids = []
    for rotation in (np.eye(3), turn):
        write_obj(type(shape)(shape.vertices @ rotation.T + 3, shape.faces), tmp_path / 'a.obj')
        solids.append(solid_of_file(tmp_path / 'a.obj', 1.0)[0])
    np.testing.assert_allclose(solids[0].surface.vertices, solids[1].surface.vertices, atol=1e-9)
    np.testing.assert_array_equal(solids[0].surface.faces, solids[1].surface.faces)


def test_the_process_that_reads_a_closed_mesh_imports_no_scipy(tmp_path):
    """It takes longer to import than all else that the process does."""
    write_stl(box((0.5, 0.3, 0.2)), tmp_path / 'a.stl')
    code = (
        'import sys\nfrom fluid_sim_ros.hydro.meshes.reader_process import main\nmain()\n'
        "print(*(name for name in ('scipy', 'capytaine', 'mujoco') if name in sys.modules))\n"
    )
    command = [sys.executable, '-c', code, str(tmp_path / 'a.stl'), '1', 'keep']
    done = subprocess.run(
        [*command, str(tmp_path / 'a.npz')], capture_output=True, text=True, check=True
    )
    *_, head, heavy = done.stdout.splitlines()
    assert json.loads(head)['triangles'] == 12
    assert heavy == ''
