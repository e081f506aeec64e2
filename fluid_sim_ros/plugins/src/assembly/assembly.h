// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// One assembly per evaluation: medium, then every body, then every foil, in a fixed order.
//
// MuJoCo calls each plugin instance on its own. The first passive fluid_sim instance (lowest id)
// does the work of all, because the rigid-body inertia must be restored once before the added
// masses are written into it and factored once after.

#ifndef FLUID_SIM_ASSEMBLY_ASSEMBLY_H_
#define FLUID_SIM_ASSEMBLY_ASSEMBLY_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "body/body.h"
#include "foil/foil.h"
#include "medium/medium.h"
#include "shared/terms.h"

namespace fluid_sim {

// How far a body has left what its forces are good for, largest since the data was made.
struct BodyLimits {
  mjtNum crossing_share = 0;   // of its extent that passed the surface in one step [-]
  mjtNum crossing_speed = 0;   // at that [m/s]
  mjtNum crossing_extent = 0;  // and the extent [m]
  mjtNum reynolds = 0;         // of a drag that goes by it [-]
};

// Constants of a model, owned by the plugin data of one mjData.
struct Assembly {
  int owner = -1;  // instance that evaluates
  int last = -1;   // that advances last
  Medium medium;
  std::vector<BodyFluid> bodies;   // ascending body id
  std::vector<BodyLimits> limits;  // of each of them; no force depends on it
  std::vector<Foil> foils;         // by instance and site
};

// The assembly of a data, or null for a model without fluid_sim plugins.
const Assembly* FindAssembly(const mjModel* m, const mjData* d);

// Kinetic energy [J] of the bodies and of the flow that their added masses stand for, and the power
// [W] that both lose where the surface passes. `d` must hold positions and velocities; its inertia
// matrix is rewritten.
struct EnergyState {
  mjtNum bodies = 0, flow = 0, surface_loss = 0;
};
EnergyState KineticEnergy(const mjModel* m, mjData* d);

// Add the plugin's terms of `body` in world axes about `point_w`. With `acceleration` the added
// mass also resists d->qacc. Both need positions and velocities of the state in question.
void AddPluginTerms(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                    bool acceleration, Wrench terms[kTermCount]);

// Add the terms of MuJoCo's own fluid forces on `body`, in the flow that it meets, likewise.
void AddLocalStockTerms(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                        Wrench terms[kTermCount]);

// The fluid that a world point of `body` lies in.
Flow FluidAround(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3]);

// Register fluid_sim.body, fluid_sim.medium and fluid_sim.foil.
void RegisterAssembly();

}  // namespace fluid_sim

#endif  // FLUID_SIM_ASSEMBLY_ASSEMBLY_H_
