// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Coloured noise on a fixed tick: linear filters of white noise, discretised exactly.
//
// The samples at the ticks have the covariance of the continuous process; between them a cubic
// through four of them gives a value with an exact derivative. So the same seed gives the same
// signal whatever the timestep. The state is [latest tick, present time, outputs and derivatives
// then, filter states, last samples]: it lives in plugin_state and is all that the future depends
// on. The present is kept because the bodies of a vehicle ask for it one after another.

#ifndef FLUID_SIM_MEDIUM_COLOURED_NOISE_H_
#define FLUID_SIM_MEDIUM_COLOURED_NOISE_H_

#include <mujoco/mujoco.h>

#include <cstdint>

#include "shared/config.h"

namespace fluid_sim {

// x' = A x + b n(t) with white noise n of unit intensity, over one tick:
// x+ = phi x + root N with standard normal N; the first x is start N.
struct Filter {
  int size = 0;  // 1 to 3 states
  mjtNum phi[9], root[9], start[9];
  int output[2] = {-1, -1};  // which outputs it adds to, -1: none
  mjtNum weight[2][3];       // what of x it adds
};

constexpr int kMostFilters = 13, kMostStates = 32, kMostOutputs = 6;

struct ColouredNoise {
  mjtNum tick = 0;  // [s]
  int count = 0;    // of filters
  Filter filter[kMostFilters];
  int states = 0, outputs = 0;  // outputs: 3 or 6

  int StateSize() const;
};

// Samples that the state holds: four around any time of the next step, up to one tick long, and
// the rounding of the time.
constexpr int kSamples = 6;

// Size of the state of a noise with so many filter states and outputs.
constexpr int NoiseStateSize(int states, int outputs) {
  return 2 + states + (2 + kSamples) * outputs;
}

// Ticks that one step may take: a shorter tick would make every step as long as its number says.
constexpr mjtNum kMostTicksPerStep = 1000;

// The tick is long enough for steps of this size [s]; false after one line that names `key`.
bool CheckTick(const Config& config, const char* key, const ColouredNoise& noise, mjtNum timestep);

// A time constant [s] that can be discretised on the noise's tick; in words: kSuitable.
bool SuitsTick(const ColouredNoise& noise, mjtNum time_constant);
constexpr char kSuitable[] = "a time constant [s] of 1e-6 to 1e9 ticks";

// Add a filter x' = A x + b n of `size` states; its outputs and weights are the caller's.
Filter* AddFilter(ColouredNoise* noise, int size, const mjtNum* a, const mjtNum* b);

// State at time 0, drawn from the stationary distribution.
void StartNoise(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream,
                mjtNum* state);

// Bring the state to a time, so that it holds what a step from there needs. Over a gap of more than
// a million ticks the noise starts anew there, from its stationary distribution; where no tick has
// a number of its own (beyond 2^53, or NaN) the last samples hold.
void AdvanceNoise(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream, mjtNum time,
                  mjtNum* state);

// Whether AdvanceNoise would draw.
bool NoiseIsDue(const ColouredNoise& noise, mjtNum time, const mjtNum* state);

// Outputs at a time and their derivatives. A time beyond the held samples is reached on a copy;
// before them the oldest ones hold.
void SampleNoise(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream, mjtNum time,
                 const mjtNum* state, mjtNum* value, mjtNum* rate);

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_COLOURED_NOISE_H_
