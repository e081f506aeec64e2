// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Counter-based normal random numbers: a pure function of (seed, stream, index).
//
// Philox4x64-10 (Salmon et al. 2011, Parallel random numbers: as easy as 1, 2, 3), which numpy has
// too, and the Box-Muller transform. No state: copies, rollouts and threads agree.

#ifndef FLUID_SIM_MEDIUM_NOISE_H_
#define FLUID_SIM_MEDIUM_NOISE_H_

#include <mujoco/mujoco.h>

#include <cstdint>

namespace fluid_sim {

// Standard normal numbers of one tick: `count` of them, in blocks of four. Ticks with the same
// count never share a number.
void Gaussians(std::uint64_t seed, std::uint64_t stream, std::uint64_t tick, int count,
               mjtNum* out);

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_NOISE_H_
