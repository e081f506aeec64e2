// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Wrench per term that stock MuJoCo's passive stage applies to one body, about any point.

#ifndef FLUID_SIM_BODY_STOCK_TERMS_H_
#define FLUID_SIM_BODY_STOCK_TERMS_H_

#include <mujoco/mujoco.h>

#include "shared/terms.h"

namespace fluid_sim {

// What stock forces are relative to: a velocity, and a rotation of the air that drag, viscosity and
// Magnus force see (MuJoCo itself knows none), world axes [m/s], [rad/s].
struct StockWind {
  const mjtNum* velocity;
  const mjtNum* spin;
};

// MuJoCo's own fluid forces act on the body: there is a fluid in opt, the body has mass, and its
// passive forces are on.
bool StockActs(const mjModel* m, int body);

// A geom of the body has fluidshape="ellipsoid"; without one MuJoCo takes the inertia box.
bool HasEllipsoidGeom(const mjModel* m, int body);

// Add the terms of `body` in a wind to terms[kTermCount], in world axes, torques about `point_w`.
// `d` must hold the positions and velocities of the state in question (mj_forward or the like).
void AddStockTerms(const mjModel* m, const mjData* d, int body, const StockWind& wind,
                   const mjtNum point_w[3], Wrench terms[kTermCount]);

// Add a wrench given at `origin_w` in the frame `rotation` (row major, local to world).
void AddLocalWrench(const Wrench& local, const mjtNum* rotation, const mjtNum origin_w[3],
                    const mjtNum point_w[3], mjtNum scale, Wrench* target_w);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_STOCK_TERMS_H_
