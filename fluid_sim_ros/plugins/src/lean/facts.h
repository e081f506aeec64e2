// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The numbers of a model that decide which work of a step can be left out.

#ifndef FLUID_SIM_LEAN_FACTS_H_
#define FLUID_SIM_LEAN_FACTS_H_

#include <mujoco/mujoco.h>

#include <vector>

namespace fluid_sim {

// Write them all.
void ReadFacts(const mjModel* m, std::vector<mjtNum>* facts);

// Whether they still are these.
bool SameFacts(const mjModel* m, const std::vector<mjtNum>& facts);

// Whether the model has constraints that are no contacts.
bool HasConstraints(const mjModel* m);

// How many of the first geoms forces, tendons or sensors need at every evaluation, without those
// that a served fluid (stock_fluid.h) places itself.
int NeededGeoms(const mjModel* m, bool fluid_served);

// Only fluid_sim.* plugins.
bool OwnPluginsOnly(const mjModel* m);

// MuJoCo's global callbacks are unset, the clock aside.
bool NoCallbacks();

}  // namespace fluid_sim

#endif  // FLUID_SIM_LEAN_FACTS_H_
