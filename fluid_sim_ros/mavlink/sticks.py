# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The sticks of a radio control on their way to an autopilot, as pulse widths."""

import math
import time
from collections.abc import Sequence

from fluid_sim_ros.errors import CommandError

#: Of a radio control's channels: in the middle, and from there to either end [us].
_MIDDLE, _REACH = 1500, 500
#: Channels of a RC_CHANNELS message.
CHANNELS = 18


class Sticks:
    """
    Radio control channels: the mapping's, until somebody moves sticks.

    Axes come first, one channel each, then buttons. Sticks that are not heard of for ``timeout``
    are a lost radio: no channel is sent, so that the autopilot does what it does in that case.

    Parameters
    ----------
    resting
        Pulses [us] of the channels as long as nobody has moved anything; empty: no radio.
    timeout
        Wall time after which sticks are lost [s]; 0: never.
    channels
        How many the autopilot takes.

    Attributes
    ----------
    lost
        How often they were.

    """

    def __init__(self, resting: Sequence[int], timeout: float, channels: int = CHANNELS) -> None:
        self._channels = channels
        self._pulses = tuple(resting)
        self._timeout = timeout
        self._moved_at = math.inf  # nobody has
        self.lost = 0

    def move(self, axes: Sequence[float], buttons: Sequence[float]) -> None:
        """
        Set the channels: axes from -1 to 1, saturated; buttons 0 (off) or another number (on).

        Parameters
        ----------
        axes
            Deflections, -1 to 1.
        buttons
            0 or another number.

        Raises
        ------
        CommandError
            If they are too many, none, or not finite; then the channels stay as they are.

        """
        count = len(axes) + len(buttons)
        if not 1 <= count <= self._channels:
            raise CommandError(
                f'{count} axes and buttons; a radio control has 1 to {self._channels}'
            )
        if not all(map(math.isfinite, axes)):
            raise CommandError(f'{list(axes)} holds a value that is not finite')
        self._pulses = (
            *(_MIDDLE + round(_REACH * min(max(axis, -1.0), 1.0)) for axis in axes),
            *(_MIDDLE + (_REACH if button else -_REACH) for button in buttons),
        )
        self._moved_at = time.monotonic()

    def pulses(self) -> tuple[int, ...]:
        """Return the channels [us]; empty while there is no radio."""
        if self._timeout and time.monotonic() - self._moved_at > self._timeout:
            self._pulses, self._moved_at = (), math.inf
            self.lost += 1
        return self._pulses
