// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// MuJoCo's own fluid forces on an ellipsoid and on an inertia box, and their slopes, to the bit:
// each number is made of the same operations in the same order, those that only the model and the
// fluid decide once. body/ellipsoid.h has the physics and what each term is.

#ifndef FLUID_SIM_LEAN_FLUID_ELLIPSOID_H_
#define FLUID_SIM_LEAN_FLUID_ELLIPSOID_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// Velocities are local and relative to the fluid, rotation first: [rad/s], [m/s]; forces likewise:
// [N m], [N]. Slopes are d(force)/d(velocity), 6x6.

class FluidEllipsoid {
 public:
  FluidEllipsoid(const mjModel* m, int geom);

  void Force(const mjtNum velocity[6], mjtNum force[6]) const;

  // As they are, or their symmetric part.
  void Slopes(const mjtNum velocity[6], bool symmetric, mjtNum slopes[36]) const;

 private:
  // The direction u of a velocity, and what the ellipsoid shows along it: with a = (r_y r_z)^2 of
  // semi-axes in units of the longest, ..., the second order a x^2 + b y^2 + c z^2, its shares,
  // and the fourth order, that of the squared shares.
  struct Way {
    mjtNum speed, u[3], uu[3], share[3], shares[3], root, fourth, root_fourth;
  };
  Way WayOf(const mjtNum v[3]) const;
  void AddMagnus(const mjtNum velocity[6], mjtNum slopes[36]) const;
  void AddKutta(const Way& way, mjtNum slopes[36]) const;
  void AddDrag(const Way& way, mjtNum slopes[36]) const;
  void AddSpin(const mjtNum w[3], mjtNum slopes[36]) const;
  void AddAddedMass(const mjtNum velocity[6], mjtNum slopes[36]) const;

  mjtNum scale_, density_, blunt_, slender_, magnus_, kutta_;
  mjtNum mass_[3], inertia_[3];  // added, times the density
  mjtNum square_[3], longest_squared_;
  mjtNum circle_, area_max_;
  mjtNum moment_[3], slope_moment_[3];
  mjtNum viscous_linear_, viscous_angular_, slope_linear_, slope_angular_, slope_kutta_;
};

class FluidBox {
 public:
  FluidBox(const mjModel* m, int body);

  void Force(const mjtNum velocity[6], mjtNum force[6]) const;

  // Diagonals of what viscosity and density each add; which of the two there are.
  void Slopes(const mjtNum velocity[6], mjtNum viscous[6], mjtNum dense[6]) const;
  bool viscous() const { return viscosity_ > 0; }
  bool dense() const { return density_ > 0; }

 private:
  mjtNum density_, viscosity_;
  mjtNum viscous_angular_, viscous_linear_;
  mjtNum linear_[3], angular_[3], slope_linear_[3], slope_angular_[3];
};

}  // namespace fluid_sim

#endif  // FLUID_SIM_LEAN_FLUID_ELLIPSOID_H_
