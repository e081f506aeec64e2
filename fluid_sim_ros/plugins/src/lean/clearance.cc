// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "lean/clearance.h"

#include <algorithm>
#include <cmath>

namespace fluid_sim {
namespace {

// Distances are sums of a few rounded numbers: [m], and as a share of the coordinates.
constexpr mjtNum kSlack = 1e-6, kRelativeSlack = 1e-9;

bool Collides(const mjModel* m, int geom) {
  return m->geom_contype[geom] || m->geom_conaffinity[geom];
}

template <class A, class B>
bool Matches(const A& a, const B& b) {
  return (a.contype & b.conaffinity) || (b.contype & a.conaffinity);
}

// Contacts begin at a distance of the sum of two geoms' margins and gaps.
mjtNum Margin(const mjModel* m, int geom) {
  return std::abs(m->geom_margin[geom]) + std::abs(m->geom_gap[geom]);
}

// Pose of a body that no joint moves, from those of its parents.
void FixedPose(const mjModel* m, int body, mjtNum position[3], mjtNum quat[4]) {
  mju_zero3(position);
  mju_copy4(quat, m->body_quat);  // the world's: 1 0 0 0
  if (body == 0) return;
  mjtNum parent[3], parent_quat[4];
  FixedPose(m, m->body_parentid[body], parent, parent_quat);
  mju_rotVecQuat(position, m->body_pos + 3 * body, parent_quat);
  mju_addTo3(position, parent);
  mju_mulQuat(quat, parent_quat, m->body_quat + 4 * body);
  mju_normalize4(quat);
}

Obstacle ReadObstacle(const mjModel* m, int geom) {
  Obstacle out;
  const int type = m->geom_type[geom];
  out.type = type == mjGEOM_PLANE || type == mjGEOM_BOX ? type : mjGEOM_SPHERE;
  out.contype = m->geom_contype[geom];
  out.conaffinity = m->geom_conaffinity[geom];
  mjtNum body[3], quat[4], geom_quat[4];
  FixedPose(m, m->geom_bodyid[geom], body, quat);
  mju_rotVecQuat(out.position_w, m->geom_pos + 3 * geom, quat);
  mju_addTo3(out.position_w, body);
  mju_mulQuat(geom_quat, quat, m->geom_quat + 4 * geom);
  mju_normalize4(geom_quat);
  mju_quat2Mat(out.rotation_w, geom_quat);
  for (int i = 0; i < 3; ++i) {
    const mjtNum half = type == mjGEOM_BOX ? m->geom_size[3 * geom + i] : 0;
    out.size[i] = half + Margin(m, geom);
  }
  if (out.type == mjGEOM_SPHERE) out.size[0] = m->geom_rbound[geom] + Margin(m, geom);
  return out;
}

// From a point to an obstacle [m]; less than 0 inside of a plane's or ball's.
mjtNum Distance(const Obstacle& obstacle, const mjtNum point[3]) {
  mjtNum away[3], local[3];
  mju_sub3(away, point, obstacle.position_w);
  if (obstacle.type == mjGEOM_SPHERE) return mju_norm3(away) - obstacle.size[0];
  mju_mulMatTVec3(local, obstacle.rotation_w, away);
  if (obstacle.type == mjGEOM_PLANE) return local[2] - obstacle.size[2];
  mjtNum outside = 0;
  for (int i = 0; i < 3; ++i) {
    const mjtNum beyond = std::abs(local[i]) - obstacle.size[i];
    if (!(beyond <= 0)) outside += beyond * beyond;
  }
  return std::sqrt(outside);
}

// How far a body's origin can be from that of the first body of its tree [m]; negative where a
// slide sets no end to it.
mjtNum Reach(const mjModel* m, int body, int first) {
  mjtNum reach = 0;
  for (int i = body;; i = m->body_parentid[i]) {
    for (int k = 0; k < m->body_jntnum[i]; ++k) {
      const int joint = m->body_jntadr[i] + k;
      if (m->jnt_type[joint] == mjJNT_SLIDE) return -1;
      if (m->jnt_type[joint] != mjJNT_FREE) reach += 2 * mju_norm3(m->jnt_pos + 3 * joint);
    }
    if (i == first) return reach;
    reach += mju_norm3(m->body_pos + 3 * i);
  }
}

bool Excluded(const mjModel* m, int body1, int body2) {
  for (int i = 0; i < m->nexclude; ++i) {
    const int signature = m->exclude_signature[i];
    if (signature == (body1 << 16) + body2 || signature == (body2 << 16) + body1) return true;
  }
  return false;
}

// Whether MuJoCo would look for contacts between two geoms of one tree.
bool CanTouchWithin(const mjModel* m, int geom1, int geom2) {
  const int body1 = m->geom_bodyid[geom1], body2 = m->geom_bodyid[geom2];
  const int weld1 = m->body_weldid[body1], weld2 = m->body_weldid[body2];
  if (weld1 == weld2 || Excluded(m, body1, body2)) return false;
  const bool matches = (m->geom_contype[geom1] & m->geom_conaffinity[geom2]) ||
                       (m->geom_contype[geom2] & m->geom_conaffinity[geom1]);
  const int parent1 = m->body_weldid[m->body_parentid[weld1]];
  const int parent2 = m->body_weldid[m->body_parentid[weld2]];
  const bool related = weld1 == parent2 || weld2 == parent1;
  return matches && !(related && !(m->opt.disableflags & mjDSBL_FILTERPARENT));
}

}  // namespace

Clearance::Clearance(const mjModel* m) {
  Bound(m);
  reference_.resize(3 * balls_.size());
}

void Clearance::Bound(const mjModel* m) {
  if (m->opt.disableflags & (mjDSBL_CONTACT | mjDSBL_CONSTRAINT)) return;
  contacts_ = Contacts::kAlways;
  if (m->npair > 0 || m->nflex > 0) return;
  std::vector<std::vector<int>> trees(m->ntree);
  for (int geom = 0; geom < m->ngeom; ++geom) {
    if (!Collides(m, geom)) continue;
    const int body = m->geom_bodyid[geom], tree = m->body_treeid[body];
    if (m->geom_type[geom] != mjGEOM_PLANE && !(m->geom_rbound[geom] > 0)) return;
    if (tree >= 0) {
      trees[tree].push_back(geom);
    } else if (m->body_weldid[body] != 0) {
      return;  // mocap
    } else {
      obstacles_.push_back(ReadObstacle(m, geom));
    }
  }
  for (int tree = 0; tree < m->ntree; ++tree) {
    if (!trees[tree].empty() && !AddBall(m, tree, trees[tree])) return;
  }
  bool any = false;
  for (size_t i = 0; i < balls_.size(); ++i) {
    for (const Obstacle& obstacle : obstacles_) any |= Matches(balls_[i], obstacle);
    for (size_t k = 0; k < i; ++k) any |= Matches(balls_[i], balls_[k]);
  }
  contacts_ = any ? Contacts::kWatched : Contacts::kNever;
}

// Add the ball of a tree's colliding geoms; false where it has none.
bool Clearance::AddBall(const mjModel* m, int tree, const std::vector<int>& geoms) {
  int first = m->geom_bodyid[geoms[0]];
  while (m->body_treeid[m->body_parentid[first]] == tree) first = m->body_parentid[first];
  Ball ball{-1, -1, first, {0, 0, 0}, 0, 0, 0};
  const int joint = m->body_jntadr[first];
  if (m->body_jntnum[first] == 1 && m->jnt_type[joint] == mjJNT_FREE) {
    ball.position = m->jnt_qposadr[joint];
    ball.velocity = m->jnt_dofadr[joint];
  } else {
    const int parent = m->body_parentid[first];
    if (m->body_weldid[parent] != 0) return false;  // on a mocap body
    mjtNum position[3], quat[4];
    FixedPose(m, parent, position, quat);
    mju_rotVecQuat(ball.center_w, m->body_pos + 3 * first, quat);
    mju_addTo3(ball.center_w, position);
  }
  for (int geom : geoms) {
    const mjtNum reach = Reach(m, m->geom_bodyid[geom], first);
    if (reach < 0 || m->geom_type[geom] == mjGEOM_PLANE) return false;
    const mjtNum offset = mju_norm3(m->geom_pos + 3 * geom);
    ball.radius = std::max(ball.radius, reach + offset + m->geom_rbound[geom] + Margin(m, geom));
    ball.contype |= m->geom_contype[geom];
    ball.conaffinity |= m->geom_conaffinity[geom];
    for (int other : geoms) {
      if (other < geom && CanTouchWithin(m, other, geom)) return false;
    }
  }
  balls_.push_back(ball);
  return true;
}

bool Clearance::Within(size_t ball, const mjtNum* center) const {
  const mjtNum* from = reference_.data() + 3 * ball;
  const mjtNum x = center[0] - from[0], y = center[1] - from[1], z = center[2] - from[2];
  return free_way_ > 0 && x * x + y * y + z * z < free_way_ * free_way_;  // false for NaN
}

// The smallest way that one of the centers has to go before any two geoms can touch [m].
mjtNum Clearance::Gap() const {
  mjtNum gap = mjMAXVAL, largest = 0;
  for (size_t i = 0; i < balls_.size(); ++i) {
    const mjtNum* center = reference_.data() + 3 * i;
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(center[k]));
    largest = std::max(largest, balls_[i].radius);
    for (const Obstacle& obstacle : obstacles_) {
      if (!Matches(balls_[i], obstacle)) continue;
      const mjtNum free = Distance(obstacle, center) - balls_[i].radius;
      if (!(free > 0)) return -1;  // NaN, too
      gap = std::min(gap, free);
    }
    for (size_t k = 0; k < i; ++k) {
      if (!Matches(balls_[i], balls_[k])) continue;
      const mjtNum apart = mju_dist3(center, reference_.data() + 3 * k);
      const mjtNum free = 0.5 * (apart - balls_[i].radius - balls_[k].radius);
      if (!(free > 0)) return -1;
      gap = std::min(gap, free);
    }
  }
  return gap - kSlack - kRelativeSlack * largest;
}

