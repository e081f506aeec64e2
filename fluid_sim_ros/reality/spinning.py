# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""At what speed the rotors of a model begin a window, where they follow commands with a lag."""

import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.reality.driven import Driven
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.windows import Windows

#: Longest time before a window that rotors are spun up in, in time constants.
_LAGS = 8.0


def lead_in(driven: Driven, timestep: float) -> float:
    """
    Return the time before a window in which its rotors are spun up [s], in whole steps.

    Parameters
    ----------
    driven
        Whose lag counts; 0 where the speeds were measured.
    timestep
        [s].

    """
    if not driven.lag or driven.speed_columns:
        return 0.0
    return float(np.ceil(_LAGS * driven.lag / timestep) * timestep)


def first_speeds(flyer: Flyer, windows: Windows, start: Array) -> Array | None:
    """
    Return the speeds of the rotors that have a lag, at the begin of windows.

    Parameters
    ----------
    flyer
        Of the driven model.
    windows
        Of the flight.
    start
        States at their begins, shape (w, 13).

    Returns
    -------
    Array
        [rad/s], shape (w, m): as measured, or else as the commands before a window leave them;
        None where no rotor has a lag.

    """
    driven = flyer.driven
    if not driven.lag:
        return None
    if driven.speed_columns:
        signal = windows.flight.signals['rotor_speed']
        return signal.between(windows.begins)[:, list(driven.speed_columns)]
    before = lead_in(driven, flyer.timestep)
    lead = windows.controls(driven, flyer.timestep, before)
    full = flyer.states(start, windows, None)
    return flyer.spin_up(full, lead[:, : round(before / flyer.timestep)])
