# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The keys of ``fluid_sim.foil``."""

import math

from test.support.hostile.models.draw import Draw, Keys, written

_SETS = ('lift', 'drag', 'pitch')
_LATERAL = ('side', 'roll', 'yaw')


def drawn_foil(draw: Draw, surfaces: list[str], *, stock: bool) -> Keys:
    """
    Draw keys of a foil.

    Parameters
    ----------
    draw
        The source of choices.
    surfaces
        What may deflect it: ``joint NAME`` or ``actuator NAME``.
    stock
        MuJoCo's own fluid forces act.

    """
    far = (1e-150, 1e100)
    keys = {key: written(draw.size(0.01, 10, far=far)) for key in ('span', 'chord')}
    keys |= draw.some({'area': written(draw.size(0.01, 10, far=far))})
    if draw.yes():
        sharpness = draw.uniform(14, 200)
        highest = min(1.2, math.pi / 2 - 12.1 / sharpness)
        keys['stall_sharpness'] = written(sharpness)
        keys['stall_angle'] = written(draw.uniform(0.01, highest))
    if stock or draw.yes(0.1):
        keys['stock_drag'] = 'keep' if stock else draw.choice(('keep', 'refuse'))
    kind = draw.choice(('wing', 'aircraft'))
    if kind == 'aircraft' or draw.yes():
        keys['kind'] = kind
    keys |= draw.some({'efficiency': written(draw.size(0.1, 1.2, far=(1e-300,)))})
    return keys | (_wing if kind == 'wing' else _aircraft)(draw, surfaces)


def _deflection(draw: Draw, surfaces: list[str]) -> str:
    gain = f' {draw.signed()}' if draw.yes() else ''
    return draw.choice(surfaces) + gain


def _wing(draw: Draw, surfaces: list[str]) -> Keys:
    far = (0.0, 1e-300, 1e100)
    keys = draw.some({
        'aspect_ratio': written(draw.size(0.1, 40, far=far[1:])),
        draw.choice(('lift_slope', 'section_slope')): written(draw.size(0.1, 10, far=far)),
        'lift_0': written(draw.signed()),
        'drag_0': written(draw.zero_or_size(1e-3, 2)),
        'pitch_0': written(draw.signed()),
        'reverse': written(draw.zero_or_size(0.1, 1)),
        'plate_normal': written(draw.zero_or_size(0.1, 4)),
        'plate': draw.choice(('newton', 'sine')),
        'center_of_pressure': draw.choice(('fixed', 'moving')),
        'velocity_point': written(draw.uniform(-1, 1)),
        'panels': str(draw.choice((1, 2, 7, 64))),
        'lift_delta': written(draw.signed()),
        'drag_delta': written(draw.zero_or_size(0.01, 2)),
        'pitch_delta': written(draw.signed()),
    })  # fmt: skip
    if surfaces and draw.yes():
        keys['deflection'] = _deflection(draw, surfaces)
    return keys


def _aircraft(draw: Draw, surfaces: list[str]) -> Keys:
    along = [f'{name}_{of}' for name in _SETS for of in ('0', 'alpha', 'q', 'elevator')]
    across = [
        f'{name}_{of}' for name in _LATERAL for of in ('0', 'beta', 'p', 'r', 'aileron', 'rudder')
    ]
    keys = draw.some({key: written(draw.signed()) for key in (*along, *across)})
    for key in ('aileron', 'elevator', 'rudder'):
        if surfaces and draw.yes():
            keys[key] = _deflection(draw, surfaces)
    return keys
