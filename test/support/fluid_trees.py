# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Random trees of bodies in MuJoCo's own fluid: ellipsoids, inertia boxes, all kinds of joints."""

import numpy as np

SHAPES = ('ellipsoid', 'capsule', 'box', 'sphere', 'cylinder')


def numbers(values):
    """Return numbers as an attribute's text."""
    return ' '.join(f'{value:.4g}' for value in values)


def geom(rng):
    """Return a geom, with MuJoCo's ellipsoid model in two of three."""
    fluid = ''
    if rng.random() < 0.67:
        fluid = 'fluidshape="ellipsoid"'
        if rng.random() < 0.5:
            fluid += f' fluidcoef="{numbers(rng.uniform(0, 2, 5))}"'
    return (
        f'<geom type="{rng.choice(SHAPES)}" size="{numbers(rng.uniform(0.03, 0.2, 3))}" '
        f'mass="{rng.uniform(0.1, 2):.4g}" pos="{numbers(rng.uniform(-0.1, 0.1, 3))}" '
        f'euler="{numbers(rng.uniform(-90, 90, 3))}" contype="0" conaffinity="0" {fluid}/>'
    )


def joint(rng):
    """Return the joint of a body to its parent; '' welds it."""
    kind = rng.integers(4)
    if kind < 2:
        return ('', '<joint type="ball" damping=".01"/>')[kind]
    return (
        f'<joint axis="{numbers(rng.normal(size=3))}" damping="{rng.choice([0, 0.02])}" '
        f'stiffness="{rng.choice([0, 1.0])}" armature="{rng.choice([0, 0.01])}"/>'
    )


def tree(rng, name, levels, root=True):
    """Return a body with all below it."""
    place = '0 0 2' if root else numbers(rng.uniform(-0.3, 0.3, 3))
    first = rng.choice(
        ['<freejoint/>', '<joint type="slide"/><joint axis="0 1 .3"/>'], p=[0.7, 0.3]
    )
    parts = [f'<body name="{name}" pos="{place}">', str(first) if root else joint(rng)]
    parts += [geom(rng) for _ in range(rng.integers(1, 3))]
    for i in range(rng.integers(0, 3) if levels else 0):
        parts.append(tree(rng, f'{name}_{i}', levels - 1, root=False))
    return ''.join(parts) + '</body>'


def world(seed, integrator, more='', option=''):
    """Return MJCF of one to three trees, or of fourteen, in a fluid that is drawn."""
    rng = np.random.default_rng(seed)
    count = 14 if seed % 7 == 6 else rng.integers(1, 4)
    trees = ''.join(tree(rng, f'b{i}', int(rng.integers(0, 4))) for i in range(count))
    density, viscosity = ((1.2, 0.1), (1000, 0), (0, 1), (1.2, 1.8e-5))[seed % 4]
    wind = ('0 0 0', '1 -2 .5')[seed % 2]
    jacobian = ('auto', 'dense', 'sparse')[seed % 3]
    return (
        f'<mujoco><option timestep=".001" integrator="{integrator}" density="{density}" '
        f'viscosity="{viscosity}" wind="{wind}" jacobian="{jacobian}">{option}</option>'
        f'<worldbody>{trees}</worldbody>{more}</mujoco>'
    )
