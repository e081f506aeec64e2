// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "medium/coloured_noise.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "medium/noise.h"

namespace fluid_sim {
namespace {

// Order of the Taylor series of exp(A s) and b, on a step short against every time constant.
constexpr int kTaylor = 8;
constexpr mjtNum kShort = 1e-2;
constexpr int kMostDoublings = 100;   // 2^100 ticks: more than any suitable time constant has
constexpr mjtNum kMostGap = 1e6;      // ticks that are drawn one after the other
constexpr mjtNum kMostAhead = 1e4;    // and for a look ahead, which keeps none; a step has 1e3
constexpr mjtNum kMostTick = 0x1p53;  // the last that has a number of its own
// Gauss-Legendre rule of five points on [0, 1] (exact to degree 9); Abramowitz and Stegun 25.4.30.
constexpr mjtNum kNode[5] = {0.046910077030668, 0.2307653449471585, 0.5, 0.7692346550528415,
                             0.953089922969332};
constexpr mjtNum kShare[5] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                              0.23931433524968324, 0.11846344252809454};

// out = exp(A s) x for a short s.
void ExpTimes(const mjtNum* a, int n, mjtNum s, const mjtNum* x, mjtNum* out) {
  mjtNum term[3], next[3];
  mju_copy(out, x, n);
  mju_copy(term, x, n);
  for (int k = 1; k <= kTaylor; ++k) {
    mju_mulMatVec(next, a, term, n, n);
    mju_scl(term, next, s / k, n);
    mju_addTo(out, term, n);
  }
}

// Q(2 h) = Q(h) + phi Q(h) phi', phi(2 h) = phi^2.
void Double(int n, mjtNum* phi, mjtNum* q) {
  mjtNum left[9], carried[9], squared[9];
  mju_mulMatMat(left, phi, q, n, n, n);
  mju_mulMatMatT(carried, left, phi, n, n, n);
  mju_addTo(q, carried, n * n);
  mju_mulMatMat(squared, phi, phi, n, n, n);
  mju_copy(phi, squared, n * n);
}

// Lower triangular root of a covariance. The filters are cascades: the scaled matrix is well
// conditioned however short the tick.
void Cholesky(int n, const mjtNum* q, mjtNum* root) {
  mju_zero(root, n * n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      mjtNum rest = q[n * i + j];
      for (int k = 0; k < j; ++k) rest -= root[n * i + k] * root[n * j + k];
      root[n * i + j] = i == j ? std::sqrt(std::max<mjtNum>(rest, 0))
                               : (root[n * j + j] > 0 ? rest / root[n * j + j] : 0);
    }
  }
}

// A number of doublings, for NaN 0.
int Count(mjtNum number) {
  return number > 0 ? static_cast<int>(std::min<mjtNum>(number, kMostDoublings)) : 0;
}

