// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Parts of the reader of fluid_sim.body.

#ifndef FLUID_SIM_BODY_BODY_READ_H_
#define FLUID_SIM_BODY_BODY_READ_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "body/body.h"
#include "shared/config.h"

namespace fluid_sim {

// Geoms of a body with fluidshape="ellipsoid".
std::vector<int> FluidGeoms(const mjModel* m, int body);

// Who brakes the body, and how; the damping must have been read.
bool ReadDrag(const mjModel* m, const Config& config, const Medium& medium, bool has_foil,
              BodyFluid* out);

// Whether it remembers its accelerations; drag and free_dof must have been read.
bool ReadHistory(const mjModel* m, const Config& config, const Medium& medium, int instance,
                 BodyFluid* out);

// Displaced volume, its centre, and the solids that a surface may cut.
bool ReadBuoyancy(const mjModel* m, const Config& config, BodyFluid* out);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_BODY_READ_H_
