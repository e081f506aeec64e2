"""What residuals say, in sentences for people."""

from typing import Any

from fluid_sim_ros.reality.residuals import AVERAGE, AXES

#: A word is said of an axis from this share of the force on, and of its scatter.
_WORTH, _CLEAR = 0.02, 0.25
#: ... and where it is more than the rounding of a log [m/s^2].
_LEAST = 0.02


def words(numbers: dict[str, Any]) -> list[str]:
    """
    Return what the residuals say, for people.

    Parameters
    ----------
    numbers
        As ``summary`` returns them.

    """
    lines: list[str] = []
    force = numbers.get('specific_force')
    if force is None:
        lines.append('no accelerometer in the log: nothing can be said of the forces by axis')
    else:
        z = force['axes']['z']
        share = z['scale'] - 1
        if abs(share) > _WORTH:
            weak = 'too weak' if share > 0 else 'too strong'
            lines.append(f'the model is {100 * abs(share):.0f} % {weak} along z')
        lines += [_drag(axis, force['axes'][axis]) for axis in AXES]
        lines.append(
            f'specific force along z: {100 * force["z_rms_of_g"]:.1f} % of g off (rms over '
            f'{1e3 * AVERAGE:.0f} ms)'
        )
    for axis, name in zip(AXES, ('roll', 'pitch', 'yaw'), strict=True):
        turn = numbers['angular_acceleration']['axes'][axis]
        if abs(turn['mean']) > max(_CLEAR * turn['rms'], 0.05):
            lines.append(
                f'a constant {turn["mean"]:+.2g} rad/s^2 is missing in {name}: the centre of mass '
                'is not where the model has it, or the thrusters differ'
            )
    return [line for line in lines if line]


def _drag(axis: str, numbers: dict[str, float]) -> str:
    slope, explains = numbers['per_speed'], numbers['per_speed_explains']
    if explains < _CLEAR or numbers['rms'] < _LEAST:
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
