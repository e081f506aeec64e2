// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "shared/point_motion.h"

#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// Last dof of the chain that moves a body, or -1.
int LastDof(const mjModel* m, int body) {
  while (body > 0 && m->body_dofnum[body] == 0) body = m->body_parentid[body];
  return body == 0 ? -1 : m->body_dofadr[body] + m->body_dofnum[body] - 1;
}

}  // namespace

void AddGeneralizedForce(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                         const mjtNum force_w[3], const mjtNum torque_w[3], mjtNum* target) {
  mjtNum arm[3], torque[3];
  Subtract3(arm, point_w, d->subtree_com + 3 * m->body_rootid[body]);
  Copy3(torque, torque_w);
  AddCross(torque, arm, force_w);
  for (int dof = LastDof(m, body); dof >= 0; dof = m->dof_parentid[dof]) {
    const mjtNum* axis = d->cdof + 6 * dof;
    target[dof] += Dot3(axis, torque) + Dot3(axis + 3, force_w);
  }
}

void AddPassiveForce(const mjModel* m, mjData* d, int body, const mjtNum point_w[3],
                     const PassiveWrench& wrench) {
  mjtNum arm[3], swing[3], torque[3], all[3];
  Subtract3(arm, point_w, d->subtree_com + 3 * m->body_rootid[body]);
  Cross3(swing, arm, wrench.force_w);
  Add3(torque, wrench.torque_w, swing);
  const bool one = IsZero3(wrench.other_torque_w);
  if (!one) {
    Add3(all, wrench.torque_w, wrench.other_torque_w);
    AddTo3(all, swing);
  }
  const auto add = [d, &wrench, &torque, &all, one](int dof) {
    const mjtNum* axis = d->cdof + 6 * dof;
    const mjtNum linear = Dot3(axis + 3, wrench.force_w);
    const mjtNum fluid = Dot3(axis, torque) + linear;
    d->qfrc_fluid[dof] += fluid;
    d->qfrc_passive[dof] += one ? fluid : Dot3(axis, all) + linear;
  };
  int dof = LastDof(m, body);
  if (dof < 0 || m->jnt_type[m->dof_jntid[dof]] != mjJNT_FREE) {
    for (; dof >= 0; dof = m->dof_parentid[dof]) add(dof);
    return;
  }
  // a free joint: translation along the axes of the world, of which the torque has no share
  for (int i = 0; i < 3; ++i) {
    d->qfrc_fluid[dof - 5 + i] += wrench.force_w[i];
    d->qfrc_passive[dof - 5 + i] += wrench.force_w[i];
  }
  for (int i = dof - 2; i <= dof; ++i) add(i);
}

}  // namespace fluid_sim
