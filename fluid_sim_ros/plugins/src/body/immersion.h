// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// How a body lies in the two fluids: the part of it below the surface, level or wavy.

#ifndef FLUID_SIM_BODY_IMMERSION_H_
#define FLUID_SIM_BODY_IMMERSION_H_

#include <mujoco/mujoco.h>

#include "body/body.h"
#include "body/body_forces.h"
#include "medium/medium.h"

namespace fluid_sim {

// Points in body axes from the body's origin.
struct Immersion {
  mjtNum wet = 1;                // share of the volume below the surface [-]
  mjtNum rate = 0;               // its time derivative [1/s]
  mjtNum moment[3] = {0, 0, 0};  // of the wet part of the solids [m^4]
  Crossing crossing;
};

// Waves cut the body along their tangent plane over the middle of its solids, so they are to be
// long against the body.
Immersion Immerse(const mjData* d, const Medium& medium, const BodyFluid& body,
                  const Motion& motion);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_IMMERSION_H_
