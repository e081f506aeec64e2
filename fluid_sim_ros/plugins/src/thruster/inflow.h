// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// What an axial inflow takes of the thrust of a rotor that is known at rest only.
//
// Twin of inflow_thrust in fluid_sim_ros/physics/inflow.py. J0 is the advance ratio V/(n D) at
// which the thrust vanishes.

#ifndef FLUID_SIM_THRUSTER_INFLOW_H_
#define FLUID_SIM_THRUSTER_INFLOW_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// kLinear: T = T0 (1 - J/J0), T0 at rest: Blanke (1981), Fossen (2021), ch. 9: T_nn n|n| - T_nv |n|
// V. kMomentum: blades at a pitch of J0 D in the induced flow of momentum theory (Leishman 2006,
// ch. 2 and 3): T/T0 = (V_p - V - w)/(V_p - v_h), 2 rho A (V + w) w = T, with V_p = J0 n D.
enum class InflowLaw { kNone, kLinear, kMomentum };

struct InflowLoss {
  InflowLaw law = InflowLaw::kNone;
  mjtNum measured[2] = {0, 0};  // of J0: where the thrust "at rest" was measured [-] (linear)
  mjtNum way[2] = {0, 0};       // J0 D/(2 pi), forward and in reverse [m]: V_p per speed
  mjtNum hover[2] = {0, 0};     // v_h/V_p of momentum theory [-], below 1
};

// Change of a rotor's load by the inflow.
struct LoadChange {
  mjtNum thrust = 0;  // [N]
  mjtNum torque = 0;  // of the shaft by the change of T (V + w) [N m]; momentum theory only
};

// `thrust` is that at rest, of the sign of omega; nothing for a rotor that stands. `inflow` is the
// velocity along the thrust axis relative to the fluid [m/s].
LoadChange InflowChange(const InflowLoss& loss, mjtNum omega, mjtNum thrust, mjtNum inflow);

}  // namespace fluid_sim

#endif  // FLUID_SIM_THRUSTER_INFLOW_H_
