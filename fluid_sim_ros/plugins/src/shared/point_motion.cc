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

void PointVelocity(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                   mjtNum velocity_w[3], mjtNum omega_w[3]) {
  // cvel is about the tree's centre of mass, in world axes, angular part first
  const mjtNum* spatial = d->cvel + 6 * body;
  mjtNum arm[3];
  Subtract3(arm, point_w, d->subtree_com + 3 * m->body_rootid[body]);
  Copy3(omega_w, spatial);
  Copy3(velocity_w, spatial + 3);
  AddCross(velocity_w, omega_w, arm);
}

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
  mjtNum arm[3], torque[3], all[3];
  Subtract3(arm, point_w, d->subtree_com + 3 * m->body_rootid[body]);
  Copy3(torque, wrench.torque_w);
  Add3(all, wrench.torque_w, wrench.other_torque_w);
  AddCross(torque, arm, wrench.force_w);
  AddCross(all, arm, wrench.force_w);
  for (int dof = LastDof(m, body); dof >= 0; dof = m->dof_parentid[dof]) {
    const mjtNum* axis = d->cdof + 6 * dof;
    const mjtNum linear = Dot3(axis + 3, wrench.force_w);
    d->qfrc_fluid[dof] += Dot3(axis, torque) + linear;
    d->qfrc_passive[dof] += Dot3(axis, all) + linear;
  }
}

bool IsAsleep(const mjModel* m, const mjData* d, int body) {
  return (m->opt.enableflags & mjENBL_SLEEP) && !d->tree_awake[m->body_treeid[body]];
}

}  // namespace fluid_sim
