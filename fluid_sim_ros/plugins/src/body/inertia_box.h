// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// MuJoCo's inertia-box model: the body drags like the box that has its mass and inertia.
//
// Pure functions of the local velocity, twins of fluid_sim_ros/physics/inertia_box.py. Everything
// is in the axes of the body's inertia: velocity relative to the fluid in, force and torque about
// the centre of mass out.

#ifndef FLUID_SIM_BODY_INERTIA_BOX_H_
#define FLUID_SIM_BODY_INERTIA_BOX_H_

#include <mujoco/mujoco.h>

#include "shared/terms.h"

namespace fluid_sim {

// Full edge lengths of the equivalent box of body `body` [m].
void EquivalentInertiaBox(const mjModel* m, int body, mjtNum edges[3]);

// Resistance of the box to v and w along each axis [N s/m], [N m s]: force_i = -linear_i v_i. First
// of the quadratic drag of its faces, then of the viscous term (Stokes drag of the sphere whose
// diameter is the mean edge), alike along all axes.
struct BoxResistance {
  mjtNum linear[3], angular[3];
  mjtNum viscous_linear, viscous_angular;

  Wrench Drag(const mjtNum w[3], const mjtNum v[3]) const;
  Wrench Viscous(const mjtNum w[3], const mjtNum v[3]) const;
};

BoxResistance InertiaBoxResistance(const mjtNum edges[3], const FluidConstants& fluid,
                                   const mjtNum w[3], const mjtNum v[3]);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_INERTIA_BOX_H_
