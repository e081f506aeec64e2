// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "lean/stock_fluid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lean/served.h"
#include "shared/spatial.h"

// Exported by MuJoCo's library without a declaration in its headers.
extern "C" {
void mj_implicitSkip(const mjModel* m, mjData* d, int skipfactor);
void mjd_actuator_vel(const mjModel* m, mjData* d);
}

namespace fluid_sim {
namespace {

constexpr int kLongest = 64;  // chain

template <class T>
bool AllZero(const T* numbers, mjtSize count) {
  return std::all_of(numbers, numbers + count, [](T x) { return x == 0; });
}

bool HasEllipsoid(const mjModel* m, int body) {
  for (int i = 0; i < m->body_geomnum[body]; ++i) {
    if (m->geom_fluid[mjNFLUID * (m->body_geomadr[body] + i)] > 0) return true;
  }
  return false;
}

// One free joint is all that moves the body's tree: MuJoCo solves it by both halves of its slopes.
bool IsLone(const mjModel* m, int body) {
  const int root = m->body_rootid[body], joint = m->body_jntadr[root];
  return m->body_jntnum[root] == 1 && m->jnt_type[joint] == mjJNT_FREE &&
         m->tree_dofnum[m->dof_treeid[m->jnt_dofadr[joint]]] == 6;
}

// No actuator's force goes by a velocity: their slopes are none.
bool PlainActuators(const mjModel* m) {
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_gaintype[i] != mjGAIN_FIXED || m->actuator_biastype[i] != mjBIAS_NONE) {
      return false;
    }
  }
  return true;
}

struct Place {
  const mjtNum *position_w, *rotation_w;
};

Place PlaceOf(const mjData* d, int body, int geom) {
  if (geom < 0) return {d->xipos + 3 * body, d->ximat + 9 * body};
  return {d->geom_xpos + 3 * geom, d->geom_xmat + 9 * geom};
}

// Rows of a Jacobian, turned to local axes: rotation, then translation.
struct Jacobian {
  mjtNum rows[6][kLongest];
};

// row += a b' over the chain's first `count` columns, for one number `scale` of the sum.
inline void AddRow(mjtNum* row, const mjtNum* other, mjtNum scale, int count) {
  for (int i = 0; i < count; ++i) row[i] += scale * other[i];
}

}  // namespace

void StockFluid::AddPart(const mjModel* m, int body, int geom,
                         std::variant<FluidEllipsoid, FluidBox> shape) {
  int moving = body;
  while (moving && !m->body_dofnum[moving]) moving = m->body_parentid[moving];
  if (!moving) return;  // nothing that it could move
  const int first = static_cast<int>(chain_.size());
  for (int dof = m->body_dofadr[moving] + m->body_dofnum[moving] - 1; dof >= 0;
       dof = m->dof_parentid[dof]) {
    chain_.push_back(dof);
  }
  std::reverse(chain_.begin() + first, chain_.end());
  const int count = static_cast<int>(chain_.size()) - first;
  served_ = served_ && count <= kLongest;
  parts_.push_back({body, geom, first, count, IsLone(m, body), std::move(shape), {}});
  later_.push_back(static_cast<int>(places_.size()));
  for (int row = 0; row < count; ++row) {
    const int dof = chain_[first + row], begin = m->D_rowadr[dof];
    for (int column = row + 1; column < count; ++column) {
      const int* columns = m->D_colind + begin;
      const int* found =
          std::lower_bound(columns, columns + m->D_rownnz[dof], chain_[first + column]);
      places_.push_back(begin + static_cast<int>(found - columns));
    }
  }
}

void StockFluid::Learn(const mjModel* m) {
  parts_.clear();
  chain_.clear();
  places_.clear();
  later_.clear();
  served_ = m->opt.density >= 0 && m->opt.viscosity >= 0 &&
            (m->opt.density > 0 || m->opt.viscosity > 0) && AllZero(m->body_gravcomp, m->nbody);
  if (!served_) return;
  plain_actuators_ = PlainActuators(m);
  forces_only_ = !plain_actuators_ &&
                 (m->na > 0 || m->nhistory > 0 || !AllZero(m->actuator_damping, m->nactuator) ||
                  !AllZero(m->actuator_dampingpoly, m->nactuator * mjNPOLY));
  for (int body = 1; body < m->nbody; ++body) {
    if (m->body_mass[body] < mjMINVAL) continue;
    if (!HasEllipsoid(m, body)) {
      AddPart(m, body, -1, FluidBox(m, body));
      continue;
    }
    for (int i = 0; i < m->body_geomnum[body]; ++i) {
      const int geom = m->body_geomadr[body] + i;
      if (m->geom_fluid[mjNFLUID * geom] != 0) AddPart(m, body, geom, FluidEllipsoid(m, geom));
    }
  }
}

bool StockFluid::Ready(const mjModel* m) const {
  constexpr int kNoPassive = mjDSBL_SPRING | mjDSBL_DAMPER;
  return served_ && (m->opt.disableflags & kNoPassive) != kNoPassive && InstallPassive();
}

bool StockFluid::ReadySlopes(const mjModel* m) const {
  return m->opt.integrator == mjINT_IMPLICITFAST && !forces_only_;
}

