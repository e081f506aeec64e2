// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Aerodynamic coefficients of wings and aircraft as pure functions of the local flow.
//
// Twins of fluid_sim_ros/physics/foil.py and aircraft.py. Foil axes: x towards the leading edge, y
// along the span to the left, z up; the angle of attack is positive when the flow comes from below.

#ifndef FLUID_SIM_FOIL_FOIL_MODEL_H_
#define FLUID_SIM_FOIL_FOIL_MODEL_H_

#include <mujoco/mujoco.h>

#include "shared/terms.h"

namespace fluid_sim {

// Where the linear range ends: share of the attached flow, by Beard and McLain (2012), eq. 4.10.
struct Stall {
  mjtNum angle = 0.26;    // [rad]
  mjtNum sharpness = 50;  // [1/rad]
};

// 1/((1 + e^(M(a - a0))) (1 + e^(-M(a + a0)))): 1 between the stall angles, 0 beyond.
mjtNum AttachedShare(const Stall& stall, mjtNum alpha);

struct Wing {
  mjtNum area = 0, span = 0, chord = 0;  // [m^2], [m], [m]
  mjtNum aspect_ratio = 0;
  mjtNum lift_0 = 0, lift_slope = 0;  // attached: lift_0 + lift_slope alpha
  mjtNum drag_0 = 0, pitch_0 = 0;
  mjtNum efficiency = 1;                     // of the span (Oswald)
  mjtNum reverse = 1;                        // attached lift in reverse flow over forward
  mjtNum plate_normal = 2, plate_power = 2;  // stalled: normal force Cn sin^p alpha
  mjtNum lift_delta = 0, drag_delta = 0, pitch_delta = 0;  // per rad of deflection
  bool moving_center = false;  // centre of pressure c/4 -> c/2 (-> 3c/4)
  mjtNum velocity_point = 0;   // of the local flow, chords behind the site
  int panels = 1;
  Stall stall;
};

struct WingCoefficients {
  mjtNum lift, drag, pitch;  // pitch: nose up
  mjtNum center;             // of pressure, chords behind the site
};

WingCoefficients EvaluateWing(const Wing& wing, mjtNum alpha, mjtNum deflection);

// Force [N] on a panel and pitching moment about the point of the force, from its velocity
// relative to the fluid in foil axes: a polynomial in the velocity's size, so zero at rest.
// `center` is the point of the force, chords behind the site.
Wrench PanelLoad(const Wing& wing, mjtNum area, mjtNum density, const mjtNum v[3],
                 mjtNum deflection, mjtNum* center);

// Coefficient set of a whole aircraft (Beard and McLain 2012, ch. 4): static, angle, rate(s),
// deflection(s).
struct Aircraft {
  mjtNum area = 0, span = 0, chord = 0;
  mjtNum efficiency = 0;                                // 0: no induced drag
  mjtNum lift[4] = {0}, drag[4] = {0}, pitch[4] = {0};  // 0, alpha, q, elevator
  mjtNum side[6] = {0}, roll[6] = {0}, yaw[6] = {0};    // 0, beta, p, r, aileron, rudder
  Stall stall;
};

// Force and torque about the reference point, axes x forward, y left, z up.
// `deflection`: aileron, elevator, rudder [rad].
Wrench AircraftLoad(const Aircraft& aircraft, mjtNum density, const mjtNum v[3], const mjtNum w[3],
                    const mjtNum deflection[3]);

}  // namespace fluid_sim

#endif  // FLUID_SIM_FOIL_FOIL_MODEL_H_
