# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Only ``ros/raw.py`` touches what rclpy keeps to itself."""

import ast
import inspect
from pathlib import Path

import pytest
import rclpy.lifecycle
import rclpy.node

import fluid_sim_ros

pytestmark = pytest.mark.ros

ROOT = Path(fluid_sim_ros.__file__).parent
FILES = sorted(path for room in ('ros', 'demo') for path in (ROOT / room).rglob('*.py'))
ALLOWED = ROOT / 'ros/raw.py'
#: What lies below rclpy's public classes, whatever it is called.
BELOW = ('handle', 'publish_raw', 'take_message')
#: Public names of Python's own library that begin with an underscore.
PUBLIC = ('_exit', '_fields', '_replace', '_asdict')


def private_names(source: str) -> list[str]:
    """Return each private name of another object that a source uses, with its line."""
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Attribute):
            own = isinstance(node.value, ast.Name) and node.value.id in ('self', 'cls')
            hidden = node.attr.startswith('_') and not node.attr.startswith('__')
            hidden = hidden and node.attr not in PUBLIC
            if node.attr in BELOW or (hidden and not own):
                found.append(f'{node.lineno}: .{node.attr}')
        elif isinstance(node, ast.ImportFrom | ast.Import):
            modules = [getattr(node, 'module', None) or '', *(alias.name for alias in node.names)]
            for name in modules:
                parts = name.split('.')
                if 'impl' in parts or '_rclpy' in name:
                    found.append(f'{node.lineno}: import {name}')
    return found


@pytest.mark.parametrize('path', FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_no_other_file_touches_a_private_name(path):
    found = private_names(path.read_text(encoding='utf-8'))
    assert bool(found) == (path == ALLOWED), found


def attributes_of_self(source: str) -> set[str]:
    """Return the private attributes that methods of a source assign to ``self``."""
    return {
        node.attr
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Attribute)
        and isinstance(node.ctx, ast.Store)
        and isinstance(node.value, ast.Name)
        and node.value.id == 'self'
        and node.attr.startswith('_')
    }


def test_no_node_of_ours_overwrites_an_attribute_of_rclpys_node():
    theirs = attributes_of_self(inspect.getsource(rclpy.node))
    theirs |= attributes_of_self(inspect.getsource(rclpy.lifecycle.node))
    theirs |= {name for name in vars(rclpy.node.Node) if name.startswith('_')}
    assert '_parameter_overrides' in theirs
    for path in FILES:
        source = path.read_text(encoding='utf-8')
        for node in ast.walk(ast.parse(source)):
            bases = [ast.unparse(base) for base in getattr(node, 'bases', ())]
            if isinstance(node, ast.ClassDef) and {'Node', 'LifecycleNode'} & set(bases):
                ours = attributes_of_self(ast.get_source_segment(source, node))
                assert not ours & theirs, (path, node.name, ours & theirs)
