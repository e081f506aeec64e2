// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// History force on a small sphere: the wake that follows a change of its velocity late.
//
// F = -6 pi mu r int K(t - s) dv/ds ds, v relative to the fluid. Basset's kernel is (s/T)^-1/2 with
// T = r^2/(pi nu) and holds for Re << 1; at finite Re it dies out sooner (Mei and Adrian 1992):
//
//   K = [ x^(1/2c) + (b x)^(2/c) ]^-c, x = s/T, b^2 = (Re/2)^3 / (2 pi f^3), f = .75 + c2 Re
//
// Basset's kernel is a sum of exponentials (van Hinsberg, ten Thije Boonkkamp and Clercx 2011, J.
// Comput. Phys. 230:1465), here with rates on a geometric grid. So is the other: K is
// X^-1/2 G(x/X) with X = b^(-4/3), and each exponential is weakened by what the inverse Laplace
// transform of G is to that of x^-1/2. Each needs its own integral of dv/dt only, in plugin_state.
// Twin of fluid_sim_ros/physics/history.py.

#ifndef FLUID_SIM_BODY_HISTORY_H_
#define FLUID_SIM_BODY_HISTORY_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "medium/medium.h"

namespace fluid_sim {

struct BodyFluid;
struct BodyForces;
struct Motion;

enum class HistoryKernel { kNone, kBasset, kMeiAdrian, kDorganLoth };

constexpr int kHistoryModes = 20;

// plugin_state: the fluid (0: none yet, 1 lower, 2 upper), velocity relative to it and time at the
// end of the last step, then the integrals of the modes, three numbers each.
enum HistoryState { kFluid = 0, kVelocity = 1, kTime = 4, kIntegrals = 5 };
constexpr int kHistoryState = kIntegrals + 3 * kHistoryModes;

struct History {
  HistoryKernel kernel = HistoryKernel::kNone;
  int instance = -1;
  mjtNum radius = 0;                 // [m]
  mjtNum center[3] = {0, 0, 0};      // of the sphere, body axes [m]
  mjtNum rate[kHistoryModes] = {0};  // of the exponentials [1/s]
  mjtNum c2 = 0;                     // of f
  std::vector<mjtNum> share;         // what G leaves of Basset, over log2 of rate times X

  bool on() const { return kernel != HistoryKernel::kNone; }
};

// Numbers in plugin_state for an instance, from its keys alone.
int HistoryStateSize(const mjModel* m, int instance);

// The table of `share` for Mei and Adrian's exponent c.
std::vector<mjtNum> HistoryShares(mjtNum c);

// Add the force of one fluid; nu is the velocity of O relative to it, in body axes. With `secant`
// it is that at the end of the step, and what goes with the acceleration is in out->secant.
void AddHistory(const mjModel* m, const mjData* d, const BodyFluid& body, const Flow& flow,
                const Motion& motion, const mjtNum nu[6], bool secant, BodyForces* out);

// Carry the integrals over the step that has just ended.
void AdvanceHistory(const mjModel* m, mjData* d, const Medium& medium, const BodyFluid& body);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_HISTORY_H_
