# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Hostile meshes: STL, OBJ, PLY, GLB, DAE, OFF."""

import json
import math
import struct
from random import Random

from test.support.hostile import values

KINDS = ('stl', 'obj', 'ply', 'glb', 'dae', 'off')
_CORNERS = [(x, y, z) for x in (0, 0.1) for y in (0, 0.2) for z in (0, 0.3)]
_FACES = [
    (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6),
    (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
]  # fmt: skip
_COUNTS = (0, 1, -1, 11, 13, 2**16, 10**6, 2**31 - 1, 2**32 - 1, 10**12, 2**63)
#: Numbers as texts.
_WORDS = (
    'nan', 'inf', '-inf', '1e308', '1e-320', '1e999', '', 'x', '0x10', '1,5', '9' * 500, '-0',
    '1e-400000000', '\x00',
)  # fmt: skip
BILLION = (
    '<!DOCTYPE r [<!ENTITY a "ha">'
    + ''.join(
        f'<!ENTITY {chr(98 + i)} "{("&" + chr(97 + i) + ";") * 10}">' for i in range(9)
    )
    + ']>'
)  # fmt: skip


def outside_entity(outside: str) -> str:
    """Return a document type that names a file outside."""
    return f'<!DOCTYPE r [<!ENTITY j SYSTEM "file://{outside}">]>'


def hostile_mesh(kind: str, random: Random, outside: str) -> bytes:
    """
    Return a hostile mesh.

    Parameters
    ----------
    kind
        One of ``KINDS``.
    random
        Source of choices.
    outside
        Path of a file that must not be read.

    """
    data = _MAKERS[kind](random, outside)
    return values.damaged(random, data) if random.random() < 0.25 else data


def _corners(random: Random) -> list[list[float]]:
    corners = [list(corner) for corner in _CORNERS]
    if random.random() < 0.4:
        bad = random.choice((math.nan, math.inf, 1e30, -1e30, 1e-40, 0.0))
        for corner in random.sample(corners, random.choice((1, 3, 8))):
            corner[random.randrange(3)] = bad
    return corners


def _faces(random: Random) -> list[tuple[int, int, int]]:
    faces = list(_FACES)
    change = random.randrange(6)
    if change == 0:
        faces[random.randrange(12)] = (0, 0, random.choice((0, 8, 99, -1, 2**31 - 1)))
    elif change == 1:
        del faces[random.randrange(12) :]
    elif change == 2:
        faces = faces * random.choice((2, 50))
    elif change == 3:
        faces = [(a, c, b) for a, b, c in faces]
    return faces


def _stl(random: Random, _: str) -> bytes:
    corners, faces = _corners(random), _faces(random)
    if random.random() < 0.4:
        lines = ['solid x']
        for face in faces:
            lines.append('facet normal 0 0 1\nouter loop')
            for corner in face:
                place = corners[corner % 8]
                words = [str(number) for number in place]
                if random.random() < 0.03:
                    words[random.randrange(3)] = random.choice(_WORDS)
                lines.append('vertex ' + ' '.join(words))
            lines.append('endloop\nendfacet')
        if random.random() < 0.2:
            lines.insert(random.randrange(len(lines)), random.choice(_WORDS) * 1000)
        return '\n'.join([*lines, 'endsolid x']).encode()
    count = random.choice(_COUNTS) if random.random() < 0.5 else len(faces)
    data = bytearray(random.choice((b'solid', b'')).ljust(80, b' '))
    data += struct.pack('<I', count % 2**32)
    for face in faces:
        data += struct.pack('<3f', 0, 0, 1)
        for corner in face:
            data += struct.pack('<3f', *corners[corner % 8])
        data += bytes(2)
    return bytes(data)


def _obj(random: Random, outside: str) -> bytes:
    lines = [f'v {x} {y} {z}' for x, y, z in _corners(random)]
    lines += [f'f {a + 1} {b + 1} {c + 1}' for a, b, c in _faces(random)]
    odd = (
        f'mtllib {outside}', 'mtllib ../../../etc/passwd', 'usemtl x', 'f 1', 'f',
        'f 1/2/3 4 5//6',
        'f -1 -2 -3', 'f 1 2 99999999999', f'f {"1 " * 20_000}', 'v', 'v 1 2', 'v 1 2 3 4 5 6 7',
        'vt nan', 'vn', 'o ' + 'x' * 10_000, 'g a b c', 's off', 'curv 0 1', 'call ' + outside,
        'l 1 2', 'p 1', '\\', 'f 1 2 3 \\', '#' * 100_000, 'v ' + random.choice(_WORDS) + ' 0 0',
        values.text(random), 'o a\n' * 3000,
    )  # fmt: skip
    for _ in range(random.randrange(4)):
        lines.insert(random.randrange(len(lines) + 1), random.choice(odd))
    return '\n'.join(lines).encode('utf-8', 'replace')


def _ply(random: Random, outside: str) -> bytes:
    corners, faces = _corners(random), _faces(random)
    kind = random.choice(('ascii', 'binary_little_endian', 'binary_big_endian', 'x'))
    counts = [len(corners), len(faces)]
    if random.random() < 0.5:
        counts[random.randrange(2)] = random.choice(_COUNTS)
    types = random.choice(('uchar int', 'uchar int', 'int int', 'float int', 'double double', ''))
    head = [
        'ply', f'format {kind} 1.0', f'comment TextureFile {outside}',
        f'element vertex {counts[0]}', 'property float x', 'property float y', 'property float z',
        f'element face {counts[1]}', f'property list {types} vertex_indices', 'end_header',
    ]  # fmt: skip
    odd = (
        'property list uint uint x', 'property x y', 'element z 1000000000000', 'element', 'x' * 9,
        'property float x', 'property list list int int a', 'obj_info ' + 'y' * 10_000,
        'element a 5\nproperty char b',
    )  # fmt: skip
    for _ in range(random.choice((0, 0, 1, 2))):
        head.insert(random.randrange(1, len(head)), random.choice(odd))
    if kind in ('ascii', 'x'):
        body = [' '.join(map(str, corner)) for corner in corners]
        body += [f'{random.choice((3, 3, 3, 10**9))} {a} {b} {c}' for a, b, c in faces]
        return '\n'.join([*head, *body, '']).encode()
    order = '<' if 'little' in kind else '>'
    data = b''.join(struct.pack(f'{order}3f', *corner) for corner in corners)
    for face in faces:
        size = random.choice((3, 3, 3, 3, 255, 0))
        data += struct.pack(f'{order}B3i', size, *(index % 2**31 for index in face))
    return ('\n'.join([*head, ''])).encode() + data


def _off(random: Random, _: str) -> bytes:
    corners, faces = _corners(random), _faces(random)
    counts = [len(corners), len(faces), 0]
    if random.random() < 0.5:
        counts[random.randrange(3)] = random.choice(_COUNTS)
    lines = [random.choice(('OFF', 'OFF', 'COFF', 'STOFF', '4OFF')), ' '.join(map(str, counts))]
    lines += [' '.join(map(str, corner)) for corner in corners]
    lines += [f'{random.choice((3, 3, 3, 4, 10**6))} {a} {b} {c}' for a, b, c in faces]
    if random.random() < 0.3:
        lines.insert(random.randrange(len(lines)), random.choice((*_WORDS, values.text(random))))
    return '\n'.join(lines).encode('utf-8', 'replace')


def _glb(random: Random, outside: str) -> bytes:
    corners, faces = _corners(random), _faces(random)
    places = b''.join(struct.pack('<3f', *corner) for corner in corners)
    corners_of = b''.join(struct.pack('<3H', *(i % 2**16 for i in face)) for face in faces)
    tree = {
        'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}],
        'nodes': [{'mesh': 0, 'children': [1]}, {'mesh': 0, 'translation': [1, 0, 0]}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1}]}],
        'accessors': [
            {'bufferView': 0, 'componentType': 5126, 'count': len(corners), 'type': 'VEC3'},
            {'bufferView': 1, 'componentType': 5123, 'count': 3 * len(faces), 'type': 'SCALAR'},
        ],
        'bufferViews': [
            {'buffer': 0, 'byteOffset': 0, 'byteLength': len(places)},
            {'buffer': 0, 'byteOffset': len(places), 'byteLength': len(corners_of)},
        ],
        'buffers': [{'byteLength': len(places) + len(corners_of)}],
    }  # fmt: skip
    special = random.randrange(8)
    if special == 0:
        tree['buffers'].append({'byteLength': 10**12})
        tree['buffers'][0]['uri'] = random.choice((
            f'file://{outside}', outside, '../../etc/passwd', 'data:application/octet-stream,x',
            'http://127.0.0.1:9/x',
        ))  # fmt: skip
    elif special == 1:
        tree['accessors'][random.randrange(2)]['count'] = random.choice(_COUNTS)
    elif special == 2:  # nodes in a circle, or a tree that doubles at each level
        tree['nodes'] = [{'children': [i + 1, i + 1], 'mesh': 0} for i in range(30)] + [
            {'mesh': 0, 'children': random.choice(([0], []))}
        ]
    elif special == 3:
        sparse = {'count': 10**9, 'indices': {'bufferView': 0, 'componentType': 5125},
                  'values': {'bufferView': 0}}  # fmt: skip
        tree['accessors'][0] |= {'sparse': sparse}
        del tree['accessors'][0]['bufferView']
    elif special == 4:
        tree['images'] = [{'uri': outside}]
        tree['extensionsRequired'] = ['KHR_draco_mesh_compression']
    elif special > 5:
        for _ in range(random.choice((1, 1, 3))):
            tree = values.mutated(random, tree)
    try:
        text = json.dumps(tree).encode('utf-8', 'replace')
    except (ValueError, RecursionError):
        text = b'[' * 5000
    text += b' ' * (-len(text) % 4)
    binary = places + corners_of
    parts = struct.pack('<II', len(text), 0x4E4F534A) + text
    parts += struct.pack('<II', random.choice((len(binary), len(binary), 2**32 - 1)), 0x004E4942)
    parts += binary
    return struct.pack('<4sII', b'glTF', 2, 12 + len(parts)) + parts


