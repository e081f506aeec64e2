# SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
# SPDX-License-Identifier: Apache-2.0
"""Fins of a new torpedo: a rudder and planes behind, each a pair of plates on a servo."""

from dataclasses import dataclass

import numpy as np

from fluid_sim_ros.physics.arrays import Array

#: Joints of the fins, in the order of commands; as the controllers of a torpedo name them.
JOINTS = ('rudder', 'planes')
#: Guesses, of the REMUS 100 (Prestero 2001, appendix; hull 1.33 m long, 0.191 m across): span and
#: chord of a fin, and its centre from the axis, of the diameter; posts behind the middle, of the
#: length; largest deflection [rad].
_SPAN, _CHORD, _CENTER, _BEHIND, _LARGEST = 0.449, 0.406, 0.565, 0.48, 0.2374
#: Mass of a pair of fins over that of the vehicle: MuJoCo wants each body to have some.
_SHARE = 1e-4
_INSTANCE = """    <!-- guess: size and place of the fins, of those of the REMUS 100: [m] -->
    <plugin plugin="fluid_sim.foil">
      <instance name="fins">
        <config key="site" value="rudder_top rudder_bottom plane_left plane_right"/>
        <config key="span" value="{span:.6g}"/>
        <config key="chord" value="{chord:.6g}"/>
      </instance>
    </plugin>
"""
_BODIES = """
      <!-- a positive deflection turns to the left, or the nose down -->
      <body name="rudder" pos="{x:.12g} 0 0">
        <inertial mass="{mass:.12g}" pos="0 0 0" diaginertia="{inertia:.3g} {inertia:.3g} {inertia:.3g}"/>
        <joint name="rudder" axis="0 0 -1" range="{low} {high}" armature="{armature:.3g}"/>
        <geom type="box" size="{half_chord:.4g} {thin:.4g} {half_span:.4g}" pos="0 0 {out:.6g}" mass="0"/>
        <geom type="box" size="{half_chord:.4g} {thin:.4g} {half_span:.4g}" pos="0 0 -{out:.6g}" mass="0"/>
        <site name="rudder_top" pos="0 0 {out:.6g}" xyaxes="1 0 0 0 0 1"/>
        <site name="rudder_bottom" pos="0 0 -{out:.6g}" xyaxes="1 0 0 0 0 1"/>
      </body>
      <body name="planes" pos="{x:.12g} 0 0">
        <inertial mass="{mass:.12g}" pos="0 0 0" diaginertia="{inertia:.3g} {inertia:.3g} {inertia:.3g}"/>
        <joint name="planes" axis="0 -1 0" range="{low} {high}" armature="{armature:.3g}"/>
        <geom type="box" size="{half_chord:.4g} {half_span:.4g} {thin:.4g}" pos="0 {out:.6g} 0" mass="0"/>
        <geom type="box" size="{half_chord:.4g} {half_span:.4g} {thin:.4g}" pos="0 -{out:.6g} 0" mass="0"/>
        <site name="plane_left" pos="0 {out:.6g} 0"/>
        <site name="plane_right" pos="0 -{out:.6g} 0"/>
      </body>
"""  # noqa: E501
_SERVO = (
    '    <position name="{joint}" joint="{joint}" kp="{gain:.3g}" dampratio="1" timeconst="0.1"'
    ' inheritrange="1"/>'
)


@dataclass(frozen=True)
class Fins:
    """
    Four fins at the tail of a hull: ``size`` is its length, width and height [m].

    ``mass`` [kg] is that of the hull, of which each pair of fins weighs a share too small to
    matter.
    """

    size: Array
    mass: float

    @property
    def _diameter(self) -> float:
        return float(np.sqrt(self.size[1] * self.size[2]))

    @property
    def weigh(self) -> float:
        """Mass of the fins, which is a part of the vehicle's [kg]."""
        return len(JOINTS) * _SHARE * self.mass

    @property
    def balance(self) -> float:
        """Place of the hull's centre of mass ahead, so that the whole is balanced [m]."""
        return _BEHIND * float(self.size[0]) * self.weigh / (self.mass - self.weigh)

    def instance(self) -> str:
        """Return the plugin instance of the fins, as lines of MJCF."""
        return _INSTANCE.format(span=_SPAN * self._diameter, chord=_CHORD * self._diameter)

    def bodies(self) -> str:
        """Return the bodies of the fins, as lines of MJCF."""
        diameter = self._diameter
        mass = _SHARE * self.mass
        return _BODIES.format(
            x=-_BEHIND * self.size[0], out=_CENTER * diameter, mass=mass,
            inertia=mass * (0.5 * diameter) ** 2, armature=self._armature(),
            low=-_LARGEST, high=_LARGEST, half_chord=0.5 * _CHORD * diameter,
            half_span=0.5 * _SPAN * diameter, thin=0.02 * diameter,
        )  # fmt: skip

    def servos(self) -> list[str]:
        """Return the actuators of the fins, as lines of MJCF."""
        # a stiff gear: settles at 100 rad/s, well within the lag of 0.1 s (Fossen, as the REMUS)
        return [_SERVO.format(joint=joint, gain=1e4 * self._armature()) for joint in JOINTS]

    def _armature(self) -> float:
        """Return the inertia of a servo [kg m^2]: 1/350 of the hull's about its middle."""
        return float(self.mass * self.size[0] ** 2 / 12 / 350)
