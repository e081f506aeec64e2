# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The way to live viewers: what a run needs to know of the part that serves them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Protocol

from fluid_sim_ros.errors import needed_for
from fluid_sim_ros.simulation import Simulation

#: The part that serves; it has ``open_foxglove`` with the arguments of the function below.
_PART = 'fluid_sim_ros.foxglove.sink'
#: Where Foxglove looks by default.
DEFAULT_PORT = 8765


@dataclass(frozen=True)
class LiveControl:
    """
    What a viewer may do to a run; each is called in a thread of the server's.

    Attributes
    ----------
    act
        ``reset``, ``step``, or ``pause`` with a truth value -> what to tell the user; raises
        FluidSimError.
    parameters
        Returns the parameters by name.
    change
        Takes new values by name; raises FluidSimError.
    changeable
        Names that ``change`` takes.

    """

    act: Callable[[str, bool], str]
    parameters: Callable[[], Mapping[str, Any]]
    change: Callable[[Mapping[str, Any]], None]
    changeable: tuple[str, ...] = ()


class LivePort(Protocol):
    """A sink for the runner that serves viewers."""

    period: int
    port: int

    def write(self, simulation: Simulation) -> None:
        """
        Send what is due and wanted at this step boundary.

        Parameters
        ----------
        simulation
            At the boundary.

        """

    def command(self, name: str, data: bytes) -> None:
        """
        Send a command message, before it is applied.

        Parameters
        ----------
        name
            Relative topic name.
        data
            CDR bytes.

        """

    def restart(self) -> None:
        """Note that simulated time was set back."""

    def close(self) -> None:
        """Close every connection."""


def open_foxglove(
    simulation: Simulation, settings: Mapping[str, Any], port: int, control: LiveControl
) -> LivePort:
    """
    Begin to serve viewers on this machine.

    Parameters
    ----------
    simulation
        Whose states are sent.
    settings
        Values of the topics' parameters that differ from the defaults, and ``namespace``.
    port
        To listen on; 0: any that is free.
    control
        What a viewer may do.

    Returns
    -------
    LivePort
        Serving; close it.

    Raises
    ------
    MissingExtraError
        If the extra ``foxglove`` is not installed.
    ConfigError
        If the port is in use.

    """
    with needed_for('foxglove'):
        part = import_module(_PART)
    live: LivePort = part.open_foxglove(simulation, settings, port, control)
    return live
