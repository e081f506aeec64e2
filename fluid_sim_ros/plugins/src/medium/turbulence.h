// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Continuous turbulence of Dryden or von Karman (MIL-F-8785C), a process of its own per vehicle.
//
// Axes: u along the direction in which the mean relative wind passes the vehicle, w up. The unit
// processes are coloured noise on a fixed tick; the intensity multiplies them by the height of the
// point. von Karman's spectra are a sum of Dryden's: (1 + y)^(-5/6) is a sum of 1/(a^2 + y), and
// its lateral form follows from the longitudinal one as Dryden's does.

#ifndef FLUID_SIM_MEDIUM_TURBULENCE_H_
#define FLUID_SIM_MEDIUM_TURBULENCE_H_

#include <mujoco/mujoco.h>

#include "medium/coloured_noise.h"
#include "medium/flow_sample.h"
#include "shared/config.h"

namespace fluid_sim {

struct Turbulence {
  enum Kind { kNone, kDryden, kVonKarman } kind = kNone;
  bool by_wind = false;         // intensity by wind_6m and exceedance, else sigma
  mjtNum wind_6m = 0;           // [m/s]
  int exceedance = 0;           // row of figure 7
  mjtNum sigma[3] = {0, 0, 0};  // of u, v, w [m/s]
  mjtNum length[3];             // of u, v, w [m]
  mjtNum airspeed = 0;          // turns lengths into times [m/s]
  mjtNum span = 0;              // for p, q, r [m]; 0: no angular rates
  mjtNum ground = 0;            // world z [m]
  bool follows = false;         // length and airspeed are those of the vehicle at each tick
  mjtNum axis[3] = {1, 0, 0};   // of u, horizontal unit vector
  ColouredNoise noise;          // of unit intensity, at `length` and `airspeed`
};

// Keys turbulence and turbulence_*; `wind` gives the axis unless turbulence_direction does.
bool ReadTurbulence(const Config& config, mjtNum timestep, const mjtNum wind[3],
                    Turbulence* turbulence);

// Numbers in plugin_state per vehicle, from the keys alone.
int TurbulenceStateSize(const Config& config);

// Key of a vehicle's noise: the FNV-1a hash of its name, so that the gusts of one do not depend on
// which others there are; its number where it has none.
std::uint64_t NoiseStream(const char* name, int vehicle);

// State of one vehicle at time 0; `stream` is the key of its noise.
void StartTurbulence(const Turbulence& turbulence, std::uint64_t seed, std::uint64_t stream,
                     mjtNum* state);

// A vehicle that turbulence follows: height above ground [m], airspeed [m/s].
struct Followed {
  mjtNum height, airspeed;
};

// Bring it to a time; `vehicle_at` is read where it follows.
void AdvanceTurbulence(const Turbulence& turbulence, std::uint64_t seed, std::uint64_t stream,
                       mjtNum time, const Followed& vehicle_at, mjtNum* state);

// Add what the vehicle meets at a point; `arm_w` leads there from the vehicle's origin.
void AddTurbulence(const Turbulence& turbulence, std::uint64_t seed, std::uint64_t stream,
                   mjtNum time, mjtNum z, const mjtNum arm_w[3], const mjtNum* state,
                   FlowSample* flow);

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_TURBULENCE_H_
