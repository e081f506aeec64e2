# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The keys of ``fluid_sim.body``."""

from dataclasses import dataclass, field

import numpy as np

from test.support.hostile.models.draw import Draw, Keys, written
from test.support.hostile.models.medium import Fluid


@dataclass
class Body:
    """
    A body of a drawn model.

    Attributes
    ----------
    name
        Of the body.
    geoms
        Names of its geoms; all of them displace fluid.
    ellipsoid
        One of them has ``fluidshape="ellipsoid"``.
    hinge
        Name of its hinge, '' without one.
    foil
        A foil acts on it.
    free
        It has a free joint.
    balls, others
        How many of its geoms with ``fluidshape="ellipsoid"`` are spheres, and are not.
    alone
        No body may hang on it.

    """

    name: str
    geoms: list[str] = field(default_factory=list)
    ellipsoid: bool = False
    hinge: str = ''
    foil: bool = False
    free: bool = False
    balls: int = 0
    others: int = 0
    alone: bool = False


def drawn_body(draw: Draw, body: Body, fluid: Fluid) -> Keys:
    """Draw keys of a body in a fluid, among which something acts."""
    keys = _drag(draw, body, fluid)
    if draw.yes(0.6):
        auto = body.ellipsoid and fluid.dense and draw.yes()
        keys['added_mass'] = 'auto' if auto else _matrix(draw, draw.size(1e-3, 100), (6, 21, 36))
    damping = _damping(draw) if draw.yes(0.4) else {}
    if fluid.dense and draw.yes(0.5):
        volume = written(draw.size(1e-6, 1, far=(1e-300, 1e12)))
        keys['volume'] = 'auto' if draw.yes() else volume
        keys |= draw.some({'center_of_buoyancy': draw.vector(0.1)}, 0.3)
    if draw.yes(0.3):
        keys['geoms'] = ' '.join(draw.sample(body.geoms, draw.randrange(1, len(body.geoms) + 1)))
    drags = keys.get('drag') in ('ellipsoid', 'inertia_box')
    if not damping and not drags and not {'added_mass', 'volume'} & set(keys):
        damping = {'linear_damping': _matrix(draw, 1.0, (6,))}
    if damping and fluid.stock:
        keys['drag'] = 'builtin'
    keys |= damping
    if 'added_mass' in keys or damping:
        keys |= draw.some({'reference_point': draw.vector(0.1)}, 0.3)
    return keys


def _drag(draw: Draw, body: Body, fluid: Fluid) -> Keys:
    if fluid.stock:
        return draw.some({'drag': 'builtin'})
    if not fluid.dense:
        return draw.some({'drag': draw.choice(('none', 'builtin') if not fluid.viscosity else
                                              ('none',))})  # fmt: skip
    words = ['none', 'inertia_box', *['ellipsoid'] * (3 if body.ellipsoid else 0)]
    drag = draw.choice(words)
    if drag != 'ellipsoid':
        return draw.some({'drag': drag}, 0.7)
    spin = [draw.zero_or_size(1e-6, 1) for _ in range(draw.choice((1, 3)))]
    history: Keys = draw.some({'history': 'none'}, 0.1)
    if body.free and (body.balls, body.others) == (1, 0) and fluid.density and fluid.viscosity:
        history = draw.some({'history': draw.choice(('basset', 'mei_adrian', 'dorgan_loth'))}, 0.8)
        body.alone = bool(history)
    return {'drag': drag} | history | draw.some({
        'drag_area': draw.choice(('lemma', 'true')),
        'drag_reynolds': draw.choice(('constant', 'brown_lawler')),
        'drag_angular': draw.choice(('slender', 'swept')),
        'rotational_damping': written(spin),
    })  # fmt: skip


def _matrix(draw: Draw, scale: float, counts: tuple[int, ...]) -> str:
    """Write a semi-definite matrix in one of its ways."""
    count = draw.choice(counts)
    if count == 6:
        return written([draw.zero_or_size(1e-3, 1) * scale for _ in range(6)])
    matrix = draw.semidefinite(scale)
    return written(matrix[np.triu_indices(6)] if count == 21 else matrix)


def _damping(draw: Draw) -> Keys:
    keys = draw.some({
        'linear_damping': _matrix(draw, draw.size(1e-3, 100), (6, 36)),
        'quadratic_damping': _quadratic(draw),
    }, 0.7)  # fmt: skip
    if draw.yes(0.5):
        total = draw.yes()
        keys['cross_damping'] = _cross(draw, total)
        keys |= {'cross_damping_total': 'true'} if total else draw.some(
            {'cross_damping_total': 'false'}, 0.2
        )  # fmt: skip
    if draw.yes(0.2):
        keys |= _fading(draw)
    return keys


def _fading(draw: Draw) -> Keys:
    """Draw a damping with moments by surge and sway that fade, and no force that mirrors them."""
    diagonal = [draw.size(1e-3, 100) for _ in range(6)]
    matrix, fade = np.diag(diagonal), [0.0, 0.0]
    for i in draw.sample((0, 1), draw.randrange(1, 3)):
        column = draw.choice((0, 1))
        # semi-definite: below the geometric mean of what is on the diagonal
        matrix[3 + i, column] = 0.5 * draw.choice((-1, 1)) * np.sqrt(
            diagonal[3 + i] * diagonal[column]
        )  # fmt: skip
        fade[i] = draw.size(1e-3, 10, far=(1e-300, 1e300))
    return {'linear_damping': written(matrix), 'moment_fade': written(fade)}


def _quadratic(draw: Draw) -> str:
    if draw.yes():
        return written([draw.zero_or_size(1e-3, 100) for _ in range(6)])
    matrix = np.array([[draw.signed() for _ in range(6)] for _ in range(6)])
    np.fill_diagonal(matrix, np.abs(np.diagonal(matrix)))
    return written(matrix)


def _cross(draw: Draw, total: bool) -> str:
    """Write groups `row absolute linear coefficient`; of totals each pair once in a row."""
    pairs = [(row, i, j) for row in range(1, 7) for i in range(1, 7) for j in range(1, i)]
    if not total:
        pairs += [(row, i, i) for row in range(1, 7) for i in range(1, 7)]
    chosen = draw.sample(pairs, draw.randrange(1, 6))
    groups = [
        (row, *((j, i) if draw.yes() else (i, j)), draw.signed()) for row, i, j in chosen
    ]  # fmt: skip
    return ' '.join(f'{row} {i} {j} {number:.17g}' for row, i, j, number in groups)
