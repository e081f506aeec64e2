# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The keys of ``fluid_sim.thruster``, and the actuators that go with them."""

import math

from test.support.hostile.models.draw import Draw, Keys, written
from test.support.hostile.models.medium import Fluid

CURVES = ('quadratic', 'polynomial', 'table', 'coefficients')


def drawn_thruster(draw: Draw, fluid: Fluid) -> Keys:
    """Draw keys of a thruster in a fluid."""
    curve = draw.choice(CURVES)
    keys: Keys = {'curve': curve}
    reverse = draw.yes()
    if curve != 'table':
        ends = [draw.size(1, 3000, far=(1e-30, 1e30)) for _ in range(1 + reverse)]
        keys['rad_s_max'] = written(ends)
        keys |= _pulse(draw, reverse) if draw.yes() else {}
    keys |= {
        'quadratic': _quadratic, 'polynomial': _polynomial, 'table': _table,
        'coefficients': _coefficients,
    }[curve](draw, reverse)  # fmt: skip
    keys |= draw.some({
        'command': draw.choice(('newton', 'normalized', 'rad_s', 'pwm_us')),
        'spin': draw.choice(('ccw', 'cw')),
        'rotor_inertia': written(draw.zero_or_size(1e-7, 1)),
        'rotor_drag': written([draw.zero_or_size(1e-7, 1e-2) for _ in range(draw.choice((1, 2)))]),
        'rolling_moment': written(draw.zero_or_size(1e-7, 1e-2)),
        'diameter': written(draw.size(0.02, 5, far=(1e-30, 1e15))),
        'time_constant': written(
            [draw.zero_or_size(1e-3, 1) for _ in range(draw.choice((1, 2)))]
        ),
    })  # fmt: skip
    if curve != 'coefficients':
        keys |= draw.some({'torque_ratio': written(draw.zero_or_size(1e-4, 0.1))})
    if draw.yes(0.3):
        far = written(draw.zero_or_size(0.1, 5))
        keys['ground_effect'] = draw.choice(('none', 'cheeseman_bennett', far))
        if keys['ground_effect'] not in ('none', '0'):
            keys |= draw.some({'ground': written(draw.signed(10))})
            keys.setdefault('diameter', '0.25')
    keys |= _fluid(draw, fluid, curve, keys)
    return keys | (_inflow(draw, curve, keys) if curve in ('quadratic', 'table') else {})


def _inflow(draw: Draw, curve: str, keys: Keys) -> Keys:
    if draw.yes(0.6):
        return draw.some({'inflow': 'false'}, 0.2)
    found = {'diameter': keys.get('diameter', written(draw.size(0.02, 1)))}
    found |= draw.some({'inflow': draw.choice(('true', 'true', 'false'))}, 0.8)
    advance = [draw.size(0.05, 5, far=(1e-30, 1e12)) for _ in range(draw.choice((1, 2)))]
    if curve == 'quadratic' and draw.yes():
        # above what the disc draws at rest, sqrt(2 k/(pi rho)) 2 pi/D^2
        density, diameter = float(keys.get('density', '1000')), float(found['diameter'])
        most = max(float(word) for word in keys['thrust_coefficient'].split())
        least = math.sqrt(2 * most / (math.pi * density)) * 2 * math.pi / diameter**2
        advance = [least * (1.001 + draw.size(1e-3, 10)) for _ in advance]
        found |= {'inflow_law': 'momentum', 'density': written(density)}
    else:
        found |= draw.some({'inflow_law': 'linear'}, 0.3)
        found |= draw.some({'measured_advance': written(0.9 * min(advance) * draw.random())}, 0.3)
    return found | {'zero_thrust_advance': written(advance)}


def _fluid(draw: Draw, fluid: Fluid, curve: str, keys: Keys) -> Keys:
    works = draw.choice(('constant', 'constant', 'local', *(('water', 'air') * fluid.surface)))
    found: Keys = {'fluid': works} if works != 'constant' or draw.yes() else {}
    if works != 'constant' and fluid.surface and 'diameter' not in keys:
        found['diameter'] = '0.3'
    if curve == 'coefficients' or works == 'local':
        found['density'] = written(draw.size(0.1, 2000, far=(1e-30,)))
    return found


def torque_acts(keys: Keys) -> bool:
    """Return whether a thruster has a reaction torque, and so needs its actuator."""
    return any(
        float(keys.get(key, '0').split()[0]) > 0
        for key in ('torque_ratio', 'torque_coefficients', 'rotor_inertia')
    )


def is_lagged(keys: Keys) -> bool:
    """Return whether a thruster has a lag, and so an activation of its own."""
    return any(float(word) > 0 for word in keys.get('time_constant', '').split())


def _pulse(draw: Draw, reverse: bool) -> Keys:
    neutral = draw.uniform(1200, 1600) if reverse else 1000.0
    keys = {'pwm_range': written([1000.0, neutral, 2000.0])}
    low = draw.uniform(1001, neutral) if reverse else neutral
    return keys | draw.some({'dead_zone': written([low, draw.uniform(neutral, 1999)])})


def _quadratic(draw: Draw, _: bool) -> Keys:
    far = (1e-30, 1e12)
    both = [draw.size(1e-9, 1e-2, far=far) for _ in range(draw.choice((1, 2)))]
    return {'thrust_coefficient': written(both)}


def _polynomial(draw: Draw, reverse: bool) -> Keys:
    def side() -> str:
        return written([draw.size(1e-6, 1) * 1e-3**i for i in range(draw.randrange(1, 5))])

    return {'polynomial_forward': side()} | ({'polynomial_reverse': side()} if reverse else {})


def _table(draw: Draw, reverse: bool) -> Keys:
    coefficient = {'thrust_coefficient': written(draw.size(1e-6, 1e-2))}
    if draw.yes(0.4):
        keys = {'table': 't200'} | draw.some({'voltage': written(draw.uniform(10, 20))})
        return keys | draw.some(coefficient)
    pairs = [(1500.0, 0.0)]
    for sign in (1, -1) if reverse else (1,):
        pulse, thrust = 1500.0, 0.0
        for _ in range(draw.randrange(1, 6)):
            pulse += sign * draw.size(0.1, 100, far=(1e-9,))
            thrust += sign * draw.size(0.01, 20, far=(1e-30, 1e12))
            pairs.append((pulse, thrust))
    return {'table': written(sorted(pairs)), **coefficient}


def _coefficients(draw: Draw, _: bool) -> Keys:
    def row(low: float, high: float) -> str:
        first = draw.size(low, high, far=(1e-30,))
        return written([first, *(0.1 * draw.signed() for _ in range(draw.randrange(3)))])

    scales = [draw.size(0.1, 2, far=(1e-30,)) for _ in range(draw.choice((1, 2)))]
    return {
        'thrust_coefficients': row(1e-3, 1), 'diameter': written(draw.size(0.02, 5)),
    } | draw.some({
        'torque_coefficients': row(1e-4, 0.1), 'reverse_scale': written(scales),
    })  # fmt: skip
