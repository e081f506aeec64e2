// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Wind and current.

#include <mujoco/mujoco.h>

#include "api/api.h"
#include "assembly/assembly.h"

using namespace fluid_sim;

namespace {

// The medium of a model, or null where none is in charge.
const Medium* InCharge(const mjModel* m, const mjData* d) {
  const Assembly* assembly = FindAssembly(m, d);
  return assembly && assembly->medium.in_charge() ? &assembly->medium : nullptr;
}

}  // namespace

// Targets that the wind and the current move towards from now on [m/s], world axes; a null pointer
// leaves one as it is. Returns 1, or 0 for a model where no fluid_sim.medium is in charge (set
// opt.wind there). Writes plugin_state only.
FSR_API int fsr_set_medium(const mjModel* m, mjData* d, const double* wind, const double* current) {
  const Medium* medium = InCharge(m, d);
  if (!medium) return 0;
  mjtNum* state = d->plugin_state + m->plugin_stateadr[medium->instance];
  if (current) SetTarget(medium->current, state + kCurrentState, d->time, current);
  if (wind) SetTarget(medium->wind, state + kWindState, d->time, wind);
  return 1;
}

// Targets of wind and current in d [m/s]; returns 0 and writes nothing where no medium is in
// charge.
FSR_API int fsr_get_medium(const mjModel* m, const mjData* d, double* wind, double* current) {
  const Medium* medium = InCharge(m, d);
  if (!medium) return 0;
  const mjtNum* state = d->plugin_state + m->plugin_stateadr[medium->instance];
  mju_copy3(current, state + kCurrentState + kTarget);
  mju_copy3(wind, state + kWindState + kTarget);
  return 1;
}

// Let signals, noise and turbulence act, or not; the means are targets of their own. Returns 1, or
// 0 where no medium is in charge.
FSR_API int fsr_enable_medium(const mjModel* m, mjData* d, int on) {
  const Medium* medium = InCharge(m, d);
  if (!medium) return 0;
  d->plugin_state[m->plugin_stateadr[medium->instance] + kOn] = on ? 1 : 0;
  return 1;
}

// Start all noise anew with a seed (a whole number up to 2^53) and bring it to the data's time.
// Returns 1, or 0 where no medium is in charge.
FSR_API int fsr_seed_medium(const mjModel* m, mjData* d, double seed) {
  const Medium* medium = InCharge(m, d);
  if (!medium) return 0;
  mjtNum* state = d->plugin_state + m->plugin_stateadr[medium->instance];
  state[kSeed] = seed;
  StartMediumNoise(*medium, state);
  AdvanceMedium(*medium, m, d);
  return 1;
}

// What `body` meets at a world point at the data's time, out[9]: velocity u [m/s], Du/Dt [m/s^2]
// and rotational gust [rad/s] of the fluid that the point lies in.
FSR_API void fsr_flow(const mjModel* m, const mjData* d, int body, const double* point_w,
                      double* out) {
  const Flow flow = FluidAround(m, d, body, point_w);
  mju_copy3(out, flow.velocity);
  mju_copy3(out + 3, flow.acceleration);
  mju_copy3(out + 6, flow.spin);
}
