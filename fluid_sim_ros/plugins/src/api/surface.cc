// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The free surface, and the ends of the grids.

#include <mujoco/mujoco.h>

#include "api/api.h"
#include "assembly/assembly.h"

using namespace fluid_sim;

// Heights of the free surface, world z [m], over n points (world x y) at the data's time. Returns
// 0 for a model without one (heights stay as they are), 1 for a level surface, 2 for waves.
FSR_API int fsr_surface(const mjModel* m, const mjData* d, const double* points, int n,
                        double* heights) {
  const Assembly* assembly = FindAssembly(m, d);
  if (!assembly || !assembly->medium.in_charge() || !assembly->medium.has_surface) return 0;
  for (int i = 0; i < n; ++i) {
    const mjtNum point_w[3] = {points[2 * i], points[2 * i + 1], 0};
    heights[i] = SurfaceHeight(assembly->medium, d, point_w);
  }
  return assembly->medium.waves.any() ? 2 : 1;
}

// How far a vehicle's origin and the data's time lie beyond the grids that it meets: out[0..3] of
// the current's t, x, y, z [s], [m], out[4..7] of the wind's; 0 where covered, held or not met.
// Returns 1 if any is not 0.
FSR_API int fsr_beyond_grids(const mjModel* m, const mjData* d, const double* point_w,
                             double* out) {
  mju_zero(out, 2 * kGridAxes);
  const Assembly* assembly = FindAssembly(m, d);
  if (!assembly || !assembly->medium.in_charge()) return 0;
  const Medium& medium = assembly->medium;
  const bool above = medium.has_surface && point_w[2] > SurfaceHeight(medium, d, point_w);
  if (medium.current_grid.any() && !above) {
    BeyondGrid(medium.current_grid, m, d->time, point_w, out);
  }
  if (medium.wind_grid.any() && (above || !medium.has_surface)) {
    BeyondGrid(medium.wind_grid, m, d->time, point_w, out + kGridAxes);
  }
  bool any = false;
  for (int i = 0; i < 2 * kGridAxes; ++i) any |= out[i] != 0;
  return any;
}
