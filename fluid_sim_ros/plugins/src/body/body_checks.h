// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// What fluid_sim.body refuses when a model is loaded, each with one line.

#ifndef FLUID_SIM_BODY_BODY_CHECKS_H_
#define FLUID_SIM_BODY_BODY_CHECKS_H_

#include <mujoco/mujoco.h>

#include "body/body.h"
#include "shared/config.h"

namespace fluid_sim {

// Some joint moves the body.
bool CanMove(const mjModel* m, int body);

// Of a body on the chain that moves `body`, MuJoCo stores only the diagonal of the inertia.
bool MovesSimply(const mjModel* m, int body);

// First dof of a body that is a whole kinematic tree with one free joint, or -1.
int FreeTreeDof(const mjModel* m, int body);

// The matrix's symmetric part is positive semi-definite (and the matrix symmetric, if asked for).
bool CheckSemidefinite(const Config& config, const char* key, const mjtNum matrix[36],
                       bool symmetric);

// No negative entry on the diagonal. Off it published sets have both signs, and whether such a set
// dissipates at all velocities is for its author to know.
bool CheckDiagonal(const Config& config, const char* key, const mjtNum matrix[36]);

// Double counting, lost inertia, missing density, nothing switched on.
bool CheckBody(const mjModel* m, const Config& config, const Medium& medium, const BodyFluid& body);

// Options that disable passive forces (refused), or make them less exact (warned about).
bool CheckOptions(const mjModel* m, int instance, const std::vector<BodyFluid>& bodies);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_BODY_CHECKS_H_
