# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""What integration does to the energy of the motion, and when that is worth a warning."""

from dataclasses import dataclass

#: Energy that comes or goes by itself is worth a warning beyond this share per second [1/s].
_NOTABLE_FEED = 1e-2


@dataclass(frozen=True)
class EnergyBalance:
    """
    What integration does to the energy of the motion, measured over one step in still fluid.

    Attributes
    ----------
    kinetic
        Of bodies and flow [J].
    feed
        Power that the integrator adds by itself [W]: change of the kinetic energy over a step,
        less the work of the forces. First-order integrators feed a motion with gyroscopic or
        convective added-mass forces, or (the implicit ones) starve it.
    dissipation
        Power that drag and damping take out [W].

    """

    kinetic: float
    feed: float
    dissipation: float

    @property
    def warning(self) -> str:
        """One line when the integrator outweighs drag, else empty."""
        quiet = abs(self.feed) <= max(self.dissipation, _NOTABLE_FEED * self.kinetic)
        if quiet or self.kinetic <= 0:
            return ''
        verb, share = ('adds', self.feed) if self.feed > 0 else ('takes', -self.feed)
        return (
            f'the integrator {verb} {share / self.kinetic:.1%} of the kinetic energy per second '
            'by itself, more than drag takes out; use RK4 or a smaller timestep'
        )
