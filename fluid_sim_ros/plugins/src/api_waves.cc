// C function for Python (bound in plugins/native.py): the free surface over points.

#include <mujoco/mujoco.h>

#include "assembly.h"

#define FSR_API extern "C" __attribute__((visibility("default")))

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