void StockFluid::AddForces(const mjModel* m, mjData* d) {
  const bool calm = IsZero3(m->opt.wind);
  for (Part& part : parts_) {
    if (part.geom >= 0) {
      const int i = part.geom;
      mj_local2Global(d, d->geom_xpos + 3 * i, d->geom_xmat + 9 * i, m->geom_pos + 3 * i,
                      m->geom_quat + 4 * i, part.body, m->geom_sameframe[i]);
    }
    const auto [position_w, rotation_w] = PlaceOf(d, part.body, part.geom);
    const mjtNum* spatial = d->cvel + 6 * part.body;  // about the tree's centre of mass
    mjtNum arm[3], swing[3], linear[3], wind[3], force[6], force_w[3], torque_w[3];
    Subtract3(arm, position_w, d->subtree_com + 3 * m->body_rootid[part.body]);
    Cross3(swing, arm, spatial);
    Subtract3(linear, spatial + 3, swing);
    RotateBack(part.velocity, rotation_w, spatial);
    RotateBack(part.velocity + 3, rotation_w, linear);
    if (!calm) {
      RotateBack(wind, rotation_w, m->opt.wind);
      SubtractFrom3(part.velocity + 3, wind);
    }
    std::visit([&](const auto& shape) { shape.Force(part.velocity, force); }, part.shape);
    Rotate(torque_w, rotation_w, force);
    Rotate(force_w, rotation_w, force + 3);
    for (int i = 0; i < part.count; ++i) {
      const int dof = chain_[part.first + i];
      const mjtNum* axis = d->cdof + 6 * dof;
      mjtNum shift[3];
      Cross3(shift, axis, arm);
      AddTo3(shift, axis + 3);
      d->qfrc_fluid[dof] += Dot3(shift, force_w);
      d->qfrc_fluid[dof] += Dot3(axis, torque_w);
    }
  }
  for (int i = 0; i < m->nv; ++i) d->qfrc_passive[i] += d->qfrc_fluid[i];
}

void StockFluid::AddSlopes(const mjModel* m, mjData* d, const Part& part, bool whole) const {
  const auto [position_w, rotation_w] = PlaceOf(d, part.body, part.geom);
  const int* chain = chain_.data() + part.first;
  const int count = part.count;
  Jacobian j;
  mjtNum arm[3];
  Subtract3(arm, position_w, d->subtree_com + 3 * m->body_rootid[part.body]);
  for (int i = 0; i < count; ++i) {
    const mjtNum* axis = d->cdof + 6 * chain[i];
    mjtNum shift[3], local[6];
    Cross3(shift, axis, arm);
    AddTo3(shift, axis + 3);
    RotateBack(local, rotation_w, axis);
    RotateBack(local + 3, rotation_w, shift);
    for (int k = 0; k < 6; ++k) j.rows[k][i] = local[k];
  }
  mjtNum slopes[36], viscous[6], dense[6];
  const FluidEllipsoid* ellipsoid = std::get_if<FluidEllipsoid>(&part.shape);
  const FluidBox* box = std::get_if<FluidBox>(&part.shape);
  if (ellipsoid) ellipsoid->Slopes(part.velocity, !part.lone, slopes);
  if (box) box->Slopes(part.velocity, viscous, dense);
  const int* place = places_.data() + later_[&part - parts_.data()];
  const bool both = whole || part.lone;
  for (int i = 0; i < count; ++i) {
    mjtNum* row = d->qDeriv + m->D_rowadr[chain[i]];
    mjtNum sum[kLongest];
    const int first = i + 1, end = both ? count : first, later = count - first;
    std::copy(row, row + first, sum);
    for (int k = first; k < end; ++k) sum[k] = d->qDeriv[place[k - first]];
    if (ellipsoid) {
      for (int a = 0; a < 6; ++a) {
        const mjtNum entry = j.rows[a][i];
        if (entry == 0) continue;
        for (int b = 0; b < 6; ++b) {
          if (slopes[6 * a + b] != 0) AddRow(sum, j.rows[b], entry * slopes[6 * a + b], end);
        }
      }
    }
    if (box && box->viscous()) {
      for (int a = 0; a < 6; ++a) AddRow(sum, j.rows[a], j.rows[a][i] * viscous[a], end);
    }
    if (box && box->dense()) {
      for (int a = 0; a < 6; ++a) AddRow(sum, j.rows[a], j.rows[a][i] * dense[a], end);
    }
    std::copy(sum, sum + first, row);
    for (int k = first; k < end; ++k) d->qDeriv[place[k - first]] = sum[k];
    place += later;
  }
}

void StockFluid::Integrate(const mjModel* m, mjModel* head, mjData* d, bool whole) const {
  // as mjd_smooth_vel makes it: zero, actuators, fluid, and in mj_implicitSkip the dampers
  std::fill(d->qDeriv, d->qDeriv + m->nD, 0);
  if (!plain_actuators_) mjd_actuator_vel(m, d);
  for (const Part& part : parts_) AddSlopes(m, d, part, whole);
  head->nD = 0;  // nothing to clear
  if (!plain_actuators_) head->nactuator = 0;
  mj_implicitSkip(head, d, 0);
  head->nD = m->nD;
  head->nactuator = m->nactuator;
}

}  // namespace fluid_sim
