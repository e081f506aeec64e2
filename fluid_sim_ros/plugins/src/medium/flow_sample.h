// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The undisturbed flow of one fluid at a world point and time: every kind of weather adds to it.
//
// A contributor (stream, turbulence, ...) adds u, du/dt at the fixed point and the gradient of u;
// the material derivative is not linear in u, so it is taken once, of the sum.

#ifndef FLUID_SIM_MEDIUM_FLOW_SAMPLE_H_
#define FLUID_SIM_MEDIUM_FLOW_SAMPLE_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

struct FlowSample {
  mjtNum velocity[3] = {0, 0, 0};                    // u, world [m/s]
  mjtNum rate[3] = {0, 0, 0};                        // du/dt at the fixed point, world [m/s^2]
  mjtNum gradient[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};  // row i: du_i / d(x, y, z) [1/s]
  mjtNum spin[3] = {0, 0, 0};                        // rotational gust, world [rad/s]
};

// Du/Dt = du/dt + (u.grad)u [m/s^2].
inline void MaterialDerivative(const FlowSample& flow, mjtNum out[3]) {
  const mjtNum *g = flow.gradient, *u = flow.velocity;
  for (int i = 0; i < 3; ++i) {
    out[i] = flow.rate[i] + g[3 * i] * u[0] + g[3 * i + 1] * u[1] + g[3 * i + 2] * u[2];
  }
}

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_FLOW_SAMPLE_H_
