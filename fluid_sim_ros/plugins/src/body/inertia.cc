// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/inertia.h"

#include <algorithm>

#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// Last dof of the chain that moves the body.
int ChainDof(const mjModel* m, int body) {
  while (m->body_dofnum[body] == 0) body = m->body_parentid[body];
  return m->body_dofadr[body] + m->body_dofnum[body] - 1;
}

// Vector from the tree's centre of mass, where cdof refers to, to O, in world axes.
void ComArm(const mjModel* m, const mjData* d, const BodyFluid& body, const Motion& motion,
            mjtNum arm[3]) {
  Subtract3(arm, motion.point_w, d->subtree_com + 3 * m->body_rootid[body.id]);
}

// Rigid inertia of a body about its frame's origin, in body axes. Kept until one of its numbers
// in the model changes.
const mjtNum* RigidMatrix(const mjModel* m, const BodyFluid& body) {
  const mjtNum mass = m->body_mass[body.id];
  const mjtNum *diagonal = m->body_inertia + 3 * body.id, *center = m->body_ipos + 3 * body.id;
  const mjtNum* quat = m->body_iquat + 4 * body.id;
  RigidInertia& kept = body.rigid;
  mjtNum* out = kept.matrix;
  if (mass == kept.mass && std::equal(diagonal, diagonal + 3, kept.diagonal) &&
      std::equal(center, center + 3, kept.center) && std::equal(quat, quat + 4, kept.quat)) {
    return out;
  }
  kept.mass = mass;
  std::copy(diagonal, diagonal + 3, kept.diagonal);
  std::copy(center, center + 3, kept.center);
  std::copy(quat, quat + 4, kept.quat);
  mjtNum rotation[9], scaled[9], inertia[9];
  mju_quat2Mat(rotation, quat);
  for (int i = 0; i < 9; ++i) scaled[i] = rotation[i] * diagonal[i % 3];
  MultiplyTransposed3(inertia, scaled, rotation);
  mju_zero(out, 36);
  for (int i = 0; i < 9; ++i) out[6 * (3 + i / 3) + 3 + i % 3] = inertia[i];
  AddIsotropic6(out, mass, 0, center);
  return out;
}

constexpr int kLongest = 32;  // chain that is worked on side by side
constexpr int kSide = 4;      // of these at once, as a register holds

// Motions of a chain's degrees of freedom, or their momenta.
struct Chain {
  mjtNum rows[6][kLongest];
};

// M += the inertia G about the tree's centre of mass, along the chain that ends with `last`.
void AddLongChainInertia(const mjModel* m, mjData* d, int last, const mjtNum at_com[36]) {
  for (int i = last; i >= 0; i = m->dof_parentid[i]) {
    mjtNum axis[6], column[6];  // (linear, angular) motion of dof i and its momentum
    Copy3(axis, d->cdof + 6 * i + 3);
    Copy3(axis + 3, d->cdof + 6 * i);
    MultiplyMatrix6(column, at_com, axis);
    mjtNum* entry = d->M + m->M_rowadr[i] + m->M_rownnz[i];
    for (int j = i; j >= 0; j = m->dof_parentid[j]) {
      const mjtNum* other = d->cdof + 6 * j;
      *--entry += Dot3(other + 3, column) + Dot3(other, column + 3);
    }
  }
}

}  // namespace

void ApplyWrench(const mjModel* m, mjData* d, const BodyFluid& body, const Motion& motion,
                 const mjtNum wrench[6]) {
  mjtNum force_w[3], torque[3];
  Rotate(force_w, motion.rotation, wrench);
  if (body.free_dof >= 0) {  // world force, torque about the origin in body axes
    Copy3(torque, wrench + 3);
    AddCross(torque, body.point, wrench);
    for (int i = 0; i < 6; ++i) {
      const mjtNum value = i < 3 ? force_w[i] : torque[i - 3];
      d->qfrc_fluid[body.free_dof + i] += value;
      d->qfrc_passive[body.free_dof + i] += value;
    }
    return;
  }
  mjtNum arm[3];
  ComArm(m, d, body, motion, arm);
  Rotate(torque, motion.rotation, wrench + 3);
  AddCross(torque, arm, force_w);
  for (int dof = ChainDof(m, body.id); dof >= 0; dof = m->dof_parentid[dof]) {
    const mjtNum* axis = d->cdof + 6 * dof;
    const mjtNum value = Dot3(axis, torque) + Dot3(axis + 3, force_w);
    d->qfrc_fluid[dof] += value;
    d->qfrc_passive[dof] += value;
  }
}

