// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The plugin instances of a model that take part in the assembly.

#ifndef FLUID_SIM_ASSEMBLY_INSTANCES_H_
#define FLUID_SIM_ASSEMBLY_INSTANCES_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// First of them, or -1; asked for every body that is observed.
int FirstInstance(const mjModel* m);

// The last of them: when it advances, the others have.
int LastInstance(const mjModel* m);

// Every fluid_sim.body instance is on a body: one that is not would be off without a word.
bool CheckInstancesUsed(const mjModel* m);

}  // namespace fluid_sim

#endif  // FLUID_SIM_ASSEMBLY_INSTANCES_H_
