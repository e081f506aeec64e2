# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
A flight's state smoothed: what pose, gyro and accelerometer say together, before and after.

No model of the vehicle takes part. Rates and specific force carry the state from sample to sample
(strapdown), poses correct it: an error-state Kalman filter forth (Sola 2017, Quaternion kinematics
for the error-state Kalman filter, ch. 5) and the smoother of Rauch, Tung and Striebel (1965) back.
Unknown, too, and constant: the biases of accelerometer and gyro, where the followed point lies
(motion capture follows the middle of its markers, not the sensors), and how its axes are turned.
"""

from dataclasses import dataclass, replace

import numpy as np

from fluid_sim_ros.flights.flight import Flight, FlightError, Signal
from fluid_sim_ros.flights.strapdown import NEEDED, Strapdown, rotations_of
from fluid_sim_ros.flights.tidy import find_outliers
from fluid_sim_ros.physics.arrays import Array

_FEW = 50
#: Noise of gyro and accelerometer is raised by a factor while poses surprise by more than this.
_MORE, _SURPRISED, _MOST_TRIALS = 1.6, 1.15, 6


@dataclass(frozen=True)
class Smoothed:
    """
    What came out.

    Attributes
    ----------
    flight
        With the smoothed state in place of the measured one.
    sigmas
        Standard deviations of position, velocity, attitude [m], [m/s], [rad] of one axis, median
        over the flight, as the smoother states them.
    apart
        Rms of one axis of measured less smoothed position, velocity, attitude, in the same units;
        of the velocity None where none was measured.
    surprise
        Rms of what poses differ from their forecast by, over what was expected: about 1.
    point, turn
        Place of the followed point [m], and turn of its axes [rad], both in body axes.

    """

    flight: Flight
    sigmas: tuple[float, float, float]
    apart: tuple[float, float | None, float]
    surprise: float
    point: Array
    turn: Array

    @property
    def line(self) -> str:
        """What a reader must know."""
        place = ', '.join(f'{1e3 * v:.0f}' for v in self.point)
        turned = ', '.join(f'{np.degrees(v):.1f}' for v in self.turn)
        position, velocity, attitude = self.sigmas
        return (
            'state smoothed from pose, gyro and accelerometer, of later samples, too: within '
            f'{1e3 * position:.2g} mm, {1e3 * velocity:.2g} mm/s, {np.degrees(attitude):.2g} deg; '
            f'the followed point lies at ({place}) mm, turned by ({turned}) deg; poses differ '
            f'from their forecast by {self.surprise:.2g} of what was expected'
        )


def smoothed(flight: Flight) -> Smoothed:
    """
    Return a flight with its state smoothed.

    Parameters
    ----------
    flight
        With position, attitude, rates and specific force; the pose measured (motion capture), not
        estimated from the same gyro and accelerometer.

    Raises
    ------
    FlightError
        If one of them is missing, or there are too few.

    """
    lacking = [name for name in NEEDED if name not in flight.signals]
    if lacking:
        raise FlightError(
            f'{flight.raw.path}: --smooth needs {", ".join(NEEDED)}; {", ".join(lacking)} is '
            'missing: name its columns in a mapping (--mapping FILE), or leave --smooth out'
        )
    signals = flight.signals
    short = [name for name in NEEDED if len(signals[name].times) < _FEW]
    if short:
        raise FlightError(f'{flight.raw.path}: --smooth needs {_FEW} samples of {short[0]}')
    run = Strapdown(flight)
    run.forth()
    for _ in range(_MOST_TRIALS):  # what shakes slowly is no white noise: it counts for more
        if run.surprise < _SURPRISED:
            break
        run.noise *= _MORE
        run.forth()
    run.back()
    found = {name: signals[name] for name in signals}
    times, turned = run.times, rotations_of(run.turn)
    quaternions = np.roll(turned.as_quat(), 1, axis=1)
    signs = np.cumprod(
        np.r_[1.0, np.where((quaternions[1:] * quaternions[:-1]).sum(1) < 0, -1, 1)]
    )
    values = {'position': run.position, 'attitude': quaternions * signs[:, None],
              'velocity': run.velocity}  # fmt: skip
    gaps = tuple(sorted({g for name in NEEDED for g in signals[name].gaps}))
    for name, each in values.items():
        found[name] = Signal(
            name, times, each, 'smoothed', gaps=gaps, outliers=find_outliers(name, each),
            stated='smoothed',
        )  # fmt: skip
    rates = signals['rates']
    bias = np.stack([np.interp(rates.times, times, b) for b in run.constants[:, 3:6].T], axis=1)
    found['rates'] = replace(rates, values=rates.values - bias)
    force = signals['specific_force']
    bias = np.stack([np.interp(force.times, times, b) for b in run.constants[:, :3].T], axis=1)
    found['specific_force'] = replace(force, values=force.values - bias)
    spread = np.sqrt(np.median(np.diagonal(run.cover, axis1=1, axis2=2), axis=0))
    # position, velocity, turn: the first nine errors
    sigmas = tuple(float(np.sqrt((spread[i : i + 3] ** 2).mean())) for i in (0, 3, 6))
    result = Smoothed(
        flight, (sigmas[0], sigmas[1], sigmas[2]), run.apart(), run.surprise,
        run.constants[len(times) // 2, 9:], run.constants[len(times) // 2, 6:9],
    )  # fmt: skip
    return replace(
        result, flight=replace(flight, signals=found, notes=(*flight.notes, result.line))
    )