void WriteFreeInertia(const mjModel* m, mjData* d, const BodyFluid& body, const Motion& motion,
                      const mjtNum g[36]) {
  mjtNum shifted[36];
  const mjtNum to_origin[3] = {-body.point[0], -body.point[1], -body.point[2]};
  const mjtNum *rigid = RigidMatrix(m, body), *added = g;
  if (!IsZero3(to_origin)) {
    ShiftMatrix6(shifted, g, to_origin);
    added = shifted;
  }
  const auto total = [rigid, added](int i, int j) { return rigid[6 * i + j] + added[6 * i + j]; };
  // velocities of the free joint: linear in world axes, angular in body axes
  const mjtNum* r = motion.rotation;
  const int* address = m->M_rowadr + body.free_dof;
  mjtNum* rows[6];
  for (int i = 0; i < 6; ++i) rows[i] = d->M + address[i];
  mjtNum half[9], block[9];
  for (int i = 0; i < 9; ++i) block[i] = total(i / 3, i % 3);
  if (IsDiagonal3(block)) {
    for (int i = 0; i < 9; ++i) half[i] = r[i] * block[4 * (i % 3)];
  } else {
    Multiply3(half, r, block);
  }
  for (int i = 0; i < 3; ++i) {  // the lower triangle of half R'
    for (int j = 0; j <= i; ++j) rows[i][j] = Dot3(half + 3 * i, r + 3 * j);
  }
  for (int i = 0; i < 9; ++i) block[i] = total(3 + i / 3, i % 3);
  mjtNum angular_linear[9] = {0};
  if (!IsZero3(block) || !IsZero3(block + 3) || !IsZero3(block + 6)) {
    MultiplyTransposed3(angular_linear, block, r);
  }
  for (int i = 0; i < 3; ++i) {
    Copy3(rows[3 + i], angular_linear + 3 * i);
    for (int j = 0; j <= i; ++j) rows[3 + i][3 + j] = total(3 + i, 3 + j);
  }
  const mjtNum* armature = m->dof_armature + body.free_dof;
  for (int i = 0; i < 6; ++i) rows[i][i] += armature[i];
}

void AddChainInertia(const mjModel* m, mjData* d, const BodyFluid& body, const Motion& motion,
                     const mjtNum g[36]) {
  // G to world axes about the tree's centre of mass, where every cdof lives
  mjtNum turned[36], at_com[36], offset[3];
  RotateMatrix6(turned, g, motion.rotation);
  ComArm(m, d, body, motion, offset);
  Scale3(offset, offset, -1);
  ShiftMatrix6(at_com, turned, offset);
  const int last = ChainDof(m, body.id), length = m->M_rownnz[last];
  if (length > kLongest) return AddLongChainInertia(m, d, last, at_com);
  // row i of the lower triangle holds exactly the chain from the root to i: side by side in memory
  Chain axis, column;
  const int* chain = m->M_colind + m->M_rowadr[last];
  for (int i = 0; i < length; ++i) {
    const mjtNum* cdof = d->cdof + 6 * chain[i];
    for (int k = 0; k < 6; ++k) axis.rows[k][i] = cdof[(k + 3) % 6];  // (linear, angular)
  }
  for (int i = length; i % kSide != 0; ++i) {
    for (int k = 0; k < 6; ++k) axis.rows[k][i] = 0;
  }
  for (int k = 0; k < 6; ++k) {
    const mjtNum* a = at_com + 6 * k;
    for (int i = 0; i < length; ++i) {
      column.rows[k][i] = a[0] * axis.rows[0][i] + a[1] * axis.rows[1][i] + a[2] * axis.rows[2][i] +
                          a[3] * axis.rows[3][i] + a[4] * axis.rows[4][i] + a[5] * axis.rows[5][i];
    }
  }
  for (int begin = 0; begin < length; begin += kSide) {
    for (int i = begin; i < length; ++i) {
      mjtNum sum[kSide], *row = d->M + m->M_rowadr[chain[i]] + begin;
      for (int j = 0; j < kSide; ++j) {
        const auto product = [&](int k) { return axis.rows[k][begin + j] * column.rows[k][i]; };
        sum[j] = product(0) + product(1) + product(2) + (product(3) + product(4) + product(5));
      }
      if (i >= begin + kSide - 1) {
        for (int j = 0; j < kSide; ++j) row[j] += sum[j];
      } else {
        for (int j = 0; j <= i - begin; ++j) row[j] += sum[j];
      }
    }
  }
}

void PointAcceleration(const mjModel* m, const mjData* d, const BodyFluid& body,
                       const Motion& motion, mjtNum out[6]) {
  mjtNum linear[3] = {0, 0, 0}, angular[3] = {0, 0, 0}, arm[3];
  for (int dof = ChainDof(m, body.id); dof >= 0; dof = m->dof_parentid[dof]) {
    AddScaled3(angular, d->cdof + 6 * dof, d->qacc[dof]);
    AddScaled3(linear, d->cdof + 6 * dof + 3, d->qacc[dof]);
  }
  ComArm(m, d, body, motion, arm);
  AddCross(linear, angular, arm);
  RotateBack(out, motion.rotation, linear);
  RotateBack(out + 3, motion.rotation, angular);
}

}  // namespace fluid_sim
