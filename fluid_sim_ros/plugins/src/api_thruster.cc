// C functions for Python (bound in plugins/native.py): what a thruster does.

#include <mujoco/mujoco.h>

#include "thruster.h"

#define FSR_API extern "C" __attribute__((visibility("default")))

using namespace fluid_sim;

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
