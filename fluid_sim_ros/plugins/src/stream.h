// The mean wind or current: a run-time velocity U(t) times a profile over the height.
//
// U follows a target at a limited rate, in closed form, so that its time derivative is exact and
// the state is a pure function of time between two changes of the target.

#ifndef FLUID_SIM_STREAM_H_
#define FLUID_SIM_STREAM_H_

#include <mujoco/mujoco.h>

#include <string>

#include "config.h"
#include "flow_sample.h"
#include "profile.h"

namespace fluid_sim {

// A run-time velocity in plugin_state: it leaves `start` at `start_time` towards `target`.
enum StreamState { kTarget = 0, kStart = 3, kStartTime = 6, kStreamState = 7 };

struct Stream {
  mjtNum initial[3] = {0, 0, 0};  // [m/s]
  mjtNum slew = 1;                // [m/s^2]; 0: no limit, a change is a step
  mjtNum datum = 0;               // world z from which the profile counts its height [m]
  Profile profile;
};

// Read the keys NAME, NAME_slew, NAME_profile, NAME_datum; false after one line of explanation.
bool ReadStream(const Config& config, const std::string& name, Stream* stream);

// Add the stream at the time and the height z to the flow.
void AddStream(const Stream& stream, const mjtNum* state, mjtNum time, mjtNum z, FlowSample* flow);

// Run-time velocity at a time and its derivative [m/s], [m/s^2].
void StreamVelocity(const Stream& stream, const mjtNum* state, mjtNum time, mjtNum velocity[3],
                    mjtNum derivative[3]);

// Let the stream move from its present velocity to `target`.
void SetTarget(const Stream& stream, mjtNum* state, mjtNum time, const mjtNum target[3]);

// State at the start: the configured velocity, reached long ago.
void ResetStream(const Stream& stream, mjtNum* state);

}  // namespace fluid_sim

#endif  // FLUID_SIM_STREAM_H_
