// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// fluid_sim.medium: the fluids around the bodies, at most one per model.
//
// Two fluids with a level surface between them (water under air), or one fluid everywhere. Each
// moves with the sum of its contributors (flow_sample.h): current and waves below, wind above.

#ifndef FLUID_SIM_MEDIUM_MEDIUM_H_
#define FLUID_SIM_MEDIUM_MEDIUM_H_

#include <mujoco/mujoco.h>

#include <cstdint>
#include <vector>

#include "medium/flow_sample.h"
#include "medium/grid.h"
#include "medium/stream.h"
#include "medium/turbulence.h"
#include "medium/waves.h"
#include "shared/terms.h"

namespace fluid_sim {

constexpr mjtNum kMostSeed = 9007199254740992;  // 2^53: a whole number in a mjtNum

// One fluid as a body meets it.
struct Flow {
  bool lower;              // the fluid below the surface (or the only one)
  mjtNum weight;           // share of the body in this fluid [-]
  mjtNum density;          // [kg/m^3]
  mjtNum viscosity;        // dynamic [Pa s]
  mjtNum velocity[3];      // undisturbed, world [m/s]
  mjtNum acceleration[3];  // Du/Dt = du/dt + (u.grad)u, world [m/s^2]
  mjtNum spin[3];          // rotational gust, world [rad/s]
  bool at_rest = false;    // for certain: velocity, acceleration and spin are zero
};

// Where plugin_state holds what: the means, whether signals and noise act (1 or 0), the seed; then
// the processes of current and wind, then turbulence, vehicle by vehicle.
enum MediumState {
  kCurrentState = 0,
  kWindState = kStreamState,
  kOn = 2 * kStreamState,
  kSeed,
  kNoiseState
};

struct Medium {
  int instance = -1;            // plugin instance, or -1: the model has none, opt.* holds
  bool equal = false;           // states the same as opt.*, which then stays in charge
  bool corrects_stock = false;  // MuJoCo's own forces act and know only opt.wind, not this flow
  bool has_surface = false;
  mjtNum surface = 0;            // mean height of the free surface, world z [m]
  mjtNum density[2] = {0, 0};    // below, above [kg/m^3]
  mjtNum viscosity[2] = {0, 0};  // below, above [Pa s]
  Stream current, wind;
  Grid current_grid, wind_grid;
  Turbulence turbulence;              // of the wind
  bool curl = false;                  // rotational gusts are half the curl of current and wind
  mjtNum seed = 0;                    // of all noise
  std::vector<int> vehicle;           // of each body, or -1 for what stands still
  std::vector<std::uint64_t> stream;  // key of each vehicle's noise
  std::vector<int> origin;  // of each body's vehicle: address in qpos, or -1 without a free joint
  // addresses in the state: of the processes, and of the first vehicle's turbulence
  int current_noise = 0, wind_noise = 0, turbulence_state = 0;
  int turbulence_size = 0;  // per vehicle
  Waves waves;
  bool plain = false;  // no weather but the mean of current and wind
  bool still = false;  // held without motion and waves, for a look at the integrator alone

  bool in_charge() const { return instance >= 0 && !equal; }
  bool wavy() const { return waves.any() && !still; }
};

extern const char* const kMediumAttributes[];
extern const int kMediumAttributeCount;

// Read the model's fluid_sim.medium, if any; false after one line about what is wrong.
bool ReadMedium(const mjModel* m, Medium* medium);

// Density and viscosity of the lower (only) fluid.
mjtNum LowerDensity(const Medium& medium, const mjModel* m);
mjtNum LowerViscosity(const Medium& medium, const mjModel* m);

// The largest density and the largest viscosity of the fluids that a body can meet.
FluidConstants StrongestFluid(const Medium& medium, const mjModel* m);

// Height of the free surface over a point at the data's time, world z [m].
mjtNum SurfaceHeight(const Medium& medium, const mjData* d, const mjtNum point_w[3]);

// The fluids with a share in a body whose share `wet` lies below the surface, flow taken at the
// world point; returns how many of out[2] are filled (1 or 2). Turbulence is that of the vehicle
// that `body` belongs to.
int FlowsAt(const Medium& medium, const mjModel* m, const mjData* d, int body,
            const mjtNum point_w[3], mjtNum wet, Flow out[2]);

// Size of the state, from the keys and the bodies alone.
int MediumStateSize(const mjModel* m, int instance);

// State at the start: the configured velocities, reached long ago; noise at time 0.
void ResetMediumState(const Medium& medium, mjtNum* state);

// All noise at time 0, with the seed in the state.
void StartMediumNoise(const Medium& medium, mjtNum* state);

// Draw the noise that the step from the data's time on needs.
void AdvanceMedium(const Medium& medium, const mjModel* m, mjData* d);

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_MEDIUM_H_
