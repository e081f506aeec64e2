# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""A controller in the loop of a sweep's run: it holds a place, and its errors are measured."""

import dataclasses
import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from fluid_sim_ros.control.gains import Gains
from fluid_sim_ros.control.multirotor import MultirotorController, MultirotorGains, PoseTarget
from fluid_sim_ros.control.plant import Plant
from fluid_sim_ros.control.state import State
from fluid_sim_ros.control.underwater import DepthTarget, UnderwaterController, UnderwaterGains
from fluid_sim_ros.errors import ConfigError, did_you_mean, listed
from fluid_sim_ros.loop.hold import state_of
from fluid_sim_ros.plugins import native as nat
from fluid_sim_ros.simulation import Simulation
from fluid_sim_ros.step_clock import Beat
from fluid_sim_ros.sweep.sweep_file import Hold, Value

#: Takes a state; returns thrusts [N].
Answer = Callable[[State], list[float]]


class HoldController:
    """
    The controller of one vehicle; made by ``hold_controller``.

    Parameters
    ----------
    hold
        What it holds.
    vehicle
        Name of the vehicle.
    row
        Its row in an observation.
    beat
        At which steps it answers.
    law
        Makes the law of some gains.

    Attributes
    ----------
    beat
        As above.

    """

    def __init__(
        self, hold: Hold, vehicle: str, row: int, beat: Beat, law: Callable[[Gains], Answer]
    ) -> None:
        self.beat = beat
        self._hold = hold
        self._vehicle = vehicle
        self._row = row
        self._law = law
        self._target = np.array(hold.target)
        self._errors: list[float] = []

    def begin(self, values: Mapping[str, Value]) -> None:
        """
        Begin a run with the gains of its case.

        Parameters
        ----------
        values
            Of the case; those of gains are taken.

        Raises
        ------
        ConfigError
            For a gain that the law does not have.

        """
        kind = _GAINS[self._hold.law]
        varied = {k.removeprefix('gain.'): v for k, v in values.items() if k.startswith('gain.')}
        self._answer = self._law(_gains(kind, {**self._hold.gains, **varied}))
        self._errors = []

    def answer(self, simulation: Simulation) -> None:
        """
        Answer the present state with thrusts.

        Parameters
        ----------
        simulation
            Is observed, and gets the thrusts [N].

        """
        row = simulation.observe(forces=False)[self._row]
        self._errors.append(math.dist(row[nat.POSITION], self._target))
        thrusts = self._answer(state_of(simulation, row))
        simulation.set_thrust(self._vehicle, thrusts)

    def columns(self) -> dict[str, Any]:
        """Return the distances from the target over the run [m]."""
        errors = np.array(self._errors)
        return {
            'hold.rms_error_m': float(np.sqrt((errors * errors).mean())),
            'hold.largest_error_m': float(errors.max()),
            'hold.end_error_m': float(errors[-1]),
        }


_GAINS: dict[str, type[Gains]] = {'multirotor': MultirotorGains, 'underwater': UnderwaterGains}


def hold_controller(
    hold: Hold, plant: Plant, vehicle: str, simulation: Simulation
) -> HoldController:
    """
    Return the controller of a sweep for a simulation.

    Parameters
    ----------
    hold
        Which law, and what it holds.
    plant, vehicle
        What the controller believes of its vehicle (``plant_of`` the scene as it stands), and the
        vehicle's name.
    simulation
        What it will steer; a mass that varies is not known to the controller.

    Returns
    -------
    HoldController
        The controller.

    Raises
    ------
    ConfigError
        If the rate is above the step rate.

    """
    beat = Beat.at_rate(hold.rate, simulation.timestep, "key 'hold.rate'")
    row = list(simulation.vehicles).index(vehicle)
    return HoldController(hold, vehicle, row, beat, _LAWS[hold.law](hold, plant))


def _gains(kind: type[Gains], values: Mapping[str, Any]) -> Gains:
    known = [entry.name for entry in dataclasses.fields(kind)]
    unknown = [name for name in values if name not in known]
    if unknown:
        hint = did_you_mean(unknown[0], known)
        raise ConfigError(f"gain '{unknown[0]}' is not known{hint} allowed: {listed(known)}")
    return kind(**values)


def _multirotor(hold: Hold, plant: Plant) -> Callable[[Any], Answer]:
    return lambda gains: partial(
        MultirotorController(plant, gains).step, target=PoseTarget(hold.target, hold.yaw)
    )


def _underwater(hold: Hold, plant: Plant) -> Callable[[Any], Answer]:
    return lambda gains: partial(
        UnderwaterController(plant, gains).step,
        target=DepthTarget(-hold.target[2], hold.yaw, place_w=hold.target),
    )  # fmt: skip


_LAWS = {'multirotor': _multirotor, 'underwater': _underwater}
