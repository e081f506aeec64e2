// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// What a thruster does.

#include "thruster/thruster.h"

#include <mujoco/mujoco.h>

#include "api/api.h"

using namespace fluid_sim;

namespace {

// What fsr_thruster writes, in order: speed and commanded speed [rad/s], thrust [N], shaft torque
// of the fluid [N m], inflow along the thrust axis [m/s], and 1 where the command saturates.
constexpr const char* kThrusterValues[] = {"rad_s",  "rad_s_commanded", "thrust",
                                           "torque", "inflow",          "saturated"};
constexpr int kThrusterValueCount = sizeof(kThrusterValues) / sizeof(kThrusterValues[0]);

}  // namespace

// Name of value i of fsr_thruster, or null beyond the last.
FSR_API const char* fsr_thruster_value(int i) {
  return i >= 0 && i < kThrusterValueCount ? kThrusterValues[i] : nullptr;
}

// Fill out[6] for the thrust actuator of a fluid_sim.thruster: speed [rad/s], commanded speed
// [rad/s], thrust [N], shaft torque of the fluid [N m], inflow [m/s], 1 if the command saturates.
// Returns 1; 2 (nothing written) for the actuator of its reaction torque; 0 for any other one.
// Inflow and thrust belong to the positions and velocities that d was last evaluated at.
FSR_API int fsr_thruster(const mjModel* m, const mjData* d, int actuator, double* out) {
  if (actuator < 0 || actuator >= m->nactuator) return 0;
  const Thruster* thruster = FindThruster(m, d, actuator);
  if (!thruster) return 0;
  if (thruster->thrust != actuator) return 2;
  const RotorLoad load = EvaluateThruster(m, d, *thruster);
  out[0] = load.omega;
  out[1] = load.target;
  out[2] = load.thrust;
  out[3] = load.torque;
  out[4] = load.inflow;
  out[5] = load.saturated;
  return 1;
}
