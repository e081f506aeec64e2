# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The fluid wrench on a vehicle, term by term."""

from fluid_sim_ros.errors import CommandError, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.simulation.engine import Engine

#: Force [N] and torque [N m], base_link axes, about the base_link origin, acting on the vehicle.
ForceTorque = tuple[Array, Array]


class VehicleWrenches:
    """
    Evaluates the wrenches on the vehicles of a simulation.

    Parameters
    ----------
    engine
        Model and data.
    names
        Of the vehicles, in the order of the engine's rows.

    """

    def __init__(self, engine: Engine, names: tuple[str, ...]) -> None:
        self._engine, self._names = engine, names

    def wrench(self, vehicle: str) -> dict[str, ForceTorque]:
        """
        Return the fluid wrench on a vehicle term by term, at this step boundary.

        Parameters
        ----------
        vehicle
            Vehicle name.

        Returns
        -------
        dict
            Term (``plugins.native.TERMS``) -> (force, torque), [N] and [N m], shape (3,) each,
            base_link axes, about its origin, acting on the vehicle; 0 for what is not there.

        Raises
        ------
        CommandError
            If the scene has no such vehicle.

        """
        if vehicle not in self._names:
            raise CommandError(
                f"vehicle '{vehicle}' is not in the scene; it has: {listed(self._names)}"
            )
        row = self._engine.observe(forces=True)[self._names.index(vehicle)].copy()
        columns = {term: row[nat.term_columns(term)] for term in nat.TERMS}
        return {term: (wrench[:3], wrench[3:]) for term, wrench in columns.items()}
