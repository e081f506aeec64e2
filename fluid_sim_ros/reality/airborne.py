"""Which windows of a flight are flown, not stood on the ground."""

from dataclasses import replace

import numpy as np

from fluid_sim_ros.flights.flight import FlightError
from fluid_sim_ros.physics.environment.atmosphere import GRAVITY
from fluid_sim_ros.plugins.config import BODY, plugin_of_body
from fluid_sim_ros.reality.driven import Driven
from fluid_sim_ros.reality.flying import Flyer
from fluid_sim_ros.reality.residuals import accelerations
from fluid_sim_ros.reality.windows import Windows

#: Below this share of the weight a vehicle that stands still stands on something.
_LIFTED = 0.5


def airborne(windows: Windows, flyer: Flyer) -> tuple[Windows, dict[str, int]]:
    """
    Leave out windows in which an aerial vehicle stands on the ground.

    Parameters
    ----------
    windows
        Of the flight.
    flyer
        Of the driven model; one that displaces water floats and is never on the ground.

    Returns
    -------
    windows, left_out
        Those that are left, and how many are not.

    Raises
    ------
    FlightError
        If none is left.

    """
    start = windows.measured(0.0)
    moved = windows.measured(windows.length)
    still = np.linalg.norm(moved[:, :3] - start[:, :3], axis=1) < 0.02 * windows.length
    still &= np.linalg.norm(start[:, 7:10], axis=1) < 0.05
    if _floats(flyer.driven):
        return windows, {}
    middle = windows.begins + 0.5 * windows.length
    lifted = accelerations(flyer, windows.flight, middle).force[:, 2] > _LIFTED * GRAVITY
    standing = still & ~lifted
    if standing.all():
        raise FlightError(
            f'{windows.flight.raw.path}: the vehicle stands still throughout, with thrust below '
            'half of its weight; give --from and --to of the flight'
        )
    kept = replace(windows, begins=windows.begins[~standing])
    count = int(standing.sum())
    return kept, {'stand on the ground': count} if count else {}


def _floats(driven: Driven) -> bool:
    body = plugin_of_body(driven.model, driven.vehicle.body_id, BODY)
    return body is not None and bool(body.text('volume'))
