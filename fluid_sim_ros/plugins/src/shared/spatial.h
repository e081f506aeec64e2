// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Small 3-vector and 6x6 helpers. A 6-vector is (linear, angular), a 6x6 matrix is row major.
//
// "About a point": the velocities are those of that body point, the torques are about it.

#ifndef FLUID_SIM_SHARED_SPATIAL_H_
#define FLUID_SIM_SHARED_SPATIAL_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// The small sums and products are inline: they make up most of an evaluation. Those that MuJoCo has
// as functions (mju_copy3, mju_dot3, ...) are the same to the bit.

inline void Copy3(mjtNum out[3], const mjtNum x[3]) {
  for (int i = 0; i < 3; ++i) out[i] = x[i];
}

inline bool IsZero3(const mjtNum x[3]) { return x[0] == 0 && x[1] == 0 && x[2] == 0; }

// out = a + b, out = a - b, out = s x
inline void Add3(mjtNum out[3], const mjtNum a[3], const mjtNum b[3]) {
  for (int i = 0; i < 3; ++i) out[i] = a[i] + b[i];
}

inline void Subtract3(mjtNum out[3], const mjtNum a[3], const mjtNum b[3]) {
  for (int i = 0; i < 3; ++i) out[i] = a[i] - b[i];
}

inline void Scale3(mjtNum out[3], const mjtNum x[3], mjtNum s) {
  for (int i = 0; i < 3; ++i) out[i] = x[i] * s;
}

// out += x, out -= x
inline void AddTo3(mjtNum out[3], const mjtNum x[3]) {
  for (int i = 0; i < 3; ++i) out[i] += x[i];
}

inline void SubtractFrom3(mjtNum out[3], const mjtNum x[3]) {
  for (int i = 0; i < 3; ++i) out[i] -= x[i];
}

inline mjtNum Dot3(const mjtNum a[3], const mjtNum b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// out = a x b
inline void Cross3(mjtNum out[3], const mjtNum a[3], const mjtNum b[3]) {
  const mjtNum x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
  out[0] = x;
  out[1] = y;
}

// out += b x c
inline void AddCross(mjtNum out[3], const mjtNum b[3], const mjtNum c[3]) {
  out[0] += b[1] * c[2] - b[2] * c[1];
  out[1] += b[2] * c[0] - b[0] * c[2];
  out[2] += b[0] * c[1] - b[1] * c[0];
}

// out += s b
inline void AddScaled3(mjtNum out[3], const mjtNum b[3], mjtNum s) {
  for (int i = 0; i < 3; ++i) out[i] += s * b[i];
}

// out += a - b
inline void AddDifference3(mjtNum out[3], const mjtNum a[3], const mjtNum b[3]) {
  for (int i = 0; i < 3; ++i) out[i] += a[i] - b[i];
}

// out = R x and out = R' x
inline void Rotate(mjtNum out[3], const mjtNum r[9], const mjtNum x[3]) {
  for (int i = 0; i < 3; ++i) out[i] = r[3 * i] * x[0] + r[3 * i + 1] * x[1] + r[3 * i + 2] * x[2];
}

inline void RotateBack(mjtNum out[3], const mjtNum r[9], const mjtNum x[3]) {
  for (int i = 0; i < 3; ++i) out[i] = r[i] * x[0] + r[3 + i] * x[1] + r[6 + i] * x[2];
}

// out = A B and out = A B' for 3x3 matrices, row major
inline void Multiply3(mjtNum out[9], const mjtNum a[9], const mjtNum b[9]) {
  for (int i = 0; i < 9; ++i) {
    const mjtNum *row = a + i / 3 * 3, *column = b + i % 3;
    out[i] = row[0] * column[0] + row[1] * column[3] + row[2] * column[6];
  }
}

inline void MultiplyTransposed3(mjtNum out[9], const mjtNum a[9], const mjtNum b[9]) {
  for (int i = 0; i < 9; ++i) {
    const mjtNum *row = a + i / 3 * 3, *other = b + i % 3 * 3;
    out[i] = row[0] * other[0] + row[1] * other[1] + row[2] * other[2];
  }
}

// out = A x for 6x6 A
inline void MultiplyMatrix6(mjtNum out[6], const mjtNum a[36], const mjtNum x[6]) {
  for (int i = 0; i < 6; ++i) {
    const mjtNum* row = a + 6 * i;
    out[i] = row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3] * x[3] + row[4] * x[4] +
             row[5] * x[5];
  }
}

// Nothing beside the diagonal.
inline bool IsDiagonal3(const mjtNum a[9]) {
  return a[1] == 0 && a[2] == 0 && a[3] == 0 && a[5] == 0 && a[6] == 0 && a[7] == 0;
}

inline bool IsDiagonal6(const mjtNum a[36]) {
  for (int i = 0; i < 36; ++i) {
    if (i % 7 != 0 && a[i] != 0) return false;
  }
  return true;
}

// target += scale * source, 36 numbers
inline void AddScaled36(mjtNum* __restrict target, const mjtNum* __restrict source, mjtNum scale) {
  for (int i = 0; i < 36; ++i) target[i] += scale * source[i];
}

// Wrench of a momentum (p, l) carried with the body, added: [p x w ; p x v + l x w] (Lamb 1932,
// art. 124). Does no work.
inline void AddConvection(const mjtNum momentum[6], const mjtNum nu[6], mjtNum out[6]) {
  AddCross(out, momentum, nu + 3);
  AddCross(out + 3, momentum, nu);
  AddCross(out + 3, momentum + 3, nu + 3);
}

// out = S with S y = x cross y
void CrossMatrix(mjtNum out[9], const mjtNum x[3]);

// The same kinetic energy about a new point: A' = H'AH, H = [1 S(offset); 0 1], where offset goes
// from the old to the new point; keeps symmetry and rank.
void ShiftMatrix6(mjtNum out[36], const mjtNum a[36], const mjtNum offset[3]);

// The same matrix in other axes: diag(R, R) A diag(R, R)'; R turns old components into new ones.
void RotateMatrix6(mjtNum out[36], const mjtNum a[36], const mjtNum rotation[9]);

// Symmetric 6x6 A of a body that resists translation by `linear` and rotation by `angular` alike
// in all directions at `center`, added about the origin.
void AddIsotropic6(mjtNum target[36], mjtNum linear, mjtNum angular, const mjtNum center[3]);

// Lowest eigenvalue of the symmetric part; vectors (columns) and values when asked for.
mjtNum EigenSymmetric6(const mjtNum a[36], mjtNum values[6], mjtNum vectors[36]);

// a := the nearest symmetric positive semi-definite matrix (symmetric part, clipped spectrum).
void ProjectSemidefinite6(mjtNum a[36]);

}  // namespace fluid_sim

#endif  // FLUID_SIM_SHARED_SPATIAL_H_
