# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Models whose mesh could be meant to stand in one of several places."""

_USE = '<worldbody><geom type="mesh" mesh="x"/></worldbody>'
_FLEX = '<flexcomp name="x" dim="2" type="mesh" file="x.obj" radius=".01"/>'
_FLEX_BODY = '<worldbody><body name="f">{}</body></worldbody>'
_ATTACH = (
    '<asset><model name="q" file="sub/i.xml"/></asset>'
    '<worldbody><attach model="q" body="b" prefix="p"/></worldbody>'
)
_PART = '<worldbody><body name="b"><geom type="mesh" mesh="x"/></body></worldbody>'
#: Where a mesh may stand.
PLACES = ('x.obj', 'sub/x.obj', 'md/x.obj', 'sub/md/x.obj', 'sub/deep/x.obj', 'deep/x.obj')


def _mjcf(*parts: str) -> str:
    return f'<mujoco>{"".join(parts)}</mujoco>'


def _mesh(file: str = 'x.obj') -> str:
    return f'<asset><mesh file="{file}"/></asset>'


def _compiler(**folders: str) -> str:
    return f'<compiler {" ".join(f"{key}={value!r}" for key, value in folders.items())}/>'


_IN_MD = _compiler(meshdir='md')
_INCLUDE = '<include file="sub/i.xml"/>'
_URDF = (
    '<robot name="r"><mujoco><compiler meshdir="md" strippath="true"/></mujoco><link name="l">'
    '<collision><geometry><mesh filename="package://p/x.obj"/></geometry></collision></link></robot>'
)
#: Text that strict XML refuses and MuJoCo takes.
_LENIENT = (
    '\n <?xml version="1.0"?>\n<!DOCTYPE mujoco>\n<!-- a -- b ---><mujoco><asset>'
    '<!--<mesh file="no"/>--><mesh name="x" file="x.obj"/></asset><custom><text name="t" '
    f'data="a & b < c &lt; &#65;\n d"/></custom>{_USE}</mujoco>\n<!-- end -->'
)
#: Name -> files, the model first.
MODELS = {
    'plain': {'a.xml': _mjcf(_mesh(), _USE)},
    'dot segments': {'a.xml': _mjcf(_mesh('./q/../x.obj'), _USE)},
    'other separator': {'a.xml': _mjcf(_mesh('md\\x.obj'), _USE)},
    'meshdir': {'a.xml': _mjcf(_compiler(meshdir='md/'), _mesh(), _USE)},
    'meshdir stated later': {'a.xml': _mjcf(_mesh(), _IN_MD, _USE)},
    'meshdir twice': {'a.xml': _mjcf(_compiler(meshdir='no'), _IN_MD, _mesh(), _USE)},
    'meshdir beside assetdir': {
        'a.xml': _mjcf(_compiler(meshdir='md', assetdir='no'), _mesh(), _USE)
    },
    'assetdir after meshdir': {
        'a.xml': _mjcf(_compiler(meshdir='no'), _compiler(assetdir='md'), _mesh(), _USE)
    },
    'strippath': {
        'a.xml': _mjcf(_compiler(strippath='true', meshdir='md'), _mesh('/no/x.obj'), _USE)
    },
    'included asset': {'a.xml': _mjcf(_INCLUDE, _USE), 'sub/i.xml': _mjcf(_mesh())},
    'included asset, meshdir': {
        'a.xml': _mjcf(_INCLUDE, _IN_MD, _USE), 'sub/i.xml': _mjcf(_mesh())
    },
    'included asset and meshdir': {
        'a.xml': _mjcf(_INCLUDE, _USE), 'sub/i.xml': _mjcf(_IN_MD, _mesh())
    },
    'include within an include': {
        'a.xml': _mjcf(_INCLUDE, _USE),
        'sub/i.xml': _mjcf('<include file="deep/j.xml"/>'),
        'sub/deep/j.xml': _mjcf(_mesh()),
    },
    'include within a section': {
        'a.xml': _mjcf(f'<asset>{_INCLUDE}</asset>', _USE),
        'sub/i.xml': '<mujocoinclude><mesh file="x.obj"/></mujocoinclude>',
    },
    'flex': {'a.xml': _mjcf(_FLEX_BODY.format(_FLEX))},
    'flex, meshdir': {'a.xml': _mjcf(_IN_MD, _FLEX_BODY.format(_FLEX))},
    'included flex': {
        'a.xml': _mjcf(_IN_MD, _FLEX_BODY.format(_INCLUDE)), 'sub/i.xml': _mjcf(_FLEX)
    },
    'attached': {
        'a.xml': _mjcf(_compiler(meshdir='deep'), _ATTACH),
        'sub/i.xml': _mjcf(_IN_MD, _mesh(), _PART),
    },
    'attached, includes': {
        'a.xml': _mjcf(_ATTACH),
        'sub/i.xml': _mjcf('<include file="deep/j.xml"/>', _PART),
        'sub/deep/j.xml': _mjcf(_mesh()),
    },
    'urdf': {'a.urdf': _URDF},
    'lenient text': {'a.xml': _LENIENT},
}  # fmt: skip


def tetrahedron(size: float) -> str:
    """Return a mesh (OBJ)."""
    corners = f'v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 0 0 {size}\n'
    return corners + 'f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n'
