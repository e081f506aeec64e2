// What the fluid does to one body at the present state.

#ifndef FLUID_SIM_BODY_BODY_FORCES_H_
#define FLUID_SIM_BODY_BODY_FORCES_H_

#include <mujoco/mujoco.h>

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

// About O in body axes, force then torque.
struct BodyForces {
  mjtNum term[kTermCount][6] = {};  // explicit wrench per term
  mjtNum inertia[36] = {};          // added mass now: wetted share and densities included
  mjtNum secant[36] = {};           // D_s of the damping forces: f = -D_s nu at this state
  mjtNum fluid_energy = 0;          // kinetic energy of the displaced flow, nu'A nu/2 [J]
  mjtNum surface_loss = 0;          // what entry (slamming) and exit take of it and the body [W]
};

// From qvel alone for a free tree, else from MuJoCo's position and velocity stages.
Motion BodyMotion(const mjModel* m, const mjData* d, const BodyFluid& body);

// All terms; `secant` false leaves D_s at zero.
void EvaluateBody(const mjModel* m, const mjData* d, const Medium& medium, const BodyFluid& body,
                  const Motion& motion, bool secant, BodyForces* out);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_BODY_FORCES_H_