def _dae(random: Random, outside: str) -> bytes:
    numbers = ' '.join(str(x) for corner in _corners(random) for x in corner)
    indices = ' '.join(str(i) for face in _faces(random) for i in face)
    doctype, inside = '', ''
    special = random.randrange(8)
    if special == 0:
        doctype, inside = BILLION, '&j;'
    elif special == 1:
        doctype, inside = outside_entity(outside), '&j;'
    elif special == 2:
        inside = f'<library_images><image id="i"><init_from>{outside}</init_from></image>' * 3
    text = f"""<?xml version="1.0"?>{doctype}
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>
<unit name="m" meter="1"/><up_axis>Z_UP</up_axis></asset>{inside}
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="pa" count="24">{numbers}</float_array><technique_common>
<accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y"
type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p>
</triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"""
    if special == 3:
        text = text.replace('<node id="n">', '<node id="n"><instance_node url="#n"/>')
    elif special == 4:
        text = text.replace('<node id="n">', '<node>' * 3000 + '<node id="n">')
    elif special > 4:
        for _ in range(random.choice((1, 2, 3))):
            at = text.find('"', random.randrange(len(text)))
            end = text.find('"', at + 1)
            made = random.choice((values.text(random), str(random.choice(_COUNTS)), '#g', '#n'))
            if 0 <= at < end:
                text = text[: at + 1] + made.replace('"', '') + text[end:]
    return text.encode('utf-8', 'replace')


_MAKERS = {'stl': _stl, 'obj': _obj, 'ply': _ply, 'off': _off, 'glb': _glb, 'dae': _dae}
