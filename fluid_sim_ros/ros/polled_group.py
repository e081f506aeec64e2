"""Subscriptions that a loop takes from itself, out of the executor's reach."""

from typing import Any

from rclpy.callback_groups import CallbackGroup


class PolledGroup(CallbackGroup):
    """Keeps the executor away from subscriptions that the main thread's loop takes from itself."""

    def can_execute(self, entity: Any) -> bool:
        """Return False: the executor never takes these."""
        return False

    def beginning_execution(self, entity: Any) -> bool:
        """Return False, as ``can_execute``."""
        return False

    def ending_execution(self, entity: Any) -> None:
        """Do nothing: no execution ever began."""
