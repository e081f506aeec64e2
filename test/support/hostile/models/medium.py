# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The keys of ``fluid_sim.medium``."""

import math
from dataclasses import dataclass, field

from test.support.hostile.models.draw import Draw, Keys, written

GRAVITY = 9.81


@dataclass
class Fluid:
    """
    The fluid of a model.

    Attributes
    ----------
    stock
        MuJoCo's own fluid forces act: density and viscosity stand in ``<option>``.
    density, viscosity
        Of the lower fluid, or the only one [kg/m^3], [Pa s].
    above
        Density of the upper fluid [kg/m^3]; used with a surface only.
    surface
        There is one.
    keys
        Of the medium; None: there is no medium.
    grids
        Numbers of ``<custom><numeric>`` elements by name.

    """

    stock: bool = False
    density: float = 0.0
    viscosity: float = 0.0
    above: float = 0.0
    surface: bool = False
    keys: Keys | None = None
    grids: Keys = field(default_factory=dict)

    @property
    def dense(self) -> bool:
        """Whether something in it has a density."""
        return self.density > 0 or (self.surface and self.above > 0)


def drawn_fluid(draw: Draw, timestep: float) -> Fluid:
    """Draw the fluid of a model."""
    fluid = Fluid(stock=draw.yes(0.2))
    nothing = draw.yes(0.04)
    fluid.density = 0.0 if nothing else draw.size(0.1, 2000, far=(1e-300, 1e-12, 1e9))
    fluid.viscosity = 0.0 if nothing or draw.yes(0.1) else draw.size(1e-6, 10, far=(1e-300, 1e6))
    if draw.yes(0.08 if not nothing else 0.5):
        fluid.stock = True  # nothing else gives it
        return fluid
    keys: Keys = {}
    if not fluid.stock:
        keys['density'] = written(fluid.density)
        keys['viscosity'] = written(fluid.viscosity)
        fluid.surface = draw.yes(0.5)
    level = draw.choice((0.0, draw.gauss(0, 1), 100.0, -1e6))
    keys['surface'] = written(level) if fluid.surface else 'none'
    if fluid.surface and draw.yes(0.7):
        fluid.above = draw.zero_or_size(0.1, 10)
        keys['density_above'] = written(fluid.above)
        keys['viscosity_above'] = written(draw.zero_or_size(1e-6, 1))
    for name in ('wind', 'current'):
        keys |= _stream(draw, name, timestep, fluid)
    keys |= _turbulence(draw, timestep) if draw.yes(0.4) else {}
    if 'turbulence_span' not in keys and draw.yes(0.3):
        keys['rotational_gust'] = draw.choice(('none', 'curl'))
    keys |= _waves(draw) if fluid.surface and draw.yes(0.6) else {}
    if draw.yes(0.3):
        keys['seed'] = str(draw.choice((0, 1, 7, 2**53, draw.randrange(2**53))))
    fluid.keys = keys
    return fluid


def _stream(draw: Draw, name: str, timestep: float, fluid: Fluid) -> Keys:
    keys = draw.some({
        name: draw.vector(3),
        f'{name}_slew': written(draw.zero_or_size(0.01, 100)),
        f'{name}_datum': written(draw.signed(10)),
        f'{name}_profile': _profile(draw),
        f'{name}_signal': ' '.join(_signal(draw) for _ in range(draw.randrange(1, 4))),
        f'{name}_series': _series(draw),
    }, 0.4)  # fmt: skip
    if keys.get(f'{name}_profile', '').startswith(('power', 'log')):
        keys.setdefault(f'{name}_datum', '-5')
    if draw.yes(0.3):
        tick = draw.size(max(timestep / 900, 1e-3), 2, far=(1e6, 1e15, timestep / 900))
        time = tick * draw.size(0.1, 1000, far=(1.001e-6, 0.999e9))
        sigma = [draw.zero_or_size(0.01, 10) for _ in range(3)]
        keys[f'{name}_gauss_markov'] = written([*sigma, time])
        keys[f'{name}_tick'] = written(tick)
    if draw.yes(0.3):
        keys[f'{name}_grid'] = f'grid_of_{name}'
        fluid.grids[f'grid_of_{name}'] = _grid(draw)
    return keys


def _profile(draw: Draw) -> str:
    far = (1e-300, 1e15)
    roughness = draw.size(1e-4, 0.9, far=(1e-300,))
    heights = _rising(draw, draw.randrange(2, 6))
    table = [word for height in heights for word in (height, draw.signed())]
    power = [draw.size(0.05, 1, far=far), draw.size(0.1, 50, far=far)]
    return draw.choice((
        'uniform', f'power {written(power)}',
        f'log {written([roughness, roughness * draw.size(1.01, 1e5)])}',
        f'table {written(table)}',
    ))  # fmt: skip


