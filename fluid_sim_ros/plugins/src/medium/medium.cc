// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "medium/medium.h"

#include <algorithm>

#include "shared/point_motion.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// The state may hold anything: whoever loads it is not asked.
std::uint64_t Seed(const mjtNum* state) {
  return state[kSeed] >= 0 && state[kSeed] <= kMostSeed ? static_cast<std::uint64_t>(state[kSeed])
                                                        : 0;
}

// The numbers of a stream's own in plugin_state; 0 and 1 name their noise.
StreamDrive CurrentDrive(const Medium& medium, const mjtNum* state) {
  return {state + kCurrentState, state + medium.current_noise, Seed(state), 0, state[kOn] > 0};
}

StreamDrive WindDrive(const Medium& medium, const mjtNum* state) {
  return {state + kWindState, state + medium.wind_noise, Seed(state), 1, state[kOn] > 0};
}

int TurbulenceAddress(const Medium& medium, int vehicle) {
  return medium.turbulence_state + vehicle * medium.turbulence_size;
}

// Where a vehicle flies, for turbulence that follows it: at its origin, in the mean wind.
Followed VehicleAt(const Medium& medium, const mjModel* m, const mjData* d, int body,
                   const mjtNum* state) {
  if (!medium.turbulence.follows) return {0, 0};
  const mjtNum* origin = d->xpos + 3 * body;
  mjtNum velocity[3], omega[3];
  FlowSample wind;
  AddStream(medium.wind, WindDrive(medium, state), d->time, origin[2], &wind);
  PointVelocity(m, d, body, origin, velocity, omega);
  return {origin[2] - medium.turbulence.ground, mju_dist3(velocity, wind.velocity)};
}

// Angular velocity of the flow: half the curl of its velocity.
void AddHalfCurl(FlowSample* flow) {
  const mjtNum* g = flow->gradient;  // g[3 i + j] = du_i/dx_j
  flow->spin[0] += 0.5 * (g[7] - g[5]);
  flow->spin[1] += 0.5 * (g[2] - g[6]);
  flow->spin[2] += 0.5 * (g[3] - g[1]);
}

// The flow of the lower (only) or the upper fluid at a point and the data's time.
FlowSample SampleAt(const Medium& medium, const mjModel* m, const mjData* d, bool lower, int body,
                    const mjtNum point_w[3]) {
  const mjtNum* state = d->plugin_state + m->plugin_stateadr[medium.instance];
  const bool on = state[kOn] > 0;
  FlowSample flow;
  if (lower) {
    AddStream(medium.current, CurrentDrive(medium, state), d->time, point_w[2], &flow);
    if (on) AddGrid(medium.current_grid, m, d->time, point_w, &flow);
    AddWaves(medium.waves, d->time, point_w, &flow);
  }
  const bool windy = !lower || !medium.has_surface;  // in one fluid current and wind add up
  if (windy) {
    AddStream(medium.wind, WindDrive(medium, state), d->time, point_w[2], &flow);
    if (on) AddGrid(medium.wind_grid, m, d->time, point_w, &flow);
  }
  if (medium.curl) AddHalfCurl(&flow);
  const int vehicle = medium.vehicle[body];
  if (windy && medium.turbulence.kind && vehicle >= 0 && on) {
    mjtNum arm[3];
    // of a free body from the state itself: between steps xpos is that of the step before
    const int address = medium.origin[body];
    const mjtNum* origin = address >= 0 ? d->qpos + address : d->xpos + 3 * m->body_rootid[body];
    for (int i = 0; i < 3; ++i) arm[i] = point_w[i] - origin[i];
    AddTurbulence(medium.turbulence, Seed(state), medium.stream[vehicle], d->time, point_w[2], arm,
                  state + TurbulenceAddress(medium, vehicle), &flow);
  }
  return flow;
}

// Nothing moves: no weather, and no mean now or before.
bool AtRest(const Medium& medium, const mjtNum* state) {
  if (medium.still) return true;
  const mjtNum *current = state + kCurrentState, *wind = state + kWindState;
  return medium.plain && IsZero3(current + kTarget) && IsZero3(current + kStart) &&
         IsZero3(wind + kTarget) && IsZero3(wind + kStart);
}

