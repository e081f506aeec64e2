// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/factor.h"

// all of a loop of a known length: the compiler would rather make vectors of two numbers
#define UNROLL _Pragma("GCC unroll 6")

namespace fluid_sim {

// L'DL from the last row up (Featherstone 2008, section 6.5): rows of six dofs in one chain are
// full, row i has i + 1 numbers.
bool FactorFreeTree(const mjModel* m, mjData* d, int first_dof) {
  mjtNum rows[6][6], inverses[6];
  const int* address = m->M_rowadr + first_dof;
  UNROLL for (int i = 0; i < 6; ++i) {
    UNROLL for (int j = 0; j <= i; ++j) rows[i][j] = d->M[address[i] + j];
  }
  UNROLL for (int k = 5; k >= 0; --k) {
    if (!(rows[k][k] > mjMINVAL)) return false;
    const mjtNum inverse = inverses[k] = 1 / rows[k][k];
    UNROLL for (int i = k - 1; i >= 0; --i) {
      const mjtNum share = -rows[k][i] * inverse;
      UNROLL for (int j = 0; j <= i; ++j) rows[i][j] += rows[k][j] * share;
    }
    UNROLL for (int j = 0; j < k; ++j) rows[k][j] *= inverse;
  }
  UNROLL for (int i = 0; i < 6; ++i) {
    UNROLL for (int j = 0; j <= i; ++j) d->qLD[address[i] + j] = rows[i][j];
    d->qLDiagInv[first_dof + i] = inverses[i];
  }
  return true;
}

}  // namespace fluid_sim
