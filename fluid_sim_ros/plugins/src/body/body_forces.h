// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// What the fluid does to one body at the present state.

#ifndef FLUID_SIM_BODY_BODY_FORCES_H_
#define FLUID_SIM_BODY_BODY_FORCES_H_

#include <mujoco/mujoco.h>

#include <cmath>

#include "body/body.h"
#include "medium/medium.h"
#include "shared/terms.h"

namespace fluid_sim {

// Motion of a body's reference point O, (linear, angular) in body axes.
struct Motion {
  const mjtNum* rotation;  // body to world
  mjtNum point_w[3];       // O, world [m]
  mjtNum velocity[6];      // of the body at O, not relative to the fluid [m/s], [rad/s]
  mjtNum bias[6];          // acceleration that qacc = 0 leaves, R'Jdot q' [m/s^2], [rad/s^2]
};

// How fast a body goes through the surface: the forces are those of the instants that the steps
// take, so a body that crosses in few steps gets them wrong.
struct Crossing {
  mjtNum speed = 0;   // of the surface relative to the body, along the surface's normal [m/s]
  mjtNum extent = 0;  // of the body along that normal [m]; 0: no surface
  mjtNum gap = 0;     // between body and surface [m]; <= 0: they touch

  // Share of the body's extent that passes the surface in a step, or 0 where it will not.
  mjtNum Share(mjtNum timestep) const {
    const mjtNum way = std::abs(speed) * timestep;
    return extent > 0 && gap < way ? way / extent : 0;
  }
};

// About O in body axes, force then torque.
struct BodyForces {
  mjtNum term[kTermCount][6] = {};  // explicit wrench per term
  mjtNum inertia[36] = {};          // added mass now: wetted share and densities included
  mjtNum secant[36] = {};           // D_s of the damping forces: f = -D_s nu at this state
  mjtNum fluid_energy = 0;          // kinetic energy of the displaced flow, nu'A nu/2 [J]
  Crossing crossing;
  mjtNum reynolds = 0;      // largest of the ellipsoids whose drag goes by it [-]
  mjtNum surface_loss = 0;  // what entry (slamming) and exit take of it and the body [W]
};

// From qvel alone for a free tree, else from MuJoCo's position and velocity stages.
Motion BodyMotion(const mjModel* m, const mjData* d, const BodyFluid& body);

// All terms; `secant` false leaves D_s at zero.
void EvaluateBody(const mjModel* m, const mjData* d, const Medium& medium, const BodyFluid& body,
                  const Motion& motion, bool secant, BodyForces* out);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_BODY_FORCES_H_