def _signal(draw: Draw) -> str:
    kind = draw.choice(('ramp', 'sine', 'gust'))
    begin, length = draw.signed(1), draw.size(0.01, 100, far=(5e-324, 1e-300, 1e100))
    numbers = [length, begin] if kind == 'sine' else [begin, length]
    if kind == 'gust' and draw.yes():
        numbers.append(draw.zero_or_size(0.01, 10))
    return f'{kind} {draw.vector(3)} {written(numbers)}'


def _series(draw: Draw) -> str:
    times = _rising(draw, draw.randrange(2, 8))
    return ' '.join(f'{time:.17g} {draw.vector(2)}' for time in times)


def _rising(draw: Draw, count: int) -> list[float]:
    """Return numbers that rise; the first and the last are seldom far from the others."""
    found = [draw.gauss(0, 2)]
    while len(found) < count:
        found.append(found[-1] + draw.size(1e-6, 3))
    if draw.yes(0.1):
        found[-1] = draw.choice((1e12, 1e100, 1.7e308))
    if draw.yes(0.1) and count > 1:
        found[0] = draw.choice((-1e12, -1e100, -1.7e308))
    return found


def _grid(draw: Draw) -> str:
    sizes = [draw.choice((1, 1, 2, 3, 5)) for _ in range(4)]
    numbers: list[float] = [*sizes]
    for size in sizes:
        numbers += _rising(draw, size)
    numbers += [draw.signed() for _ in range(3 * math.prod(sizes))]
    return written(numbers)


def _waves(draw: Draw) -> Keys:
    period = draw.size(0.5, 20, far=(1e-3, 1e6))
    depth = draw.size(0.5, 200, far=(1e15, 0.01)) if draw.yes(0.4) else math.inf
    length = GRAVITY * period**2 / (2 * math.pi)  # deep; shallow waves break lower
    shallow = length * math.sqrt(math.tanh(2 * math.pi * depth / length))
    height = 0.1 * draw.random() * shallow * math.tanh(2 * math.pi * depth / shallow)
    keys = draw.some({'wave_direction': f'{draw.gauss(0, 1)} {draw.gauss(0, 1)}'})
    if math.isfinite(depth):
        keys['water_depth'] = written(depth)
    kind = draw.choice(('regular', 'jonswap', 'jonswap', 'none'))
    if kind == 'none':
        return {'waves': 'none'}
    keys['waves'] = f'{kind} {written([height, period])}'
    if kind == 'regular':
        return keys
    gamma = f' {draw.uniform(1, 10)}' if draw.yes() else ''
    count = draw.choice((1, 2, 8, 8, 32, 64, 300))
    cutoff = draw.uniform(1.5, 20)
    shortest = period / (0.5 * ((2 * cutoff) ** (1 / count) - 1))
    return keys | {
        'waves': keys['waves'] + gamma,
        'wave_components': str(count),
        'wave_cutoff': written(cutoff),
        'wave_repeat': written(shortest * draw.size(1.01, 100, far=(1e12,))),
    } | draw.some({
        'wave_spreading': written(draw.choice((0.0, 1.0, 15.5, 1000.0))),
        'wave_seed': str(draw.choice((0, 3, 2**53))),
    })  # fmt: skip


def _turbulence(draw: Draw, timestep: float) -> Keys:
    kind = draw.choice(('dryden', 'dryden', 'von_karman', 'von_karman', 'none'))
    tick = draw.choice((None, timestep, 10 * timestep, 0.1, 10.0))
    tick = tick if tick is None or tick >= timestep / 900 else timestep
    keys: Keys = {'turbulence': kind, 'turbulence_airspeed': written(draw.size(0.5, 100))}
    if tick is not None:
        keys['turbulence_tick'] = written(tick)
    if draw.yes(0.7):
        wind = draw.size(0.1, 30, far=(1e-300, 1e12))
        keys['turbulence_wind_6m'] = written(wind)
    else:
        keys['turbulence_sigma'] = written([draw.zero_or_size(0.1, 10) for _ in range(3)])
    if draw.yes(0.7):
        keys['turbulence_height'] = written(draw.size(0.1, 2e4, far=(1e-14, 1e100)))
    else:
        keys['turbulence_length'] = written([draw.size(1, 1e3) for _ in range(3)])
    chances = ('2e-1', '1e-1', '1e-2', '1e-3', '1e-4', '1e-5', '1e-6')
    keys |= draw.some({
        'turbulence_exceedance': draw.choice(chances),
        'turbulence_direction': f'{draw.gauss(0, 1)} {draw.gauss(0, 1)} {draw.signed()}',
        'turbulence_ground': written(draw.signed(100)),
        'turbulence_span': written(draw.size(0.05, 50)),
    })  # fmt: skip
    if 'turbulence_length' not in keys and timestep <= float(keys.get('turbulence_tick', 0.01)):
        keys['turbulence_follow'] = draw.choice(('none', 'vehicle'))
    return keys
