// Ellipsoid drag with the local medium: the seed's forces plus the corrections a body may choose.

#ifndef FLUID_SIM_LOCAL_DRAG_H_
#define FLUID_SIM_LOCAL_DRAG_H_

#include <mujoco/mujoco.h>

#include "fluid_terms.h"

namespace fluid_sim {

struct DragOptions {
  bool true_area = false;     // true projected area instead of the seed's lemma
  bool brown_lawler = false;  // blunt coefficient from the Reynolds number
};

// One geom of the body with fluidshape="ellipsoid".
struct DragEllipsoid {
  mjtNum position[3], rotation[9];  // in body axes
  mjtNum semiaxes[3];
  mjtNum scale;  // MuJoCo's interaction coefficient
  EllipsoidCoefficients coefficients;
};

// pi sqrt((ry rz ux)^2 + (rz rx uy)^2 + (rx ry uz)^2) along u = v/|v| [m^2]; 0 at rest.
mjtNum TrueProjectedArea(const mjtNum semiaxes[3], const mjtNum v[3]);

// C_blunt(Re) = (Cd - 24/Re)/2 with Cd = 24/Re (1 + .15 Re^.681) + .407/(1 + 8710/Re); the Stokes
// part stays with the viscous term. Brown and Lawler (2003), J. Environ. Eng. 129:222; Re < 2e5.
mjtNum BrownLawlerBlunt(mjtNum reynolds);

// Resistance of the ellipsoid to v and w [N s/m], [N m s]: force = -linear v, torque = -angular w.
// First of the quadratic drag, then with the viscous term.
struct Resistance {
  mjtNum linear, angular, viscous_linear, viscous_angular;
};

Resistance EllipsoidResistance(const DragEllipsoid& part, const DragOptions& options,
                               const MediumConstants& medium, const mjtNum w[3], const mjtNum v[3]);

}  // namespace fluid_sim

#endif  // FLUID_SIM_LOCAL_DRAG_H_
