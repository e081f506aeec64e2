// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Known functions of time that a wind or a current adds to its mean, with exact derivatives.

#ifndef FLUID_SIM_MEDIUM_SIGNAL_H_
#define FLUID_SIM_MEDIUM_SIGNAL_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "shared/config.h"

namespace fluid_sim {

// ramp:  A (t - start)/duration from 0 to 1
// sine:  A sin(2 pi t/period + phase)
// gust:  A (1 - cos(pi (t - start)/rise))/2, then A; with `hold` it falls again (MIL-F-8785C)
struct Signal {
  enum Kind { kRamp, kSine, kGust } kind;
  mjtNum amplitude[3];  // [m/s]
  mjtNum start = 0;     // of ramp and gust [s]
  mjtNum duration = 1;  // of the ramp or the gust's rise, period of the sine [s]
  mjtNum phase = 0;     // of the sine [rad]
  mjtNum hold = -1;     // of the gust [s]; < 0: it stays
};

// A time series: cubic Hermite between its rows, the outer values before and after (slope 0).
struct Series {
  std::vector<mjtNum> times;               // [s], rising
  std::vector<mjtNum> velocities, slopes;  // 3 per row [m/s], [m/s^2]
};

// Groups "ramp AX AY AZ START DURATION", "sine AX AY AZ PERIOD PHASE",
// "gust AX AY AZ START RISE [HOLD]"; false after one line of explanation.
bool ReadSignals(const Config& config, const char* key, std::vector<Signal>* signals);

// "t0 x0 y0 z0 t1 x1 y1 z1 ..."
bool ReadSeries(const Config& config, const char* key, Series* series);

// Add value and derivative at a time.
void AddSignal(const Signal& signal, mjtNum time, mjtNum velocity[3], mjtNum rate[3]);
void AddSeries(const Series& series, mjtNum time, mjtNum velocity[3], mjtNum rate[3]);

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_SIGNAL_H_
