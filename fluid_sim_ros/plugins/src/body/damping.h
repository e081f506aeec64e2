// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Vehicle damping of ship theory (Fossen 2021, ch. 6): linear, quadratic and cross terms.

#ifndef FLUID_SIM_BODY_DAMPING_H_
#define FLUID_SIM_BODY_DAMPING_H_

#include <mujoco/mujoco.h>

#include <vector>

namespace fluid_sim {

// -c |nu_j| nu_k in row i.
struct CrossTerm {
  int row, absolute, linear;
  mjtNum coefficient;
};

// Coefficients about the reference point, of the sign of a resistance (D = -X_u, ...), for a body
// wholly in the lower fluid.
struct Damping {
  bool any = false;
  bool diagonal = false;       // alone: most published sets
  mjtNum linear[36] = {0};     // [N s/m], [N s], [N m s]
  mjtNum quadratic[36] = {0};  // column j multiplies |nu_j| nu_j
  std::vector<CrossTerm> cross;
  // Speed through the fluid across z at which the linear moments of roll and of pitch by surge and
  // sway are half of what they would be [m/s]; 0: they do not fade.
  bool fades = false;
  mjtNum fade[2] = {0};
};

// Take off the cross terms, stated as totals, what the convection of an added mass A gives (the
// Munk moment and its like), so that both together are the totals while nu_absolute > 0.
void TakeOffConvection(const mjtNum a[36], std::vector<CrossTerm>* terms);

// Wrench -(f_l D + f_q D_q |nu|) nu added to out[6]; the secant matrix to secant[36] unless null.
// f_l and f_q are the shares of the linear and the quadratic part that act.
void AddDamping(const Damping& damping, const mjtNum nu[6], mjtNum linear_share,
                mjtNum quadratic_share, mjtNum out[6], mjtNum* secant);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_DAMPING_H_
