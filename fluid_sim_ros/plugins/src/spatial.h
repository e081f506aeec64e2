// Small 3-vector and 6x6 helpers. A 6-vector is (linear, angular), a 6x6 matrix is row major.
//
// "About a point": the velocities are those of that body point, the torques are about it.

#ifndef FLUID_SIM_SPATIAL_H_
#define FLUID_SIM_SPATIAL_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

constexpr mjtNum kPi = 3.14159265358979323846;

// a + b x c
void AddCross(mjtNum out[3], const mjtNum b[3], const mjtNum c[3]);

// out = S with S y = x cross y
void CrossMatrix(mjtNum out[9], const mjtNum x[3]);

// out = A B and out = A B' for 3x3 matrices, row major
void Multiply3(mjtNum out[9], const mjtNum a[9], const mjtNum b[9]);
void MultiplyTransposed3(mjtNum out[9], const mjtNum a[9], const mjtNum b[9]);

// out = A x for 6x6 A
void MultiplyMatrix6(mjtNum out[6], const mjtNum a[36], const mjtNum x[6]);

// target += scale * source, 36 numbers
void AddScaled36(mjtNum target[36], const mjtNum source[36], mjtNum scale);

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

#endif  // FLUID_SIM_SPATIAL_H_
