// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Writes added inertia into MuJoCo's sparse inertia matrix, and generalized forces.

#ifndef FLUID_SIM_BODY_INERTIA_H_
#define FLUID_SIM_BODY_INERTIA_H_

#include <mujoco/mujoco.h>

#include "body/body.h"
#include "body/body_forces.h"

namespace fluid_sim {

// Generalized force J'(force, torque) of a wrench about O in body axes, added to qfrc_fluid and
// qfrc_passive (which stays the sum of its parts).
void ApplyWrench(const mjModel* m, mjData* d, const BodyFluid& body, const Motion& motion,
                 const mjtNum wrench[6]);

// d->M := rigid inertia + J'GJ on the block of a free tree: analytic, so nothing must be undone.
void WriteFreeInertia(const mjModel* m, mjData* d, const BodyFluid& body, const Motion& motion,
                      const mjtNum g[36]);

// d->M += J'GJ on the body's dof chain; d->M must hold the rigid inertia (mj_makeM).
void AddChainInertia(const mjModel* m, mjData* d, const BodyFluid& body, const Motion& motion,
                     const mjtNum g[36]);

// Acceleration of O in body axes that d->qacc brings, J qacc.
void PointAcceleration(const mjModel* m, const mjData* d, const BodyFluid& body,
                       const Motion& motion, mjtNum out[6]);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_INERTIA_H_
