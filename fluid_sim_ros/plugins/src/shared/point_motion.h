// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Velocity of, and wrenches at, points of bodies, in world axes.

#ifndef FLUID_SIM_SHARED_POINT_MOTION_H_
#define FLUID_SIM_SHARED_POINT_MOTION_H_

#include <mujoco/mujoco.h>

#include "shared/spatial.h"

namespace fluid_sim {

// Velocity of the body point at `point_w` [m/s] and of the body's rotation [rad/s].
inline void PointVelocity(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                          mjtNum velocity_w[3], mjtNum omega_w[3]) {
  // cvel is about the tree's centre of mass, in world axes, angular part first
  const mjtNum* spatial = d->cvel + 6 * body;
  mjtNum arm[3];
  Subtract3(arm, point_w, d->subtree_com + 3 * m->body_rootid[body]);
  Copy3(omega_w, spatial);
  Copy3(velocity_w, spatial + 3);
  AddCross(velocity_w, omega_w, arm);
}

// target += J'(force, torque) of a wrench at `point_w`; no stack memory.
void AddGeneralizedForce(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                         const mjtNum force_w[3], const mjtNum torque_w[3], mjtNum* target);

// A wrench whose torque is of the fluid, and in part not: `other` goes into all passive forces
// only.
struct PassiveWrench {
  const mjtNum *force_w, *torque_w, *other_torque_w;
};

// As AddGeneralizedForce into d->qfrc_fluid, and with the other torque into d->qfrc_passive.
void AddPassiveForce(const mjModel* m, mjData* d, int body, const mjtNum point_w[3],
                     const PassiveWrench& wrench);

// The tree of the body sleeps: its passive forces are not wanted.
inline bool IsAsleep(const mjModel* m, const mjData* d, int body) {
  return (m->opt.enableflags & mjENBL_SLEEP) && !d->tree_awake[m->body_treeid[body]];
}

}  // namespace fluid_sim

#endif  // FLUID_SIM_SHARED_POINT_MOTION_H_
