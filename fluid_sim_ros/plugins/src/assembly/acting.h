// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Which terms of the fluid wrench can act on a body at all.

#ifndef FLUID_SIM_ASSEMBLY_ACTING_H_
#define FLUID_SIM_ASSEMBLY_ACTING_H_

#include <mujoco/mujoco.h>

#include "shared/terms.h"

namespace fluid_sim {

// acts[i] tells whether term i of kTerms can be other than zero on `body` in some motion: of the
// plugins, and of MuJoCo's own fluid forces. A coefficient that is 0, and a fluid without density
// or viscosity, rule a term out; so does a body without mass for MuJoCo's own forces.
void ActingTerms(const mjModel* m, const mjData* d, int body, bool acts[kTermCount]);

}  // namespace fluid_sim

#endif  // FLUID_SIM_ASSEMBLY_ACTING_H_
