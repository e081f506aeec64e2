#include "stream.h"

#include <algorithm>
#include <limits>

namespace fluid_sim {
namespace {

constexpr mjtNum kInfinity = std::numeric_limits<mjtNum>::infinity();

}  // namespace

bool ReadStream(const Config& config, const std::string& name, Stream* stream) {
  const std::string slew = name + "_slew", profile = name + "_profile", datum = name + "_datum";
  std::vector<mjtNum> numbers;
  if (!config.Numbers(name.c_str(), {3}, "3 numbers [m/s]", &numbers)) return false;
  if (!numbers.empty()) mju_copy3(stream->initial, numbers.data());
  return config.Number(slew.c_str(), 0, kInfinity, "a number >= 0 [m/s^2] (0: no limit)",
                       &stream->slew) &&
         config.Number(datum.c_str(), -kInfinity, kInfinity, "a height in world z [m]",
                       &stream->datum) &&
         stream->profile.Parse(config, profile.c_str());
}

// u = U(t) f(z - datum), du/dt = U' f, du/dz = U f'
void AddStream(const Stream& stream, const mjtNum* state, mjtNum time, mjtNum z, FlowSample* flow) {
  mjtNum velocity[3], derivative[3];
  StreamVelocity(stream, state, time, velocity, derivative);
  const ProfileValue profile = stream.profile.At(z - stream.datum);
  mju_addToScl3(flow->velocity, velocity, profile.factor);
  mju_addToScl3(flow->rate, derivative, profile.factor);
  for (int i = 0; i < 3; ++i) flow->gradient[3 * i + 2] += velocity[i] * profile.slope;
}

void StreamVelocity(const Stream& stream, const mjtNum* state, mjtNum time, mjtNum velocity[3],
                    mjtNum derivative[3]) {
  mjtNum way[3];
  mju_sub3(way, state + kTarget, state + kStart);
  const mjtNum distance = mju_norm3(way);
  const mjtNum elapsed = std::max<mjtNum>(time - state[kStartTime], 0);
  mju_zero3(derivative);
  if (distance <= 0 || stream.slew <= 0 || elapsed * stream.slew >= distance) {
    mju_copy3(velocity, state + kTarget);
    return;
  }
  mju_scl3(derivative, way, stream.slew / distance);
  mju_copy3(velocity, state + kStart);
  mju_addToScl3(velocity, derivative, elapsed);
}

void SetTarget(const Stream& stream, mjtNum* state, mjtNum time, const mjtNum target[3]) {
  if (mju_dist3(state + kTarget, target) == 0) return;  // set again: keep going the same way
  mjtNum velocity[3], derivative[3];
  StreamVelocity(stream, state, time, velocity, derivative);
  mju_copy3(state + kStart, velocity);
  mju_copy3(state + kTarget, target);
  state[kStartTime] = time;
}

void ResetStream(const Stream& stream, mjtNum* state) {
  mju_copy3(state + kTarget, stream.initial);
  mju_copy3(state + kStart, stream.initial);
  state[kStartTime] = 0;
}

}  // namespace fluid_sim
