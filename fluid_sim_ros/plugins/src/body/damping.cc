// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/damping.h"

#include <cmath>

#include "shared/spatial.h"

namespace fluid_sim {

void TakeOffConvection(const mjtNum a[36], std::vector<CrossTerm>* terms) {
  for (CrossTerm& term : *terms) {
    // its force is a form of second degree: f(x + y) - f(x) - f(y) has the mixed product alone
    mjtNum mixed = 0;
    for (const int part : {0, 1, 2}) {
      mjtNum nu[6] = {0}, momentum[6], force[6] = {0};
      if (part != 1) nu[term.absolute] = 1;
      if (part != 2) nu[term.linear] = 1;
      MultiplyMatrix6(momentum, a, nu);
      AddConvection(momentum, nu, force);
      mixed += part == 0 ? force[term.row] : -force[term.row];
    }
    term.coefficient += mixed;
  }
}

void AddDamping(const Damping& damping, const mjtNum nu[6], mjtNum linear_share,
                mjtNum quadratic_share, mjtNum out[6], mjtNum* secant) {
  if (damping.diagonal) {
    for (int i = 0; i < 6; ++i) {
      const mjtNum k = linear_share * damping.linear[7 * i] +
                       quadratic_share * damping.quadratic[7 * i] * std::abs(nu[i]);
      out[i] -= k * nu[i];
      if (secant) secant[7 * i] += k;
    }
    return;
  }
  mjtNum matrix[36], force[6];
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      matrix[6 * i + j] = linear_share * damping.linear[6 * i + j] +
                          quadratic_share * damping.quadratic[6 * i + j] * std::abs(nu[j]);
    }
  }
  if (damping.fades) {
    const mjtNum across = std::hypot(nu[0], nu[1]);
    for (int i = 0; i < 2; ++i) {
      if (!damping.fade[i]) continue;
      const mjtNum lost = linear_share * across / (damping.fade[i] + across);
      for (int j = 0; j < 2; ++j) matrix[6 * (3 + i) + j] -= lost * damping.linear[6 * (3 + i) + j];
    }
  }
  for (const CrossTerm& term : damping.cross) {
    matrix[6 * term.row + term.linear] +=
        quadratic_share * term.coefficient * std::abs(nu[term.absolute]);
  }
  MultiplyMatrix6(force, matrix, nu);
  for (int i = 0; i < 6; ++i) out[i] -= force[i];
  if (!secant) return;
  // per fluid, so that the sum of the parts stays semi-definite too
  ProjectSemidefinite6(matrix);
  AddScaled36(secant, matrix, 1);
}

}  // namespace fluid_sim
