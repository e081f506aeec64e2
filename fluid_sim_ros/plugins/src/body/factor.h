// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The factors of a free tree's inertia, as mj_factorM makes them.

#ifndef FLUID_SIM_BODY_FACTOR_H_
#define FLUID_SIM_BODY_FACTOR_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// Factor the block of d->M that belongs to the six dofs of a free tree, to the bits of mj_factorM,
// which factors all blocks and reads the clock. False, with nothing done, where the block is nearly
// singular: mj_factorM mends and says that.
bool FactorFreeTree(const mjModel* m, mjData* d, int first_dof);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_FACTOR_H_
