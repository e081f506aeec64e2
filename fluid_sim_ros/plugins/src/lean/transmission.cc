// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "lean/transmission.h"

#include <algorithm>

#include "lean/served.h"
#include "shared/spatial.h"

// Exported by MuJoCo's library without a declaration in its headers.
extern "C" void mju_mulMatVecSparse(mjtNum* res, const mjtNum* mat, const mjtNum* vec, int nr,
                                    const int* rownnz, const int* rowadr, const int* colind,
                                    const int* rowsuper);

namespace fluid_sim {
namespace {

bool IsScalar(int joint_type) { return joint_type == mjJNT_HINGE || joint_type == mjJNT_SLIDE; }

// Of a wrench [force, torque] at a site, on one degree of freedom: as mju_mulMatTVec adds it up.
mjtNum Along(const mjtNum axis[3], const mjtNum vector[3]) {
  mjtNum sum = 0;
  for (int k = 0; k < 3; ++k) sum += axis[k] * vector[k];
  return sum;
}

// The row of an actuator at a site, dofs rising, without those that it does not move; its length.
int SiteRow(const mjModel* m, const mjData* d, int site, const mjtNum gear[6], int* columns,
            mjtNum* moment) {
  int body = m->site_bodyid[site];
  const mjtNum* point = d->site_xpos + 3 * site;
  mjtNum offset[3], force[3], torque[3];
  Subtract3(offset, point, d->subtree_com + 3 * m->body_rootid[body]);
  Rotate(force, d->site_xmat + 9 * site, gear);
  Rotate(torque, d->site_xmat + 9 * site, gear + 3);
  while (body && !m->body_dofnum[body]) body = m->body_parentid[body];
  if (!body) return 0;
  int count = 0;
  for (int dof = m->body_dofadr[body] + m->body_dofnum[body] - 1; dof >= 0;
       dof = m->dof_parentid[dof]) {
    const mjtNum* axis = d->cdof + 6 * dof;
    mjtNum shift[3];
    Cross3(shift, axis, offset);
    AddTo3(shift, axis + 3);
    const mjtNum value = Along(shift, force) + Along(axis, torque);
    if (value == 0) continue;
    columns[count] = dof;
    moment[count++] = value;
  }
  std::reverse(columns, columns + count);
  std::reverse(moment, moment + count);
  return count;
}

template <class T>
bool AllZero(const T* numbers, mjtSize count) {
  return std::all_of(numbers, numbers + count, [](T x) { return x == 0; });
}

}  // namespace

void WriteMoments(const mjModel* m, mjData* d) {
  int address = 0;
  for (int i = 0; i < m->nactuator; ++i) {
    const int id = m->actuator_trnid[2 * i];
    const mjtNum* gear = m->actuator_gear + 6 * i;
    int* columns = d->moment_colind + address;
    mjtNum* moment = d->actuator_moment + address;
    int count = 1;
    if (m->actuator_trntype[i] == mjTRN_SITE) {
      d->actuator_length[i] = 0;
      count = SiteRow(m, d, id, gear, columns, moment);
    } else {
      d->actuator_length[i] = d->qpos[m->jnt_qposadr[id]] * gear[0];
      columns[0] = m->jnt_dofadr[id];
      moment[0] = gear[0];
    }
    d->moment_rowadr[i] = address;
    d->moment_rownnz[i] = count;
    address += count;
  }
  mju_mulMatVecSparse(d->actuator_velocity, d->actuator_moment, d->qvel, static_cast<int>(m->nout),
                      d->moment_rownnz, d->moment_rowadr, d->moment_colind, nullptr);
}

void Transmission::Learn(const mjModel* m) {
  served_ = false;
  const mjtSize count = m->nactuator;
  if (!count || m->nout != count || m->nsensor > 0 || !m->njnt) return;
  if (!AllZero(m->actuator_damping, count) || !AllZero(m->actuator_armature, count) ||
      !AllZero(m->actuator_dampingpoly, count * mjNPOLY)) {
    return;
  }
  type_.assign(m->actuator_trntype, m->actuator_trntype + count);
  target_.assign(m->actuator_trnid, m->actuator_trnid + 2 * count);
  const int* joint = std::find_if(m->jnt_type, m->jnt_type + m->njnt, IsScalar);
  const int stand_in = joint < m->jnt_type + m->njnt ? static_cast<int>(joint - m->jnt_type) : 0;
  bool any = false;
  mjtSize entries = 0;
  for (int i = 0; i < count; ++i) {
    if (type_[i] == mjTRN_SITE && target_[2 * i + 1] < 0) {
      any = true;
      type_[i] = mjTRN_JOINT;
      target_[2 * i] = stand_in;
      entries += IsScalar(m->jnt_type[stand_in]) ? 1 : 6;
    } else if (type_[i] == mjTRN_JOINT && IsScalar(m->jnt_type[target_[2 * i]])) {
      ++entries;
    } else {
      return;
    }
  }
  served_ = any && entries <= m->nJmom;
}

bool Transmission::Ready(const mjModel* m) const {
  if (!served_ || (m->opt.disableflags & mjDSBL_ACTUATION)) return false;
  return InstallControl();
}

void Transmission::Disguise(mjModel* head) const {
  head->actuator_trntype = const_cast<int*>(type_.data());
  head->actuator_trnid = const_cast<int*>(target_.data());
}

}  // namespace fluid_sim
