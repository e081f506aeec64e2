// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "shared/spatial.h"

#include <algorithm>
#include <cmath>

namespace fluid_sim {
namespace {

void Symmetrize6(mjtNum a[36]) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      a[6 * i + j] = a[6 * j + i] = 0.5 * (a[6 * i + j] + a[6 * j + i]);
    }
  }
}

// Cholesky factorization succeeds: symmetric a is positive definite (cheap test, no result kept).
bool IsDefinite6(const mjtNum a[36]) {
  mjtNum l[36];
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      mjtNum sum = a[6 * i + j];
      for (int k = 0; k < j; ++k) sum -= l[6 * i + k] * l[6 * j + k];
      if (i == j) {
        if (sum <= 0) return false;
        l[7 * i] = std::sqrt(sum);
      } else {
        l[6 * i + j] = sum / l[7 * j];
      }
    }
  }
  return true;
}

// One Jacobi rotation in the plane (p, q), applied to a and to the eigenvectors.
void RotatePlane(mjtNum a[36], mjtNum vectors[36], int p, int q) {
  const mjtNum theta = (a[7 * q] - a[7 * p]) / (2 * a[6 * p + q]);
  const mjtNum t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const mjtNum c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (int k = 0; k < 6; ++k) {
    const mjtNum kp = a[6 * k + p], kq = a[6 * k + q];
    a[6 * k + p] = c * kp - s * kq;
    a[6 * k + q] = s * kp + c * kq;
  }
  for (int k = 0; k < 6; ++k) {
    const mjtNum pk = a[6 * p + k], qk = a[6 * q + k];
    a[6 * p + k] = c * pk - s * qk;
    a[6 * q + k] = s * pk + c * qk;
    const mjtNum vp = vectors[6 * k + p], vq = vectors[6 * k + q];
    vectors[6 * k + p] = c * vp - s * vq;
    vectors[6 * k + q] = s * vp + c * vq;
  }
}

}  // namespace

void CrossMatrix(mjtNum out[9], const mjtNum x[3]) {
  const mjtNum s[9] = {0, -x[2], x[1], x[2], 0, -x[0], -x[1], x[0], 0};
  mju_copy(out, s, 9);
}

void ShiftMatrix6(mjtNum out[36], const mjtNum a[36], const mjtNum offset[3]) {
  // A H changes the angular columns only: A_v + (...) S; H' A then the angular rows only
  mjtNum s[9], right[36];
  mju_copy(right, a, 36);
  if (offset[0] == 0 && offset[1] == 0 && offset[2] == 0) {
    mju_copy(out, right, 36);
    return;
  }
  CrossMatrix(s, offset);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) right[6 * i + 3 + j] += a[6 * i + k] * s[3 * k + j];
    }
  }
  mju_copy(out, right, 36);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 6; ++j) {
      for (int k = 0; k < 3; ++k) out[6 * (3 + i) + j] += s[3 * k + i] * right[6 * k + j];
    }
  }
}

void RotateMatrix6(mjtNum out[36], const mjtNum a[36], const mjtNum rotation[9]) {
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 2; ++column) {
      mjtNum block[9], half[9], full[9];
      for (int i = 0; i < 9; ++i) block[i] = a[6 * (3 * row + i / 3) + 3 * column + i % 3];
      Multiply3(half, rotation, block);
      MultiplyTransposed3(full, half, rotation);
      for (int i = 0; i < 9; ++i) out[6 * (3 * row + i / 3) + 3 * column + i % 3] = full[i];
    }
  }
}

void AddIsotropic6(mjtNum target[36], mjtNum linear, mjtNum angular, const mjtNum center[3]) {
  if (center[0] == 0 && center[1] == 0 && center[2] == 0) {
    for (int i = 0; i < 3; ++i) {
      target[7 * i] += linear;
      target[7 * (3 + i)] += angular;
    }
    return;
  }
  mjtNum s[9];
  CrossMatrix(s, center);
  for (int i = 0; i < 3; ++i) {
    target[7 * i] += linear;
    target[7 * (3 + i)] += angular;
    for (int j = 0; j < 3; ++j) {
      target[6 * i + 3 + j] -= linear * s[3 * i + j];
      target[6 * (3 + i) + j] += linear * s[3 * i + j];
      mjtNum product = 0;
      for (int k = 0; k < 3; ++k) product += s[3 * i + k] * s[3 * k + j];
      target[6 * (3 + i) + 3 + j] -= linear * product;
    }
  }
}

mjtNum EigenSymmetric6(const mjtNum matrix[36], mjtNum values[6], mjtNum vectors[36]) {
  mjtNum a[36];
  mju_copy(a, matrix, 36);
  Symmetrize6(a);
  mju_zero(vectors, 36);
  for (int i = 0; i < 6; ++i) vectors[7 * i] = 1;
  // cyclic Jacobi: quadratic convergence, 6x6 needs about six sweeps; the bound is a safeguard
  for (int sweep = 0; sweep < 30; ++sweep) {
    mjtNum off = 0, diagonal = 0;
    for (int p = 0; p < 6; ++p) {
      diagonal += a[7 * p] * a[7 * p];
      for (int q = p + 1; q < 6; ++q) off += a[6 * p + q] * a[6 * p + q];
    }
    if (off <= 1e-30 * diagonal || off == 0) break;
    for (int p = 0; p < 6; ++p) {
      for (int q = p + 1; q < 6; ++q) {
        if (a[6 * p + q] != 0) RotatePlane(a, vectors, p, q);
      }
    }
  }
  for (int i = 0; i < 6; ++i) values[i] = a[7 * i];
  return *std::min_element(values, values + 6);
}

void ProjectSemidefinite6(mjtNum a[36]) {
  Symmetrize6(a);
  if (IsDefinite6(a)) return;
  mjtNum values[6], vectors[36];
  if (EigenSymmetric6(a, values, vectors) >= 0) return;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      mjtNum sum = 0;
      for (int k = 0; k < 6; ++k) {
        sum += std::max<mjtNum>(values[k], 0) * vectors[6 * i + k] * vectors[6 * j + k];
      }
      a[6 * i + j] = sum;
    }
  }
}

}  // namespace fluid_sim