bool Clearance::Clear(const mjtNum* qpos) {
  bool within = true;
  for (size_t i = 0; i < balls_.size() && within; ++i) {
    if (balls_[i].position >= 0) within = Within(i, qpos + balls_[i].position);
  }
  if (within && free_way_ > 0) return true;
  for (size_t i = 0; i < balls_.size(); ++i) {
    const Ball& ball = balls_[i];
    mju_copy3(reference_.data() + 3 * i, ball.position < 0 ? ball.center_w : qpos + ball.position);
  }
  free_way_ = Gap();
  return free_way_ > 0;
}

bool Clearance::ClearAfter(const mjModel* m, const mjData* d, mjtNum time, mjtNum scale) const {
  for (size_t i = 0; i < balls_.size(); ++i) {
    const Ball& ball = balls_[i];
    if (ball.position < 0) continue;
    const mjtNum* position = d->qpos + ball.position;
    const mjtNum* velocity = d->qvel + ball.velocity;
    const mjtNum* acceleration = d->qacc + ball.velocity;
    mjtNum center[3];
    for (int k = 0; k < 3; ++k) {
      center[k] = position[k] + time * (velocity[k] + scale * acceleration[k]);
    }
    if (!Within(i, center)) return false;
  }
  return true;
}

bool Clearance::ClearAt(const mjData* d) const {
  for (size_t i = 0; i < balls_.size(); ++i) {
    if (balls_[i].position >= 0 && !Within(i, d->xpos + 3 * balls_[i].body)) return false;
  }
  return true;
}

}  // namespace fluid_sim
