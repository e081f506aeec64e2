// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "medium/stream.h"

#include <algorithm>
#include <cmath>

#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

constexpr int kAxes = 3;

// sigma^2 exp(-|t|/T) per axis: x' = -x/T + sqrt(2/T) n.
bool ReadGaussMarkov(const Config& config, const std::string& name, mjtNum timestep,
                     ColouredNoise* noise) {
  const std::string key = name + "_gauss_markov", tick = name + "_tick";
  const char* allowed = "SX SY SZ TIME (>= 0 [m/s], TIME > 0 [s])";
  std::vector<mjtNum> numbers;
  noise->tick = 0.1;
  noise->outputs = kAxes;
  if (!config.Numbers(key.c_str(), {4}, allowed, &numbers) ||
      !config.Number(tick.c_str(), mjMINVAL, kInfinity, "a number > 0 [s]", &noise->tick)) {
    return false;
  }
  if (numbers.empty()) return true;
  if (*std::min_element(numbers.begin(), numbers.end()) < 0 || numbers[3] <= 0) {
    return config.Refuse(key.c_str(), allowed);
  }
  if (!CheckTick(config, tick.c_str(), *noise, timestep)) return false;
  if (!SuitsTick(*noise, numbers[3])) return config.Refuse(key.c_str(), kSuitable);
  const mjtNum a[1] = {-1 / numbers[3]}, b[1] = {std::sqrt(2 / numbers[3])};
  for (int i = 0; i < kAxes; ++i) {
    Filter* f = AddFilter(noise, 1, a, b);
    f->output[0] = i;
    f->weight[0][0] = numbers[i];
  }
  return true;
}

}  // namespace

bool ReadStream(const Config& config, const std::string& name, mjtNum timestep, Stream* stream) {
  const std::string slew = name + "_slew", profile = name + "_profile", datum = name + "_datum";
  std::vector<mjtNum> numbers;
  if (!config.Numbers(name.c_str(), {3}, "3 numbers [m/s]", &numbers)) return false;
  if (!numbers.empty()) Copy3(stream->initial, numbers.data());
  return config.Number(slew.c_str(), 0, kInfinity, "a number >= 0 [m/s^2] (0: no limit)",
                       &stream->slew) &&
         config.Number(datum.c_str(), -kInfinity, kInfinity, "a height in world z [m]",
                       &stream->datum) &&
         stream->profile.Parse(config, profile.c_str()) &&
         ReadSignals(config, (name + "_signal").c_str(), &stream->signals) &&
         ReadSeries(config, (name + "_series").c_str(), &stream->series) &&
         ReadGaussMarkov(config, name, timestep, &stream->noise);
}

int StreamNoiseSize(const Config& config, const std::string& name) {
  return config.Has((name + "_gauss_markov").c_str()) ? NoiseStateSize(kAxes, kAxes) : 0;
}

// u = U(t) f(z - datum), du/dt = U' f, du/dz = U f'
void AddStream(const Stream& stream, const StreamDrive& drive, mjtNum time, mjtNum z,
               FlowSample* flow) {
  if (stream.mean_only() && IsZero3(drive.mean + kTarget) && IsZero3(drive.mean + kStart)) return;
  mjtNum velocity[3], derivative[3];
  StreamVelocity(stream, drive.mean, time, velocity, derivative);
  if (drive.on) {
    for (const Signal& signal : stream.signals) AddSignal(signal, time, velocity, derivative);
    AddSeries(stream.series, time, velocity, derivative);
    if (stream.noise.count) {
      mjtNum value[kAxes], rate[kAxes];
      SampleNoise(stream.noise, drive.seed, drive.id, time, drive.noise, value, rate);
      AddTo3(velocity, value);
      AddTo3(derivative, rate);
    }
  }
  const ProfileValue profile = stream.profile.At(z - stream.datum);
  AddScaled3(flow->velocity, velocity, profile.factor);
  AddScaled3(flow->rate, derivative, profile.factor);
  for (int i = 0; i < 3; ++i) flow->gradient[3 * i + 2] += velocity[i] * profile.slope;
}

void StreamVelocity(const Stream& stream, const mjtNum* state, mjtNum time, mjtNum velocity[3],
                    mjtNum derivative[3]) {
  mjtNum way[3];
  const mjtNum elapsed = std::max<mjtNum>(time - state[kStartTime], 0);
  for (int i = 0; i < 3; ++i) {
    velocity[i] = state[kTarget + i];
    derivative[i] = 0;
    way[i] = velocity[i] - state[kStart + i];
  }
  const mjtNum square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
  if (square <= 0 || stream.slew <= 0) return;
  const mjtNum distance = std::sqrt(square);
  if (elapsed * stream.slew >= distance) return;
  Scale3(derivative, way, stream.slew / distance);
  Copy3(velocity, state + kStart);
  AddScaled3(velocity, derivative, elapsed);
}

void SetTarget(const Stream& stream, mjtNum* state, mjtNum time, const mjtNum target[3]) {
  if (mju_dist3(state + kTarget, target) == 0) return;  // set again: keep going the same way
  mjtNum velocity[3], derivative[3];
  StreamVelocity(stream, state, time, velocity, derivative);
  Copy3(state + kStart, velocity);
  Copy3(state + kTarget, target);
  state[kStartTime] = time;
}

void ResetStream(const Stream& stream, mjtNum* state) {
  Copy3(state + kTarget, stream.initial);
  Copy3(state + kStart, stream.initial);
  state[kStartTime] = 0;
}

}  // namespace fluid_sim
