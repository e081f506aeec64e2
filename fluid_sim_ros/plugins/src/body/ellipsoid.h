// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Forces on an ellipsoid that moves through a fluid, as pure functions of its local velocity.
//
// The one implementation for MuJoCo's own fluid forces (stock_terms.h) and for fluid_sim.body;
// twins of fluid_sim_ros/physics/drag.py, lift.py, reynolds.py and added_mass.py. Everything is in
// the ellipsoid's axes: velocity relative to the fluid in, force and torque about its centre out.

#ifndef FLUID_SIM_BODY_ELLIPSOID_H_
#define FLUID_SIM_BODY_ELLIPSOID_H_

#include <mujoco/mujoco.h>

#include "shared/terms.h"

namespace fluid_sim {

// Coefficients in the order of MJCF's fluidcoef.
struct EllipsoidCoefficients {
  mjtNum blunt, slender, angular, kutta, magnus;
};

// Corrections of the drag that a body may choose; all off: MuJoCo's drag.
struct DragOptions {
  bool true_area = false;     // true projected area instead of MuJoCo's
  bool brown_lawler = false;  // blunt coefficient from the Reynolds number
  bool swept_only = false;    // angular drag without its slender part, C_slender (I_max - I_D)
};

// An ellipsoid as the drag sees it.
struct EllipsoidShape {
  mjtNum semiaxes[3];  // [m]
  EllipsoidCoefficients coefficients;
};

// MuJoCo's projected area [m^2], the cosine between the velocity and the normal of the section
// that casts the shadow, and that normal; all 0 at rest.
struct Projection {
  mjtNum area;
  mjtNum cosine;
  mjtNum normal[3];
};

Projection ProjectEllipsoid(const mjtNum semiaxes[3], const mjtNum v[3]);

// pi sqrt((ry rz ux)^2 + (rz rx uy)^2 + (rx ry uz)^2) along u = v/|v| [m^2]; 0 at rest.
mjtNum TrueProjectedArea(const mjtNum semiaxes[3], const mjtNum v[3]);

// C_blunt(Re) = (Cd - 24/Re)/2 with Cd = 24/Re (1 + .15 Re^.681) + .407/(1 + 8710/Re); the Stokes
// part stays with the viscous term. Brown and Lawler (2003), J. Environ. Eng. 129:222; Re < 2e5.
mjtNum BrownLawlerBlunt(mjtNum reynolds);

// Resistance to v and w [N s/m], [N m s]: force = -linear v, torque = -angular w. First of the
// quadratic drag, then of the viscous term (Stokes drag of a sphere of the mean diameter).
struct Resistance {
  mjtNum linear, angular, viscous_linear, viscous_angular;
  mjtNum reynolds;  // that the blunt coefficient was taken at [-]; 0 where it is constant

  Wrench Drag(const mjtNum w[3], const mjtNum v[3]) const;
  Wrench Viscous(const mjtNum w[3], const mjtNum v[3]) const;
};

Resistance EllipsoidResistance(const EllipsoidShape& shape, const DragOptions& options,
                               const FluidConstants& fluid, const mjtNum w[3], const mjtNum v[3]);

// Lift of a rotating body, c rho V w x v.
Wrench EllipsoidMagnus(const EllipsoidShape& shape, const FluidConstants& fluid, const mjtNum w[3],
                       const mjtNum v[3]);

// Lift of an oblique body, c rho A cos (n x v) x v.
Wrench EllipsoidKutta(const EllipsoidShape& shape, const FluidConstants& fluid, const mjtNum v[3]);

// Convective added-mass wrench for a diagonal added-mass matrix (Lamb 1932, ch. 5): does no work.
Wrench AddedMassConvective(const mjtNum mass[3], const mjtNum inertia[3], const mjtNum w[3],
                           const mjtNum v[3]);

// Shape of the ellipsoid that stands for a geom, as MuJoCo's own fluid model takes it.
EllipsoidShape GeomEllipsoid(const mjModel* m, int geom);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_ELLIPSOID_H_
