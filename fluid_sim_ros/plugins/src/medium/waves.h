// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Linear (Airy) waves on the free surface: a sum of plane waves, for deep and finite depth.
//
// theta = k.x - omega t + phase; eta = sum a cos(theta). Dean and Dalrymple (1991), Water Wave
// Mechanics for Engineers and Scientists, ch. 3. numpy twin: physics/waves.py.

#ifndef FLUID_SIM_MEDIUM_WAVES_H_
#define FLUID_SIM_MEDIUM_WAVES_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "medium/flow_sample.h"
#include "shared/config.h"

namespace fluid_sim {

struct WaveComponent {
  mjtNum amplitude;     // a [m]
  mjtNum omega;         // [rad/s]
  mjtNum wavenumber;    // k [rad/m]
  mjtNum direction[2];  // of travel, unit, world x y
  mjtNum phase;         // [rad]
  mjtNum floor;         // e^(-2 k depth), 0 where the water counts as deep
};

// The surface over one point of the plane.
struct WaveSurface {
  mjtNum height = 0;                // eta above the mean level [m]
  mjtNum slope[2] = {0, 0};         // (d/dx, d/dy) eta [-]
  mjtNum rate = 0;                  // d eta/dt [m/s]
  mjtNum slope_rate[2] = {0, 0};    // [1/s]
  mjtNum curvature[3] = {0, 0, 0};  // xx, xy, yy [1/m]
};

struct Waves {
  std::vector<WaveComponent> components;  // none: still water
  mjtNum level = 0;                       // mean surface, world z [m]
  mjtNum depth = mjMAXVAL;                // of the bed below it [m]
  mjtNum repeat = 0;                      // period of the whole sea [s]
  mjtNum reach = 0;                       // sum of a: eta never goes further [m]
  mjtNum tilt = 1;                        // sqrt(1 + (sum of a k)^2): normals never lean further

  bool any() const { return !components.empty(); }
};

// Read the keys waves, wave_* and water_depth; false after one line of explanation.
bool ReadWaves(const Config& config, const mjModel* m, bool has_surface, mjtNum level,
               Waves* waves);

// Height of the surface over a point, world z [m].
mjtNum WaveHeight(const Waves& waves, mjtNum time, const mjtNum point_w[3]);

// The surface over a point with its derivatives.
WaveSurface WaveSurfaceAt(const Waves& waves, mjtNum time, const mjtNum point_w[3]);

// Add the flow under the waves. Above the mean level along the tangents at it (linear
// extrapolation; Rodenbusch and Forristall 1986), below the bed as at the bed.
void AddWaves(const Waves& waves, mjtNum time, const mjtNum point_w[3], FlowSample* flow);

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_WAVES_H_
