# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Wind and current as commands: where they are written, and whether the scene has them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.errors import CommandError, listed
from fluid_sim_ros.physics.arrays import Array
from fluid_sim_ros.plugins.config import MEDIUM
from fluid_sim_ros.plugins.native import native
from fluid_sim_ros.scene.media import MOST_SEEDS, OPTION
from fluid_sim_ros.simulation.engine import Engine

STREAMS = ('wind', 'current')


@dataclass(frozen=True)
class SavedStreams:
    """Commanded velocities [m/s] and whether they act."""

    wind_w: Array
    current_w: Array
    enabled: bool


class WindAndCurrent:
    """
    The wind and the current of a scene.

    A model with ``fluid_sim.medium`` takes targets, towards which its mean flows move at a limited
    rate; signals and turbulence ride on top. Without one, ``opt.wind`` is the velocity of the only
    fluid and changes at once.

    Parameters
    ----------
    engine
        Model and data.
    available
        Which of ``STREAMS`` the scene has.
    on_unfelt
        Called with the name of a stream that is commanded although no body feels it; None: bodies
        feel it.

    """

    def __init__(
        self,
        engine: Engine,
        available: tuple[str, ...],
        on_unfelt: Callable[[str], None] | None = None,
    ) -> None:
        self.available = available
        self._on_unfelt = on_unfelt
        self._engine = engine
        self._velocity = {name: np.zeros(3) for name in STREAMS}
        self._written = {name: np.zeros(3) for name in STREAMS}
        # wind first, then current: the order of the library's arguments
        self._addresses = tuple(self._written[name].ctypes.data for name in STREAMS)
        self._has_medium = bool(native().get_medium(*engine.addresses, *self._addresses))
        self._initial = engine.model.opt.wind.copy()
        self._enabled = True

    def reset(self) -> None:
        """Take the scene's own velocities again; the engine was reset before."""
        self._enabled = True
        if self._has_medium:
            native().get_medium(*self._engine.addresses, *self._addresses)
            for name in STREAMS:
                self._velocity[name] = self._written[name].copy()
            return
        for name in STREAMS:
            self._velocity[name] = np.zeros(3)
        self._velocity[self.available[0]] = self._initial.copy()
        self._write()

    @property
    def source(self) -> str:
        """How the flow reaches the bodies: ``fluid_sim.medium`` or ``opt.wind``."""
        return MEDIUM if self._has_medium else OPTION

    def seed(self, seed: int) -> None:
        """
        Start what is random anew at the present time.

        Parameters
        ----------
        seed
            Any whole number.

        """
        native().seed_medium(*self._engine.addresses, float(seed % MOST_SEEDS))

    def check(self, name: str) -> None:
        """
        Refuse a stream that the scene does not have.

        Parameters
        ----------
        name
            ``wind`` or ``current``.

        Raises
        ------
        CommandError
            If the scene lacks it, with what it has.

        """
        if name not in self.available:
            medium = 'water' if 'current' in self.available else 'air'
            raise CommandError(
                f'{name}: the scene is in {medium} only; command the {listed(self.available)}'
            )

    def set(self, name: str, velocity_w: Array) -> None:
        """
        Command a velocity.

        Parameters
        ----------
        name
            ``wind`` or ``current``.
        velocity_w
            [m/s], world axes, shape (3,).

        Raises
        ------
        CommandError
            If the scene lacks the stream, or no body feels it.

        """
        self.check(name)
        if self._on_unfelt is not None and velocity_w.any():
            self._on_unfelt(name)
        self._velocity[name] = velocity_w.copy()
        self._write()

    def enable(self, enabled: bool) -> None:
        """
        Let the commanded velocities act, or still the fluids; the commands are kept.

        Parameters
        ----------
        enabled
            Whether the commanded velocities act.

        """
        self._enabled = enabled
        self._write()

    def save(self) -> SavedStreams:
        """Return the commands."""
        return SavedStreams(
            self._velocity['wind'].copy(), self._velocity['current'].copy(), self._enabled
        )

    def load(self, saved: SavedStreams) -> None:
        """
        Take up saved commands; the engine's state was loaded before.

        Parameters
        ----------
        saved
            As ``save`` returned it.

        """
        self._velocity = {'wind': saved.wind_w.copy(), 'current': saved.current_w.copy()}
        self._enabled = saved.enabled
        self._write()

    def _write(self) -> None:
        for name in STREAMS:
            self._written[name][:] = self._velocity[name] if self._enabled else 0.0
        if self._has_medium:
            native().set_medium(*self._engine.addresses, *self._addresses)
            native().enable_medium(*self._engine.addresses, self._enabled)
        else:
            self._engine.model.opt.wind = self._written[self.available[0]]
