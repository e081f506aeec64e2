# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The motion of every body that belongs to a vehicle, as rows of a state."""

import mujoco
import numpy as np

from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.simulation import Simulation

#: Columns of a state: world position [m], quaternion w x y z, velocity [m/s] and rate [rad/s] in
#: body axes; as in physics/kirchhoff.py and in the observed rows.
POSITION, QUATERNION, VELOCITY, OMEGA = slice(0, 3), slice(3, 7), slice(7, 10), slice(10, 13)
STATE_WIDTH = 13


class BodyWatch:
    """
    Reads the states of all bodies of a simulation's vehicles, joints included.

    The bases come first, in the order of the vehicles; then every body below them that a joint
    moves. Links and fins that are off are seen by their own pose, not only by what they do to
    the base.

    Parameters
    ----------
    simulation
        Whose vehicles.

    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation  # whose memory is read below
        model = simulation.model
        bases = [vehicle.body_id for vehicle in simulation.vehicles.values()]
        links = [body for base in bases for body in _moved_below(model, base)]
        self._ids = np.array([*bases, *dict.fromkeys(links)], dtype=np.int32)
        self._rows = np.zeros((len(self._ids), nat.ROW_WIDTH))
        self._scratch = mujoco.MjData(model)
        self._addresses = (
            model._address, simulation.data._address, self._scratch._address,
            self._ids.ctypes.data, len(self._ids), 0, self._rows.ctypes.data,
        )  # fmt: skip
        self._observe = nat.native().observe

    def states(self) -> Array:
        """Return the present states, shape (bodies, 13)."""
        self._observe(*self._addresses)
        return self._rows[:, :STATE_WIDTH].copy()


def _moved_below(model: mujoco.MjModel, base: int) -> list[int]:
    """Return the bodies below a base that a joint moves."""
    below, moved = {base}, []
    for body in range(base + 1, model.nbody):  # a parent comes before its children
        if model.body_parentid[body] in below:
            below.add(body)
            if model.body_jntnum[body]:
                moved.append(body)
    return moved
