// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// A wind or a current: (mean + signals + Gauss-Markov process) times a profile over the height.
//
// The mean follows a run-time target at a limited rate, in closed form, so that its time
// derivative is exact and the state is a pure function of time between two changes of the target.

#ifndef FLUID_SIM_MEDIUM_STREAM_H_
#define FLUID_SIM_MEDIUM_STREAM_H_

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "medium/coloured_noise.h"
#include "medium/flow_sample.h"
#include "medium/profile.h"
#include "medium/signal.h"
#include "shared/config.h"

namespace fluid_sim {

// A run-time velocity in plugin_state: it leaves `start` at `start_time` towards `target`.
enum StreamState { kTarget = 0, kStart = 3, kStartTime = 6, kStreamState = 7 };

struct Stream {
  mjtNum initial[3] = {0, 0, 0};  // [m/s]
  mjtNum slew = 1;                // [m/s^2]; 0: no limit, a change is a step
  mjtNum datum = 0;               // world z from which the profile counts its height [m]
  Profile profile;
  std::vector<Signal> signals;
  Series series;
  ColouredNoise noise;  // 3 outputs [m/s]; without filters: none

  // Nothing but the mean.
  bool mean_only() const { return signals.empty() && series.times.empty() && !noise.count; }
};

// Read the keys NAME and NAME_*; false after one line of explanation.
bool ReadStream(const Config& config, const std::string& name, mjtNum timestep, Stream* stream);

// Numbers in plugin_state for the Gauss-Markov process, from the keys alone.
int StreamNoiseSize(const Config& config, const std::string& name);

// Where a stream's numbers are, and who draws its noise.
struct StreamDrive {
  const mjtNum* mean;   // kStreamState numbers
  const mjtNum* noise;  // of ColouredNoise
  std::uint64_t seed, id;
  bool on;  // signals and noise act
};

// Add the stream at the time and the height z to the flow.
void AddStream(const Stream& stream, const StreamDrive& drive, mjtNum time, mjtNum z,
               FlowSample* flow);

// Run-time velocity at a time and its derivative [m/s], [m/s^2].
void StreamVelocity(const Stream& stream, const mjtNum* state, mjtNum time, mjtNum velocity[3],
                    mjtNum derivative[3]);

// Let the stream move from its present velocity to `target`.
void SetTarget(const Stream& stream, mjtNum* state, mjtNum time, const mjtNum target[3]);

// State at the start: the configured velocity, reached long ago.
void ResetStream(const Stream& stream, mjtNum* state);

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_STREAM_H_
