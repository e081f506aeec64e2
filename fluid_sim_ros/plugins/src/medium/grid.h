// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// A measured or computed flow on a rectilinear grid, u(t, x, y, z), linear in each between its
// points. numpy twin: physics/grid.py.

#ifndef FLUID_SIM_MEDIUM_GRID_H_
#define FLUID_SIM_MEDIUM_GRID_H_

#include <mujoco/mujoco.h>

#include "medium/flow_sample.h"
#include "shared/config.h"

namespace fluid_sim {

constexpr int kGridAxes = 4;  // t, x, y, z

// The numbers stay in the model (<custom><numeric>): how many points each axis has, the axes' own
// values [s], [m], then the velocities [m/s], z fastest, three for each point.
struct Grid {
  int size[kGridAxes] = {0, 0, 0, 0};
  int axis[kGridAxes] = {0, 0, 0, 0};  // addresses in numeric_data
  int data = -1;                       // likewise; < 0: no grid

  bool any() const { return data >= 0; }
};

// The grid in the numeric that the key names; false after one line of explanation.
bool ReadGrid(const Config& config, const mjModel* m, const char* key, Grid* grid);

// Add the flow at a world point and time. Beyond an end of an axis the value at the end holds; an
// axis of one point holds everywhere. At a grid point the slopes are those of the cell above.
void AddGrid(const Grid& grid, const mjModel* m, mjtNum time, const mjtNum point_w[3],
             FlowSample* flow);

// How far a time and a point lie beyond the ends of t, x, y, z (0: covered; below, negative).
void BeyondGrid(const Grid& grid, const mjModel* m, mjtNum time, const mjtNum point_w[3],
                mjtNum beyond[kGridAxes]);

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_GRID_H_
