# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What residuals say, in sentences for people."""

from collections.abc import Sequence
from typing import Any

from fluid_sim_ros.errors import listed
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY
from fluid_sim_ros.reality.residual.numbers import AXES
from fluid_sim_ros.reality.residual.residuals import AVERAGE

#: A word is said of an axis from this share of the force on, and of its scatter.
_WORTH, _CLEAR = 0.02, 0.25
#: ... and where it is more than the rounding of a log [m/s^2].
_LEAST = 0.02
#: A model whose force is so many times off is of another vehicle.
_ANOTHER = 1.6
#: A model that turns by less says nothing of the order of its thrusters [rad/s^2].
_TURNS = 1.0
_TURNED = tuple(zip(AXES, ('roll', 'pitch', 'yaw'), strict=True))


def words(numbers: dict[str, Any], order: Sequence[str] = ()) -> list[str]:
    """
    Return what the residuals say, for people.

    Parameters
    ----------
    numbers
        As ``summary`` returns them.
    order
        Of the thrusters, as ``likely_order`` returns it.

    """
    lines: list[str] = []
    if order:
        lines.append(
            'the vehicle moves as if its thrusters were in another order: say thrusters: '
            f'[{", ".join(order)}] in the mapping'
        )
    force = numbers.get('specific_force')
    if force is None:
        lines.append('no accelerometer in the log: nothing can be said of the forces by axis')
    else:
        lines += _along_z(force['axes']['z'], numbers.get('floats', False))
        lines += [_drag(axis, force['axes'][axis]) for axis in AXES]
        still = [axis for axis in AXES if force['axes'][axis]['per_speed'] is None]
        if still:
            lines.append(
                f'nothing can be said of drag along {listed(still)}: the speed there hardly '
                f'changes (rms {max(force["axes"][a]["speed_rms"] for a in still):.2g} m/s)'
            )
        lines.append(
            f'specific force along z: {100 * force["z_rms_of_g"]:.1f} % of g off (rms over '
            f'{1e3 * AVERAGE:.0f} ms)'
        )
    turns = numbers['angular_acceleration']['axes']
    odd = [name for axis, name in _TURNED if _turns_otherwise(turns[axis])]
    if odd and not order:
        lines.append(
            f'in {", ".join(odd)} the vehicle does not turn as the model would: are the thrusters '
            'in the order of the log (thrusters: [...] in the mapping), the axes right?'
        )
    for axis, name in _TURNED:
        turn = turns[axis]
        if abs(turn['mean']) > max(_CLEAR * turn['rms'], 0.05):
            lines.append(
                f'a constant {turn["mean"]:+.2g} rad/s^2 is missing in {name}: the centre of mass '
                'is not where the model has it, or the thrusters differ'
            )
    return [line for line in lines if line]


def _turns_otherwise(turn: dict[str, Any]) -> bool:
    """Return whether a model turns the other way, or clearly without being alike."""
    if turn['scale'] is not None:
        return bool(turn['scale'] < 0)
    return bool(turn['model_rms'] > max(_TURNS, turn['measured_rms']))


def _along_z(numbers: dict[str, Any], floats: bool) -> list[str]:
    """Return whether thrust fits, and of what floats, whether its weight in water does."""
    lines = []
    scale, mean = numbers['scale'], numbers['mean']
    if scale is not None and not 1 / _ANOTHER < scale < _ANOTHER:
        lines.append(
            f'along z the model gives {1 / scale:.2g} times the force that was measured: another '
            'vehicle, or commands that mean something else (--mapping)?'
        )
    elif scale is not None and abs(scale - 1) > _WORTH:
        weak = 'too weak' if scale > 1 else 'too strong'
        lines.append(f'the model is {100 * abs(scale - 1):.0f} % {weak} along z')
    elif scale is None and floats:
        lines.append('nothing can be said of thrust along z: hardly any force changes there')
    elif scale is None:
        lines.append(
            'the forces of the model along z are not those that were measured: another vehicle, '
            'or its commands mean something else (--mapping)?'
        )
    if floats and abs(mean) > _WORTH * GRAVITY:
        lines.append(
            f'a constant {mean:+.2g} m/s^2 is missing along z: mass or volume are not those of '
            'the model'
        )
    return lines


def _drag(axis: str, numbers: dict[str, Any]) -> str:
    slope, explains = numbers['per_speed'], numbers['per_speed_explains']
    if slope is None or explains < _CLEAR or numbers['rms'] < _LEAST:
        return ''
    if slope < 0:
        return (
            f'drag is missing along {axis}: {-slope:.3g} m/s^2 for each m/s '
            f'({100 * explains:.0f} % of what is off there)'
        )
    return (
        f'there is too much drag along {axis}: {slope:.3g} m/s^2 for each m/s '
        f'({100 * explains:.0f} % of what is off there)'
    )
