// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Numbers and small functions of one number that every folder uses.

#ifndef FLUID_SIM_SHARED_NUMBERS_H_
#define FLUID_SIM_SHARED_NUMBERS_H_

#include <mujoco/mujoco.h>

#include <limits>

namespace fluid_sim {

constexpr mjtNum kPi = 3.14159265358979323846;
constexpr mjtNum kInfinity = std::numeric_limits<mjtNum>::infinity();
constexpr mjtNum kTiny = std::numeric_limits<mjtNum>::min();  // the smallest number above zero

constexpr mjtNum Square(mjtNum x) { return x * x; }
constexpr mjtNum Fourth(mjtNum x) { return Square(Square(x)); }

// Volume of an ellipsoid with semi-axes r [m^3].
constexpr mjtNum EllipsoidVolume(const mjtNum r[3]) { return 4.0 / 3.0 * kPi * r[0] * r[1] * r[2]; }

}  // namespace fluid_sim

#endif  // FLUID_SIM_SHARED_NUMBERS_H_
