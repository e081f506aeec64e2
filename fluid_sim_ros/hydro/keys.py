# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The keys of ``fluid_sim.body``, ready to paste."""

import numpy as np
from numpy.typing import ArrayLike

from fluid_sim_ros.hydro.coefficients import Coefficients


def body_keys(found: Coefficients) -> dict[str, str]:
    """
    Return the keys of ``fluid_sim.body`` for a body whose axes are those of the mesh.

    Parameters
    ----------
    found
        Of a mesh.

    Returns
    -------
    dict
        Key -> value.

    """
    added = found.added_mass
    return {
        'reference_point': numbers(added.point),
        'added_mass': numbers(added.matrix[np.triu_indices(6)], 12),
        'volume': numbers(found.statics.volume),
        'center_of_buoyancy': numbers(found.statics.center),
        'quadratic_damping': numbers(found.damping.quadratic, 4),
        'linear_damping': numbers(found.damping.linear, 4),
        'drag': 'none',
    }


def as_mjcf(keys: dict[str, str], indent: int = 0) -> str:
    """
    Return keys as the element of MJCF.

    Parameters
    ----------
    keys
        Of `body_keys`.
    indent
        Spaces before each line.

    Returns
    -------
    str
        ``<plugin plugin="fluid_sim.body">`` with its keys, a comment beside each.

    """
    notes = {
        'reference_point': '[m], about which added mass and damping are stated',
        'added_mass': 'upper triangle row by row: [kg], [kg m], [kg m^2]',
        'volume': '[m^3]',
        'center_of_buoyancy': '[m]',
        'quadratic_damping': '[N s^2/m^2] x 3, [N m s^2] x 3',
        'linear_damping': 'guess: as large at 0.1 m/s and rad/s; [N s/m] x 3, [N m s] x 3',
        'drag': 'the damping above holds it',
    }
    space = ' ' * indent
    lines = [f'{space}<plugin plugin="fluid_sim.body">']
    for key, value in keys.items():
        lines.append(f'{space}  <!-- {notes[key]} -->')
        lines += _wrapped(f'{space}  <config key="{key}" value="', value, f'{space}      ')
    return '\n'.join([*lines, f'{space}</plugin>'])


def _wrapped(head: str, value: str, space: str) -> list[str]:
    """Return an element with its value in lines of at most six numbers."""
    words = value.split(' ')
    rows = [' '.join(words[k : k + 6]) for k in range(0, len(words), 6)]
    if len(rows) == 1:
        return [f'{head}{value}"/>']
    return [f'{head}{rows[0]}', *(f'{space}{row}' for row in rows[1:-1]), f'{space}{rows[-1]}"/>']


def numbers(values: ArrayLike, digits: int = 9) -> str:
    """
    Return numbers as MJCF has them.

    Parameters
    ----------
    values
        Of any shape.
    digits
        Significant ones.

    Returns
    -------
    str
        Separated by spaces.

    """
    return ' '.join(f'{value + 0.0:.{digits}g}' for value in np.atleast_1d(values).reshape(-1))
