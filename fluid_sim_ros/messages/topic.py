# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""One outgoing topic: its template and which bytes go where."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple

from numpy.typing import NDArray

from fluid_sim_ros.messages.templates import Template
from fluid_sim_ros.step_clock import Beat


class Quality(NamedTuple):
    """
    Quality of service of a topic.

    Attributes
    ----------
    reliable
        Every message arrives; otherwise some may be lost (best effort).
    depth
        Number of messages that are kept for slow readers.
    transient_local
        Who subscribes later gets the last messages, too.

    """

    reliable: bool = True
    depth: int = 10
    transient_local: bool = False


#: States; the newest of something (the clock, commands); sensors; the newest, also for who comes
#: later.
STATE = Quality()
NEWEST = Quality(depth=1)
SENSOR = Quality(reliable=False, depth=5)
LATCHED = Quality(depth=1, transient_local=True)


class MadeNumber(NamedTuple):
    """
    A number that the compiled tick makes: ``scale`` times ``source``.

    Attributes
    ----------
    target, source
        Views of one number, of double precision. Without a source it is the speed of the rotor of
        a fluid_sim.thruster [rad/s].
    scale
        Factor.
    actuator
        Of the thruster.

    """

    target: NDArray[Any]
    source: NDArray[Any] | None
    scale: float = 1.0
    actuator: int = -1


@dataclass
class StateTopic:
    """
    One state topic.

    Attributes
    ----------
    name
        Relative name, or absolute with a leading slash.
    type
        Message type, ``package/msg/Name``.
    template
        The message.
    period
        Every step at which a message is due is a multiple of it.
    copies
        What is copied into the template for each message: pairs of target and source.
    needs_forces
        Its numbers need ``observe(forces=True)``.
    prepare
        Called before the copies.
    quality
        Quality of service that is offered.
    appears_later
        What it measures at one due step may stand in the message of another.
    uneven
        When messages are due, where they are no whole number of steps apart; otherwise None.
    new_name
        Where the topic is there for one release under the name that it had before: the name that
        it has now. Recorded only where it is asked for by name.
    once
        Its message never changes: it is published when the topic is made, for who subscribes
        later, too, and stands at the beginning of a log. Whoever sends it at its period instead
        does no harm.
    for_display
        Published at its rate of wall time at most, and also while the simulation stands.
    numbers
        What ``prepare`` makes, in the words of the compiled tick; empty: only ``prepare`` can.

    """

    name: str
    type: str
    template: Template
    period: int
    copies: list[tuple[memoryview, memoryview]]
    needs_forces: bool = False
    prepare: Callable[[], None] | None = None
    quality: Quality = STATE
    appears_later: bool = False
    new_name: str = ''
    uneven: Beat | None = None
    once: bool = False
    numbers: Sequence[MadeNumber] = ()

    for_display: ClassVar[bool] = False
    #: Whether there is a message at each due step.
    always: ClassVar[bool] = True

    @property
    def asks(self) -> bool:
        """Whether the compiled tick must call ``ready`` for a message."""
        made_here = self.prepare is not None and not self.numbers
        return made_here or self.uneven is not None or not self.always

    def ready(self) -> bool:
        """Return whether there is a message of the state observed last; its numbers are made."""
        if self.prepare is not None:
            self.prepare()
        return True

    def data(self) -> bytes:
        """Return the message of the state observed last, or nothing if there is none."""
        if not self.ready():
            return b''
        for target, source in self.copies:
            target[:] = source
        return self.template.bytes()
