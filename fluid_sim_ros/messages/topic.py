"""One outgoing topic: its template and which bytes go where."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from fluid_sim_ros.messages.templates import Template


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
    period
        Steps between two messages.
    needs_forces
        Its numbers need ``observe(forces=True)``.
    reliable, depth, transient_local
        Quality of service that is offered.
    for_display
        Published at its rate of wall time at most, and also while the simulation stands.
    appears_later
        What it measures at one due step may stand in the message of another.

    """

    name: str
    type: str
    template: Template
    period: int
    copies: list[tuple[memoryview, memoryview]]
    needs_forces: bool = False
    prepare: Callable[[], None] | None = None

    reliable: ClassVar[bool] = True
    depth: ClassVar[int] = 10
    transient_local: ClassVar[bool] = False
    for_display: ClassVar[bool] = False
    appears_later: bool = False

    def data(self) -> bytes:
        """Return the message of the state observed last, or nothing if there is none."""
        if self.prepare is not None:
            self.prepare()
        for target, source in self.copies:
            target[:] = source
        return self.template.bytes()
