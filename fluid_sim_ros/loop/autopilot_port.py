# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""
Where the core, the node and the command line meet an autopilot.

The bridge itself is a part of its own (``mavlink``), which neither the core nor the node may
import: they know the protocol below, and the name under which the part is found when it is
wanted.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, ClassVar, Literal, Protocol

from fluid_sim_ros.errors import needed_for
from fluid_sim_ros.simulation import Simulation

#: The part that bridges; it has ``open_bridge`` with the arguments of the function below.
_PART = 'fluid_sim_ros.mavlink.bridge'

PROTOCOLS = ('px4', 'ardupilot')
#: What geodetic places are computed on: the ellipsoid of satellite navigation, or PX4's sphere.
EARTHS = ('wgs84', 'sphere')
#: What follows when an autopilot that has answered is silent for too long.
TIMEOUT_RULES = ('hold', 'continue', 'stop')
LOOPBACK = '127.0.0.1'


@dataclass(frozen=True)
class AutopilotOptions:
    """
    Which autopilot flies which vehicle.

    Attributes
    ----------
    protocol
        One of ``PROTOCOLS``.
    vehicle
        Vehicle name; empty: the only one of the scene.
    mapping
        File of config/autopilots by name or path; empty: ``<protocol>_<vehicle>``.
    instance
        Number of the autopilot on this host; shifts the port.
    port
        Port to listen on; 0: that of the protocol and the instance.
    address
        Address to listen on; anything but a loopback address lets other hosts in.
    program
        Its program is started with the run, and so gets the parameters of the mapping.
    timeout
        Wall time that an autopilot which has answered is waited for [s]; simulated time stands
        still meanwhile.
    on_timeout
        One of ``TIMEOUT_RULES``: go on waiting, go on at real time with thrust at rest, or end
        with AutopilotError.
    sticks_timeout
        Wall time without moved sticks after which the radio control is lost [s]; 0: never.
    earth
        One of ``EARTHS``: what PX4's places are computed on.
    parameters
        Of the autopilot, the user's own, value by name: in place of those of the mapping.

    """

    protocol: str
    vehicle: str = ''
    mapping: str = ''
    instance: int = 0
    port: int = 0
    address: str = LOOPBACK
    program: bool = False
    timeout: float = 60.0
    on_timeout: str = 'continue'
    sticks_timeout: float = 0.5
    earth: str = 'wgs84'
    parameters: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class BridgeStatus:
    """What a bridge says of itself: ``level`` as in diagnostics, one line, and numbers."""

    level: Literal['ok', 'warn', 'error']
    message: str
    values: Mapping[str, Any] = field(default_factory=dict)


class Exchange(Protocol):
    """What simulated time waits for at boundaries; every method runs in the stepping thread."""

    def begin(self, simulation: Simulation) -> None:
        """
        Go on from the simulation's present time, which a reset may have set back.

        Parameters
        ----------
        simulation
            What is flown.

        """

    def steps_left(self, simulation: Simulation) -> int:
        """
        Return the steps to the next exchange.

        Parameters
        ----------
        simulation
            What is flown.

        """

    def meet(self, simulation: Simulation) -> bool:
        """
        Exchange state and commands at a boundary.

        Parameters
        ----------
        simulation
            What is flown.

        Returns
        -------
        bool
            False: no answer yet, do not step.

        """


class Bridge(Exchange, Protocol):
    """
    An autopilot at the other end of a socket.

    Attributes
    ----------
    vehicle
        Name of the vehicle that it flies.
    leads
        It says how long the steps are, unless it has joined others.

    """

    vehicle: str
    leads: ClassVar[bool]

    def join(self) -> None:
        """Be one of several: whoever put them together sets the timestep."""

    def offer(self, simulation: Simulation) -> None:
        """
        Send the state that is due at this boundary, and do not wait for what it leads to.

        Parameters
        ----------
        simulation
            What is flown.

        """

    def next_ns(self, simulation: Simulation) -> int:
        """
        Return the simulated time of the next exchange [ns].

        Parameters
        ----------
        simulation
            What is flown, at a boundary where ``meet`` has returned True.

        """

    def set_sticks(self, axes: Sequence[float], buttons: Sequence[float]) -> None:
        """
        Take the sticks of a radio control.

        Parameters
        ----------
        axes, buttons
            -1 to 1 each, in the order of sensor_msgs/Joy.

        Raises
        ------
        CommandError
            If they do not fit.

        """

    def status(self) -> BridgeStatus:
        """Return what to show people."""

    def reasons(self) -> list[str]:
        """Return what may be wrong while it has not answered yet."""

    def close(self) -> None:
        """Close the socket."""


class CommandLog(Protocol):
    """Keeps what the autopilot commands, so that the run can be repeated without it."""

    def command(self, topic: str, data: bytes) -> None:
        """
        Keep a command message.

        Parameters
        ----------
        topic
            Its name relative to the namespace.
        data
            Its CDR bytes.

        """

    def event(self, **change: Any) -> None:
        """
        Keep a change that no message made.

        Parameters
        ----------
        **change
            What has changed, by name.

        """


@dataclass
class Surroundings:
    """
    What a bridge acts on besides the simulation.

    Attributes
    ----------
    report
        Takes (key, line): a fault; lines of one key are shown at most once per second.
    inform
        Takes a line about what is as it should be, such as a connection.
    reset
        Puts the vehicle back to where it started: another autopilot process has begun.
    log
        Gets every command before it takes effect, or None.

    """

    report: Callable[[str, str], None] = lambda key, line: None
    inform: Callable[[str], None] = lambda line: None
    reset: Callable[[], object] = lambda: None
    log: CommandLog | None = None


def open_bridge(
    simulation: Simulation, options: AutopilotOptions, surroundings: Surroundings
) -> Bridge:
    """
    Listen for an autopilot.

    Parameters
    ----------
    simulation
        What is flown.
    options
        By whom, and where to listen.
    surroundings
        What else the bridge acts on.

    Returns
    -------
    Bridge
        Listening; close it.

    Raises
    ------
    MissingExtraError
        If the extra ``mavlink`` is not installed.
    ConfigError
        If the mapping does not fit the vehicle, or the port is in use.

    """
    with needed_for('an autopilot'):
        bridge: Bridge = import_module(_PART).open_bridge(simulation, options, surroundings)
    return bridge
