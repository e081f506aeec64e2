// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Thrust of the Blue Robotics T200 at rest against pulse width, for any supply of 10 to 20 V.

#ifndef FLUID_SIM_THRUSTER_T200_H_
#define FLUID_SIM_THRUSTER_T200_H_

#include <mujoco/mujoco.h>

#include <vector>

namespace fluid_sim {

constexpr mjtNum kT200LowVoltage = 10, kT200HighVoltage = 20;  // [V]

// T = k omega^2 forward and reverse [N/(rad/s)^2]
extern const mjtNum kT200Speed[2];

// One point of a curve: pulse width [us] and thrust [N].
struct Knot {
  mjtNum command, thrust;
};

// The curve at a supply voltage, commands rising.
std::vector<Knot> T200Table(mjtNum voltage);

}  // namespace fluid_sim

#endif  // FLUID_SIM_THRUSTER_T200_H_
