// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "medium/waves.h"

#include <algorithm>
#include <cmath>

namespace fluid_sim {
namespace {

mjtNum Phase(const WaveComponent& wave, mjtNum time, const mjtNum point_w[3]) {
  const mjtNum way = wave.direction[0] * point_w[0] + wave.direction[1] * point_w[1];
  return wave.wavenumber * way - wave.omega * time + wave.phase;
}

// C = cosh k(z + h)/sinh k h, S = sinh k(z + h)/sinh k h and their slopes, without overflow.
struct Decay {
  mjtNum c, s, c_slope, s_slope;
};

Decay DecayAt(const WaveComponent& wave, mjtNum depth, mjtNum z) {
  const mjtNum k = wave.wavenumber, below = std::clamp<mjtNum>(z, -depth, 0);
  const mjtNum direct = below < 0 ? std::exp(k * below) : 1;
  const mjtNum above = std::max<mjtNum>(z, 0);
  Decay out{direct, direct, k * direct, k * direct};
  if (wave.floor > 0) {
    const mjtNum reflected = std::exp(-k * (below + 2 * depth)), scale = 1 / (1 - wave.floor);
    const mjtNum inside = z >= -depth ? k : 0;
    out.c = scale * (direct + reflected);
    out.s = scale * (direct - reflected);
    out.c_slope = inside * out.s;
    out.s_slope = inside * out.c;
  }
  out.c += above * out.c_slope;
  out.s += above * out.s_slope;
  return out;
}

}  // namespace

mjtNum WaveHeight(const Waves& waves, mjtNum time, const mjtNum point_w[3]) {
  mjtNum height = waves.level;
  for (const WaveComponent& wave : waves.components) {
    height += wave.amplitude * std::cos(Phase(wave, time, point_w));
  }
  return height;
}

WaveSurface WaveSurfaceAt(const Waves& waves, mjtNum time, const mjtNum point_w[3]) {
  WaveSurface out;
  for (const WaveComponent& wave : waves.components) {
    const mjtNum theta = Phase(wave, time, point_w);
    const mjtNum up = wave.amplitude * std::cos(theta), across = wave.amplitude * std::sin(theta);
    const mjtNum k[2] = {wave.wavenumber * wave.direction[0], wave.wavenumber * wave.direction[1]};
    out.height += up;
    out.rate += across * wave.omega;
    for (int i = 0; i < 2; ++i) {
      out.slope[i] -= across * k[i];
      out.slope_rate[i] += up * wave.omega * k[i];
    }
    out.curvature[0] -= up * k[0] * k[0];
    out.curvature[1] -= up * k[0] * k[1];
    out.curvature[2] -= up * k[1] * k[1];
  }
  return out;
}

void AddWaves(const Waves& waves, mjtNum time, const mjtNum point_w[3], FlowSample* flow) {
  const mjtNum z = point_w[2] - waves.level;
  for (const WaveComponent& wave : waves.components) {
    const mjtNum theta = Phase(wave, time, point_w);
    const mjtNum speed = wave.amplitude * wave.omega;
    const mjtNum cosine = speed * std::cos(theta), sine = speed * std::sin(theta);
    const Decay decay = DecayAt(wave, waves.depth, z);
    const mjtNum along = decay.c * cosine, across = decay.c * sine;
    const mjtNum up = decay.s * sine, lift = decay.s * cosine;
    const mjtNum* d = wave.direction;
    const mjtNum k[2] = {wave.wavenumber * d[0], wave.wavenumber * d[1]};
    for (int i = 0; i < 2; ++i) {
      flow->velocity[i] += along * d[i];
      flow->rate[i] += wave.omega * across * d[i];
      for (int j = 0; j < 2; ++j) flow->gradient[3 * i + j] -= across * d[i] * k[j];
      flow->gradient[3 * i + 2] += decay.c_slope * cosine * d[i];
      flow->gradient[6 + i] += lift * k[i];
    }
    flow->velocity[2] += up;
    flow->rate[2] -= wave.omega * lift;
    flow->gradient[8] += decay.s_slope * sine;
  }
}

}  // namespace fluid_sim
