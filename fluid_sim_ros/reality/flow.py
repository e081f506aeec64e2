# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The wind or current that a flight recorded, in the model that it drives."""

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from fluid_sim_ros.flights.flight import Flight
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.config import MEDIUM
from fluid_sim_ros.reality.parameter import text_of

#: Rows of the series in a model, at most; a flow that was recorded more often is thinned evenly.
_MOST_ROWS = 5000
#: Changes of a flow below this are said nothing of when rows are left out [m/s].
_FELT = 0.01
#: Keys of fluid_sim.medium that stay beside a recorded flow: how fast a command is followed.
_KEPT = ('slew', 'datum')
#: ... and what a recorded flow holds already.
_HELD = ('turbulence', 'rotational_gust', 'wave')


def time_in_model(flight: Flight, times: Array) -> Array:
    """
    Return what the clock of a model shows at times of a flight [s].

    Parameters
    ----------
    flight
        A log of ours keeps the time of its simulation, by which a model's own flows change; any
        other begins at 0, as the stamps of a log may be too large to count steps in.
    times
        Of the flight [s].

    """
    return times + flight.begin if flight.raw.format == 'fluid_sim' else times


def recorded_flow(
    flight: Flight, stream: str
) -> tuple[Callable[[mujoco.MjSpec], None] | None, tuple[str, ...]]:
    """
    Return what lets the recorded flow act in a model, as it changes in time.

    What is recorded is the velocity of the air or water at the vehicle: it takes the place of all
    that the model has of its own there.

    Parameters
    ----------
    flight
        With or without a recorded flow.
    stream
        ``wind`` or ``current``: what moves the only fluid of the model. Where a surface parts two,
        whichever the vehicle is in moves as recorded.

    Returns
    -------
    edit, notes
        None where nothing was recorded; and what a reader must know.

    """
    signal = flight.signals.get('wind')
    if signal is None:
        return None, ()
    times, values, notes = _rows(signal.times, signal.values)
    still = not values.any()
    times, values = _led_in_and_out(times, values)
    rows = text_of(np.column_stack([time_in_model(flight, times), values]).ravel())

    def edit(spec: mujoco.MjSpec) -> None:
        media: list[Any] = [p for p in spec.plugins if p.plugin_name == MEDIUM]
        if not media:
            spec.option.wind = np.zeros(3)
            if still:
                return
            spec.activate_plugin(MEDIUM)
            media = [spec.add_plugin(name='recorded', plugin_name=MEDIUM, active=True)]
        for plugin in media:
            streams = ('wind', 'current') if 'surface' in plugin.config else (stream,)
            config = {k: v for k, v in plugin.config.items() if not _holds(k)}
            for name in ('wind', 'current'):
                config[name] = '0 0 0'
            plugin.config = config | {f'{name}_series': rows for name in streams}

    return edit, notes


def _holds(key: str) -> bool:
    """Return whether a key of the medium makes a flow that the recorded one holds."""
    stream, _, what = key.partition('_')
    own = stream in ('wind', 'current') and bool(what) and what not in _KEPT
    return own or key.startswith(_HELD)


def _rows(times: Array, values: Array) -> tuple[Array, Array, tuple[str, ...]]:
    """Return a series of at least two rows and not too many, and what was left out."""
    if not np.ptp(values, axis=0).any():
        return np.array([times[0], times[0] + 1.0]), values[:1].repeat(2, axis=0), ()
    if len(times) <= _MOST_ROWS:
        return times, values, ()
    taken = np.linspace(times[0], times[-1], _MOST_ROWS)
    thin = np.stack([np.interp(taken, times, v) for v in values.T], axis=1)
    back = np.stack([np.interp(times, taken, v) for v in thin.T], axis=1)
    off = float(np.abs(back - values).max())
    notes = (
        f'wind: {len(times)} samples become {_MOST_ROWS}, {taken[1] - taken[0]:.3g} s apart; what'
        f' is faster is left out, up to {off:.2g} m/s: if it counts, give a part of the log',
    ) if off > _FELT else ()  # fmt: skip
    return taken, thin, notes


def _led_in_and_out(times: Array, values: Array) -> tuple[Array, Array]:
    """Return a series with a row more at both ends: there a series of the medium is flat."""
    first, last = 2 * values[0] - values[1], 2 * values[-1] - values[-2]
    ends = 2 * times[0] - times[1], 2 * times[-1] - times[-2]
    return np.array([ends[0], *times, ends[1]]), np.vstack([first, values, last])
