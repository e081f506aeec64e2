// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Thrust and shaft torque of a rotor as pure functions of its speed and inflow.
//
// Twin of fluid_sim_ros/physics/propulsion.py. The thrust axis is the direction of the force for
// a positive speed; a positive inflow moves the rotor forward along it relative to the fluid.

#ifndef FLUID_SIM_THRUSTER_THRUSTER_CURVE_H_
#define FLUID_SIM_THRUSTER_THRUSTER_CURVE_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "thruster/t200.h"

namespace fluid_sim {

enum class Curve { kQuadratic, kPolynomial, kTable, kCoefficients };

struct RotorCurve {
  Curve kind = Curve::kQuadratic;
  mjtNum k[2] = {0, 0};               // thrust = k omega|omega|, forward and reverse
  std::vector<mjtNum> polynomial[2];  // thrust by powers 1, 2, ... of |omega|
  mjtNum torque_ratio = 0;            // shaft torque per thrust at rest [m]
  mjtNum diameter = 0;                // [m]
  mjtNum density = 0;                 // that the curve holds for [kg/m^3]
  mjtNum thrust_j[3] = {0, 0, 0};     // CT = c0 + c1 J + c2 J^2
  mjtNum torque_j[3] = {0, 0, 0};     // CQ
  mjtNum reverse[2] = {1, 1};         // c0 of thrust and torque in reverse, times this
};

// At rest in the fluid of the curve's density [N]; odd in shape, not in size.
mjtNum StaticThrust(const RotorCurve& curve, mjtNum omega);

// The speed that gives a thrust at rest [rad/s], within 0..limit in size.
mjtNum SpeedForThrust(const RotorCurve& curve, mjtNum thrust, mjtNum limit);

// What an inflow [m/s] adds to the thrust [N] and the shaft torque [N m] (coefficients only):
// rho D^4 (c1 |n| V/D + c2 V|V|/D^2), n = omega / 2 pi; finite at n = 0 and odd in (n, V).
mjtNum InflowThrust(const RotorCurve& curve, mjtNum omega, mjtNum inflow);
mjtNum InflowTorque(const RotorCurve& curve, mjtNum omega, mjtNum inflow);

// Shaft torque at rest [N m], of the sign of omega.
mjtNum StaticTorque(const RotorCurve& curve, mjtNum omega, mjtNum static_thrust);

// Linear interpolation, constant beyond the ends.
mjtNum Interpolate(const std::vector<Knot>& table, mjtNum command);

// First-order lag over `elapsed` [s] from `start`, exact: omega = u + (start - u) exp(-t/tau).
// tau is `up` while the speed grows in size and `down` while it shrinks; a reversal goes down to
// zero and up from there.
struct Lag {
  mjtNum up = 0, down = 0;  // time constants [s]
};
struct LaggedSpeed {
  mjtNum omega;  // [rad/s]
  mjtNum rate;   // [rad/s^2]
};
LaggedSpeed Follow(const Lag& lag, mjtNum start, mjtNum target, mjtNum elapsed);

// Share of a disc (radius, unit axis) below a level surface that is `depth` above its centre.
mjtNum DiscShare(mjtNum depth, mjtNum radius, mjtNum axis_z);

}  // namespace fluid_sim

#endif  // FLUID_SIM_THRUSTER_THRUSTER_CURVE_H_
