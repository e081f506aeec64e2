#include "shared/point_motion.h"

#include "shared/spatial.h"

namespace fluid_sim {

void PointVelocity(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                   mjtNum velocity_w[3], mjtNum omega_w[3]) {
  // cvel is about the tree's centre of mass, in world axes, angular part first
  const mjtNum* spatial = d->cvel + 6 * body;
  mjtNum arm[3];
  mju_sub3(arm, point_w, d->subtree_com + 3 * m->body_rootid[body]);
  mju_copy3(omega_w, spatial);
  mju_copy3(velocity_w, spatial + 3);
  AddCross(velocity_w, omega_w, arm);
}

void AddGeneralizedForce(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                         const mjtNum force_w[3], const mjtNum torque_w[3], mjtNum* target) {
  mjtNum arm[3], torque[3];
  mju_sub3(arm, point_w, d->subtree_com + 3 * m->body_rootid[body]);
  mju_copy3(torque, torque_w);
  AddCross(torque, arm, force_w);
  while (body > 0 && m->body_dofnum[body] == 0) body = m->body_parentid[body];
  if (body == 0) return;
  const int last = m->body_dofadr[body] + m->body_dofnum[body] - 1;
  for (int dof = last; dof >= 0; dof = m->dof_parentid[dof]) {
    const mjtNum* axis = d->cdof + 6 * dof;
    target[dof] += mju_dot3(axis, torque) + mju_dot3(axis + 3, force_w);
  }
}

bool IsAsleep(const mjModel* m, const mjData* d, int body) {
  return (m->opt.enableflags & mjENBL_SLEEP) && !d->tree_awake[m->body_treeid[body]];
}

}  // namespace fluid_sim