// exp(A tick), the covariance of what the noise brings in one tick, and the stationary one
// (Van Loan 1978 by doubling: every sum is of terms of one sign on the diagonal).
void Discretise(const mjtNum* a, const mjtNum* b, mjtNum tick, Filter* f) {
  const int n = f->size;
  mjtNum fastest = 0;
  for (int i = 0; i < n * n; ++i) fastest = std::max(fastest, std::abs(a[i]));
  const int doublings = Count(std::ceil(std::log2(fastest * tick / kShort)));
  const mjtNum step = std::ldexp(tick, -doublings);
  mjtNum q[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
  for (int point = 0; point < 5; ++point) {
    mjtNum g[3];
    ExpTimes(a, n, kNode[point] * step, b, g);
    for (int i = 0; i < n * n; ++i) q[i] += kShare[point] * step * g[i / n] * g[i % n];
  }
  for (int column = 0; column < n; ++column) {
    mjtNum unit[3] = {0, 0, 0}, image[3];
    unit[column] = 1;
    ExpTimes(a, n, step, unit, image);
    for (int row = 0; row < n; ++row) f->phi[n * row + column] = image[row];
  }
  for (int i = 0; i < doublings; ++i) Double(n, f->phi, q);
  Cholesky(n, q, f->root);
  mjtNum phi[9];
  mju_copy(phi, f->phi, n * n);
  for (int i = 0; i < kMostDoublings && mju_norm(phi, n * n) > 1e-30; ++i) Double(n, phi, q);
  Cholesky(n, q, f->start);
}

constexpr int kPresent = 1;  // address of the present time, followed by outputs and derivatives

struct Layout {
  mjtNum* tick;
  mjtNum* x;
  mjtNum* samples;  // kSamples rows of outputs, oldest first
};

Layout Parts(const ColouredNoise& noise, mjtNum* state) {
  mjtNum* x = state + kPresent + 1 + 2 * noise.outputs;
  return {state, x, x + noise.states};
}

// Shift the samples and append the outputs of x.
void Append(const ColouredNoise& noise, const Layout& at) {
  const int width = noise.outputs;
  std::copy(at.samples + width, at.samples + kSamples * width, at.samples);
  mjtNum* out = at.samples + (kSamples - 1) * width;
  mju_zero(out, width);
  const mjtNum* x = at.x;
  for (int i = 0; i < noise.count; ++i) {
    const Filter& f = noise.filter[i];
    for (int k = 0; k < 2; ++k) {
      if (f.output[k] >= 0) out[f.output[k]] += mju_dot(f.weight[k], x, f.size);
    }
    x += f.size;
  }
}

// One tick on; ticks count from -1, so that the noise of tick k has index k + 1.
void Tick(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream, const Layout& at) {
  mjtNum normal[kMostStates];
  *at.tick += 1;
  Gaussians(seed, stream, static_cast<std::uint64_t>(*at.tick + 1), noise.states, normal);
  mjtNum* x = at.x;
  const mjtNum* n = normal;
  for (int i = 0; i < noise.count; ++i) {
    const Filter& f = noise.filter[i];
    mjtNum moved[3], kick[3];
    mju_mulMatVec(moved, f.phi, x, f.size, f.size);
    mju_mulMatVec(kick, f.root, n, f.size, f.size);
    mju_add(x, moved, kick, f.size);
    x += f.size;
    n += f.size;
  }
  Append(noise, at);
}

// The latest tick that a step from `time` needs.
mjtNum Needed(const ColouredNoise& noise, mjtNum time) {
  return std::floor(time / noise.tick + 0.5) + 3;
}

// value = sum of w times the rows, rate = sum of v times the rows; the width is 3 or 6.
template <int kWidth>
void Combine(const mjtNum* row, const mjtNum w[4], const mjtNum v[4], mjtNum* value, mjtNum* rate) {
  for (int i = 0; i < kWidth; ++i) {
    const mjtNum a = row[i], b = row[kWidth + i], c = row[2 * kWidth + i], e = row[3 * kWidth + i];
    value[i] = w[0] * a + w[1] * b + w[2] * c + w[3] * e;
    rate[i] = v[0] * a + v[1] * b + v[2] * c + v[3] * e;
  }
}

// x drawn from the stationary distribution at a tick from -1 on, and its outputs as the one sample.
void Begin(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream, mjtNum tick,
           const Layout& at) {
  mjtNum normal[kMostStates];
  Gaussians(seed, stream, static_cast<std::uint64_t>(tick + 1), noise.states, normal);
  mjtNum* x = at.x;
  const mjtNum* n = normal;
  for (int i = 0; i < noise.count; ++i) {
    const Filter& f = noise.filter[i];
    mju_mulMatVec(x, f.start, n, f.size, f.size);
    x += f.size;
    n += f.size;
  }
  *at.tick = tick;
  mju_zero(at.samples, kSamples * noise.outputs);
  Append(noise, at);
}

// Draw up to a tick, anew where it is more than `most` ticks away. Nothing is drawn for a tick
// without a number of its own.
void Reach(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream, mjtNum tick,
           mjtNum most, const Layout& at) {
  if (!(tick >= -1 && tick <= kMostTick)) return;
  if (!(*at.tick >= -1 && tick - *at.tick <= most)) {
    Begin(noise, seed, stream, std::max<mjtNum>(tick - kSamples, -1), at);
  }
  while (*at.tick < tick) Tick(noise, seed, stream, at);
}

// The cubic at a time.
void Interpolate(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream, mjtNum time,
                 const mjtNum* state, mjtNum* value, mjtNum* rate) {
  const mjtNum ticks = time / noise.tick;
  mjtNum before = std::floor(ticks);  // the cubic lies between this tick and the next
  mjtNum copy[NoiseStateSize(kMostStates, kMostOutputs)];
  if (before + 2 > state[0]) {
    mju_copy(copy, state, noise.StateSize());
    const Layout at = Parts(noise, copy);
    Reach(noise, seed, stream, before + 2, kMostAhead, at);
    state = copy;
  }
  mjtNum s = ticks - before;
  const mjtNum oldest = state[0] - kSamples + 1;
  mjtNum first = before - 1 - oldest;            // of the four samples
  if (!(first >= 0 && first <= kSamples - 4)) {  // beyond what is held, or NaN
    first = first > 0 ? kSamples - 4 : 0;
    s = first > 0 ? 1 : 0;
  }
  // Catmull-Rom: a cubic with the slopes (next - previous)/2 at both ends
  const mjtNum s2 = s * s, s3 = s2 * s;
  const mjtNum w[4] = {0.5 * (2 * s2 - s - s3), 0.5 * (3 * s3 - 5 * s2 + 2),
                       0.5 * (4 * s2 - 3 * s3 + s), 0.5 * (s3 - s2)};
  const mjtNum r = 0.5 / noise.tick;
  const mjtNum v[4] = {r * (4 * s - 1 - 3 * s2), r * (9 * s2 - 10 * s), r * (8 * s - 9 * s2 + 1),
                       r * (3 * s2 - 2 * s)};
  const mjtNum* p = state + NoiseStateSize(noise.states, noise.outputs) - kSamples * noise.outputs +
                    static_cast<int>(first) * noise.outputs;
  (noise.outputs == 3 ? Combine<3> : Combine<6>)(p, w, v, value, rate);
}

// Keep what holds at a time.
void SetPresent(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream, mjtNum time,
                mjtNum* state) {
  mjtNum* present = state + kPresent;
  Interpolate(noise, seed, stream, time, state, present + 1, present + 1 + noise.outputs);
  present[0] = time;
}

}  // namespace

