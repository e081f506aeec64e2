# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The report of an import: what was read, decided and guessed."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.hydro.report import table
from fluid_sim_ros.new_vehicle.importing.vehicle import Imported
from fluid_sim_ros.new_vehicle.layout import DENSITY


def report_of(vehicle: Imported, drift: float) -> str:
    """
    Return the report as Markdown.

    Parameters
    ----------
    vehicle
        That was imported.
    drift
        In the trial [m].

    Returns
    -------
    str
        A page.

    """
    contents, mass = vehicle.contents, vehicle.contents.mass
    skeleton = contents.skeleton
    name = skeleton.source.name
    moments = np.linalg.eigvalsh(mass.inertia)
    rows = [
        ('file', skeleton.source.path.name),
        ('medium', f'{contents.medium}, {contents.density:g} kg/m³'),
        ('mass', f'{mass.total:.5g} kg ({mass.source})'),
        ('centre of mass', f'{_row(mass.total_center)} m in base axes'),
        ('principal moments of inertia', f'{_row(moments)} kg m² of the base'),
        ('size of the hull', f'{contents.size:.4g} m at most'),
    ]
    if contents.medium == 'water':
        rows.append(('net buoyancy', f'{vehicle.buoyancy:+.4g} N'))
    rows.append(('drift in a trial of 2 s', f'{drift:.2g} m'))
    parts = [f'# {name}', table(('', ''), rows), '## Decided', *_decided(vehicle)]
    heads = ('thruster', 'position from the centre of mass [m]', 'direction', 'limits [N]',
             'spin', 'diameter [m]', 'lag [s]')  # fmt: skip
    lines = [
        (
            t.name, _row(t.position), _row(t.direction), _row(np.array(t.limits)),
            {1: 'ccw', -1: 'cw', 0: 'none'}[t.spin], f'{t.diameter:.4g}', _row(np.array(t.lag)),
        )
        for t in contents.thrusters
    ]  # fmt: skip
    parts += ['## Thrusters', table(heads, lines)]
    if vehicle.hydro is not None:
        parts += [
            '## Fluid',
            f'Added mass, buoyancy and damping: [{name}_hydro.md]({name}_hydro.md).',
        ]
    else:
        keys = ', '.join(f'`{key}` {value}' for key, value in contents.fluid_keys.items())
        parts += ['## Fluid', f'Form drag and friction of the hull, in air: {keys}.']
    return '\n\n'.join(parts) + '\n'


def _decided(vehicle: Imported) -> list[str]:
    contents = vehicle.contents
    said = list(vehicle.said)
    if vehicle.answers.fluid_density is None:
        said.append(f'density of the fluid: {DENSITY[contents.medium]:g} kg/m³, the default')
    said.append(
        'guess where the list of thrusters is silent: diameter, thrust coefficient, reverse, '
        'torque over thrust, lag (doc/new_vehicle.md of fluid_sim_ros)'
    )
    return ['\n'.join(f'* {line}' for line in said)]


def _row(values: ArrayLike) -> str:
    return ' '.join(f'{value + 0.0:.4g}' for value in np.round(np.atleast_1d(values), 9))
