# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What the view is fed by: a simulation in this process, a log, or a running node."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence

import mujoco

from fluid_sim_ros.scene.vehicle import Vehicle
from fluid_sim_ros.view.frame import Frame
from fluid_sim_ros.view.orders import Order


class Source(ABC):
    """
    A source of frames that takes orders.

    ``run`` is called once, in the main thread; everything else may be called by any thread.

    Attributes
    ----------
    title
        What is shown.
    model
        To draw and to pose; only read.
    vehicles
        By name, in the order of a frame's rows.
    terms
        Vehicle name -> names of the fluid terms that can act on it.
    streams
        Which of wind and current there are.
    rungs
        Fluid models to choose from; the present one first.
    takes
        The kinds of orders (``view.orders``) that it understands.
    span
        Simulated time of the first and of the last frame [s]; equal where there is no end.
    generation
        Rises with every new ``model``.
    pace
        Simulated seconds per second that are wanted; 0: as fast as it goes.

    """

    title: str
    model: mujoco.MjModel
    vehicles: Mapping[str, Vehicle]
    terms: Mapping[str, tuple[str, ...]]
    streams: tuple[str, ...]
    rungs: Sequence[str]
    takes: frozenset[type]
    span: tuple[float, float]
    generation: int
    pace: float

    @abstractmethod
    def frame(self) -> Frame | None:
        """Return the newest frame that there is, and have a newer one made; never blocks."""

    @abstractmethod
    def take(self, order: Order) -> None:
        """
        Do what is asked, at the next step boundary; returns when it is done.

        Parameters
        ----------
        order
            Of a kind that ``takes`` holds.

        Raises
        ------
        FluidSimError
            If it cannot be done; says why.

        """

    @abstractmethod
    def run(self) -> None:
        """Work until ``stop``."""

    @abstractmethod
    def stop(self) -> None:
        """End ``run``."""