Flow FluidAt(const Medium& medium, const mjModel* m, const mjData* d, bool lower, mjtNum weight,
             int body, const mjtNum point_w[3]) {
  const int layer = lower ? 0 : 1;
  const mjtNum density = medium.density[layer], viscosity = medium.viscosity[layer];
  Flow out{lower, weight, density, viscosity, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  out.at_rest = AtRest(medium, d->plugin_state + m->plugin_stateadr[medium.instance]);
  if (out.at_rest) return out;
  const FlowSample sample = SampleAt(medium, m, d, lower, body, point_w);
  Copy3(out.velocity, sample.velocity);
  MaterialDerivative(sample, out.acceleration);
  Copy3(out.spin, sample.spin);
  return out;
}

}  // namespace

mjtNum LowerDensity(const Medium& medium, const mjModel* m) {
  return medium.in_charge() ? medium.density[0] : m->opt.density;
}

mjtNum LowerViscosity(const Medium& medium, const mjModel* m) {
  return medium.in_charge() ? medium.viscosity[0] : m->opt.viscosity;
}

FluidConstants StrongestFluid(const Medium& medium, const mjModel* m) {
  if (!medium.in_charge()) return {m->opt.density, m->opt.viscosity};
  if (!medium.has_surface) return {medium.density[0], medium.viscosity[0]};
  return {std::max(medium.density[0], medium.density[1]),
          std::max(medium.viscosity[0], medium.viscosity[1])};
}

mjtNum SurfaceHeight(const Medium& medium, const mjData* d, const mjtNum point_w[3]) {
  if (!medium.wavy()) return medium.surface;
  return WaveHeight(medium.waves, d->time, point_w);
}

int FlowsAt(const Medium& medium, const mjModel* m, const mjData* d, int body,
            const mjtNum point_w[3], mjtNum wet, Flow out[2]) {
  if (!medium.in_charge()) {
    out[0] = {true, 1, m->opt.density, m->opt.viscosity, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    Copy3(out[0].velocity, m->opt.wind);
    out[0].at_rest = IsZero3(m->opt.wind);
    return 1;
  }
  if (!medium.has_surface) {
    out[0] = FluidAt(medium, m, d, true, 1, body, point_w);
    return 1;
  }
  // a cut body's point may lie in the other fluid: take the flow at the surface then
  int count = 0;
  mjtNum point[3];
  Copy3(point, point_w);
  if (wet > 0) {
    if (point_w[2] > medium.surface - medium.waves.reach) {
      point[2] = std::min(point_w[2], SurfaceHeight(medium, d, point_w));
    }
    out[count++] = FluidAt(medium, m, d, true, wet, body, point);
  }
  if (wet < 1) {
    point[2] = std::max(point_w[2], medium.surface);
    out[count++] = FluidAt(medium, m, d, false, 1 - wet, body, point);
  }
  return count;
}

void ResetMediumState(const Medium& medium, mjtNum* state) {
  ResetStream(medium.current, state + kCurrentState);
  ResetStream(medium.wind, state + kWindState);
  state[kOn] = 1;
  state[kSeed] = medium.seed;
  StartMediumNoise(medium, state);
}

void StartMediumNoise(const Medium& medium, mjtNum* state) {
  const Stream* streams[] = {&medium.current, &medium.wind};
  const int noise[] = {medium.current_noise, medium.wind_noise};
  for (int i = 0; i < 2; ++i) {
    if (streams[i]->noise.count) StartNoise(streams[i]->noise, Seed(state), i, state + noise[i]);
  }
  if (!medium.turbulence.kind) return;
  const int vehicles = 1 + *std::max_element(medium.vehicle.begin(), medium.vehicle.end());
  for (int i = 0; i < vehicles; ++i) {
    StartTurbulence(medium.turbulence, Seed(state), medium.stream[i],
                    state + TurbulenceAddress(medium, i));
  }
}

void AdvanceMedium(const Medium& medium, const mjModel* m, mjData* d) {
  if (!medium.in_charge()) return;
  mjtNum* state = d->plugin_state + m->plugin_stateadr[medium.instance];
  const Stream* streams[] = {&medium.current, &medium.wind};
  const int noise[] = {medium.current_noise, medium.wind_noise};
  for (int i = 0; i < 2; ++i) {
    if (!streams[i]->noise.count) continue;
    AdvanceNoise(streams[i]->noise, Seed(state), i, d->time, state + noise[i]);
  }
  if (!medium.turbulence.kind) return;
  int last = -1;
  for (int body = 1; body < m->nbody; ++body) {
    const int vehicle = medium.vehicle[body];
    if (vehicle <= last) continue;
    last = vehicle;
    AdvanceTurbulence(medium.turbulence, Seed(state), medium.stream[vehicle], d->time,
                      VehicleAt(medium, m, d, body, state),
                      state + TurbulenceAddress(medium, vehicle));
  }
}

}  // namespace fluid_sim
