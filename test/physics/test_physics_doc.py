# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The page of equations and the functions name each other."""

import ast
import re
from pathlib import Path

import fluid_sim_ros.physics

PACKAGE = Path(fluid_sim_ros.physics.__file__).parent
PAGE = (Path(__file__).parents[2] / 'doc' / 'physics.md').read_text(encoding='utf-8')
# Helpers of shape and sign, and parts of a documented function, need no line of their own.
PARTS = {
    *(
        'principal_areas',
        'section_normal',
        'max_projected_area',
        'drag_area',
        'swept_inertia',
        'angular_moment',
    ),
    *('kappa_divided_difference', 'momentum', 'wetted_share'),
    *('linear_damping_matrix', 'quadratic_damping_matrix', 'rotation_wb'),
    *('sphere_volume', 'capsule_volume', 'cylinder_volume', 'box_volume'),
    *('checked_mesh', 'box_mesh'),
}


def public_functions():
    for path in sorted(PACKAGE.rglob('*.py')):
        if path.stem == 'arrays':
            continue
        for node in ast.parse(path.read_text(encoding='utf-8')).body:
            if isinstance(node, ast.FunctionDef) and not node.name.startswith('_'):
                yield node.name


def test_every_name_on_the_page_exists():
    known = set(public_functions())
    named = set(re.findall(r'`([a-z0-9_]+)`', PAGE))
    terms = {'drag', 'viscous', 'added_mass', 'magnus', 'kutta'}
    assert named - known - terms == set()


def test_every_function_is_on_the_page():
    named = set(re.findall(r'`([a-z0-9_]+)`', PAGE))
    missing = set(public_functions()) - named - PARTS
    assert missing == set()


def test_files_on_the_page_exist():
    for name in re.findall(r'`([a-z_]+\.py)`', PAGE):
        assert any(PACKAGE.rglob(name))
