// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Whether any two geoms of a model can touch, from the positions of its trees alone.
//
// A tree (a free vehicle, a pendulum) lies in a ball about its first body, whatever its joints do.
// Where the balls of all trees are clear of the planes, boxes and balls of the world and of one
// another, MuJoCo finds no contact. Between two looks at all of them the movement of each ball is
// held against half the smallest gap.

#ifndef FLUID_SIM_LEAN_CLEARANCE_H_
#define FLUID_SIM_LEAN_CLEARANCE_H_

#include <mujoco/mujoco.h>

#include <vector>

namespace fluid_sim {

enum class Contacts {
  kNever,    // no two geoms may touch
  kWatched,  // where balls come near
  kAlways    // no bound: slides, geoms of one tree, moving worlds (mocap), <pair>s, flexes
};

// A colliding geom that does not move; its size holds its margin.
struct Obstacle {
  int type;  // mjGEOM_PLANE, mjGEOM_BOX, or mjGEOM_SPHERE for whatever else
  mjtNum position_w[3], rotation_w[9], size[3];
  int contype, conaffinity;
};

// The ball of a tree.
struct Ball {
  int position;              // address in qpos of its center, or -1: it does not move
  int velocity;              // address in qvel of the center's
  int body;                  // whose origin is the center
  mjtNum center_w[3];        // of one that does not move
  mjtNum radius;             // margins included
  int contype, conaffinity;  // of any of its geoms
};

class Clearance {
 public:
  // Of the model as it is; make another one when it was changed.
  explicit Clearance(const mjModel* m);

  Contacts contacts() const { return contacts_; }

  // No geoms touch at these positions, for certain. Not const: keeps what it measured.
  bool Clear(const mjtNum* qpos);

  // Nor with the free trees moved by `time` times qvel + scale * qacc. After Clear, for a stage.
  bool ClearAfter(const mjModel* m, const mjData* d, mjtNum time, mjtNum scale) const;

  // Nor where d->xpos has the trees. After Clear.
  bool ClearAt(const mjData* d) const;

 private:
  void Bound(const mjModel* m);
  bool AddBall(const mjModel* m, int tree, const std::vector<int>& geoms);
  bool Within(size_t ball, const mjtNum* center) const;
  mjtNum Gap() const;

  Contacts contacts_ = Contacts::kNever;
  std::vector<Obstacle> obstacles_;
  std::vector<Ball> balls_;
  std::vector<mjtNum> reference_;  // centers at the last look at all of them
  mjtNum free_way_ = -1;           // that each center may go from there [m]
};

}  // namespace fluid_sim

#endif  // FLUID_SIM_LEAN_CLEARANCE_H_
