# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""The integral term of a control law: bounded, and the same for a state that comes twice."""


class Integral:
    """
    Integrates errors on some axes: d(value)/dt = rate * error, within +-bound.

    An error is kept when it is seen and integrated at the next state, over the time between the
    two; so the answer to a repeated state is the same answer, and whether a limit bound is known
    before its error counts (anti-windup).

    Parameters
    ----------
    rate
        Gain of the integral.
    bound
        Largest magnitude on each axis.
    axes
        How many.

    Attributes
    ----------
    value
        The integral, one number per axis.

    """

    def __init__(self, rate: float, bound: float, axes: int = 3) -> None:
        self._rate = rate
        self._bound = bound
        self.value = [0.0] * axes
        self._pending: tuple[float, ...] = (0.0,) * axes

    def restart(self) -> None:
        """Begin at zero."""
        self.value = [0.0] * len(self.value)
        self._pending = (0.0,) * len(self.value)

    def advance(self, dt: float) -> None:
        """
        Integrate the error that was kept over the time since its state.

        Parameters
        ----------
        dt
            That time [s].

        """
        gain, bound = self._rate * dt, self._bound
        # on the way of every answer: comparisons take half the time of min and max, and three
        # axes written out two thirds of that of a loop
        if len(self.value) == 3:
            (x, y, z), (ex, ey, ez) = self.value, self._pending
            x, y, z = x + gain * ex, y + gain * ey, z + gain * ez
            self.value = [
                -bound if x < -bound else (bound if x > bound else x),
                -bound if y < -bound else (bound if y > bound else y),
                -bound if z < -bound else (bound if z > bound else z),
            ]
            return
        self.value = [
            -bound if (v := value + gain * error) < -bound else (bound if v > bound else v)
            for value, error in zip(self.value, self._pending, strict=True)
        ]

    def keep(self, *error: float, limited: bool = False) -> None:
        """
        Keep the errors of this state, or nothing where a limit binds at it.

        Parameters
        ----------
        *error
            One per axis, in the unit of the value over rate and second.
        limited
            Whether a limit binds.

        """
        self._pending = (0.0,) * len(error) if limited else error
