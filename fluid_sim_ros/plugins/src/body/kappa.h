// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Exact added mass of an ellipsoid (Lamb 1932, art. 114; Tuckerman 1925), evaluated at load.

#ifndef FLUID_SIM_BODY_KAPPA_H_
#define FLUID_SIM_BODY_KAPPA_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// Carlson's degenerate elliptic integral of the second kind, x, y >= 0, x + y > 0, z > 0.
// Carlson (1995), Numerical Algorithms 10:13; relative error about 1e-15. NaN where the arguments
// are so far apart, or so large or small, that doubles do not carry it.
double CarlsonRd(double x, double y, double z);

// Added masses [m^3] and moments of inertia [m^5] per unit density along the axes of an ellipsoid
// with semi-axes r [m]: m_i = V k_i/(k_j + k_k), I_i = V/5 (r_j^2 - r_k^2)^2 D_i/(k_i + 2 E_i),
// a form of Tuckerman's quotient that does not cancel for equal axes.
void EllipsoidAddedMass(const mjtNum r[3], mjtNum mass[3], mjtNum inertia[3]);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_KAPPA_H_