bool CheckTick(const Config& config, const char* key, const ColouredNoise& noise, mjtNum timestep) {
  if (noise.tick * kMostTicksPerStep >= timestep) return true;
  return config.Refuse(
      key, "at least a thousandth of the timestep, " + std::to_string(timestep) + " [s]");
}

bool SuitsTick(const ColouredNoise& noise, mjtNum time_constant) {
  return time_constant >= 1e-6 * noise.tick && time_constant <= 1e9 * noise.tick;
}

int ColouredNoise::StateSize() const { return NoiseStateSize(states, outputs); }

Filter* AddFilter(ColouredNoise* noise, int size, const mjtNum* a, const mjtNum* b) {
  Filter* f = &noise->filter[noise->count++];
  f->size = size;
  noise->states += size;
  Discretise(a, b, noise->tick, f);
  return f;
}

void StartNoise(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream,
                mjtNum* state) {
  const Layout at = Parts(noise, state);
  Begin(noise, seed, stream, -1, at);
  Reach(noise, seed, stream, Needed(noise, 0), kMostGap, at);
  SetPresent(noise, seed, stream, 0, state);
}

bool NoiseIsDue(const ColouredNoise& noise, mjtNum time, const mjtNum* state) {
  return state[0] != Needed(noise, time);
}

void AdvanceNoise(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream, mjtNum time,
                  mjtNum* state) {
  const Layout at = Parts(noise, state);
  const mjtNum needed = Needed(noise, time);
  if (needed < *at.tick) StartNoise(noise, seed, stream, state);  // the time went back
  Reach(noise, seed, stream, needed, kMostGap, at);
  SetPresent(noise, seed, stream, time, state);
}

void SampleNoise(const ColouredNoise& noise, std::uint64_t seed, std::uint64_t stream, mjtNum time,
                 const mjtNum* state, mjtNum* value, mjtNum* rate) {
  const mjtNum* present = state + kPresent;
  if (time != present[0]) return Interpolate(noise, seed, stream, time, state, value, rate);
  for (int i = 0; i < noise.outputs; ++i) {
    value[i] = present[1 + i];
    rate[i] = present[1 + noise.outputs + i];
  }
}

}  // namespace fluid_sim
