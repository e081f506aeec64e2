// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Parts of the reader of fluid_sim.thruster.

#ifndef FLUID_SIM_THRUSTER_THRUSTER_READ_H_
#define FLUID_SIM_THRUSTER_THRUSTER_READ_H_

#include "shared/config.h"
#include "thruster/thruster.h"

namespace fluid_sim {

// One or two numbers >= low; the second defaults to `other` times the first.
bool ReadPair(const Config& config, const char* key, mjtNum low, const char* allowed, mjtNum other,
              mjtNum out[2]);

// The key must be given; `what` says with what.
bool Require(const Config& config, const char* key, const char* what);

// What the inflow takes, if it is asked for; after the curve and the density it holds for.
bool ReadInflow(const Config& config, Thruster* out);

// The curve and its limits; keys that it does not read are refused.
bool ReadCurve(const Config& config, Thruster* out);

}  // namespace fluid_sim

#endif  // FLUID_SIM_THRUSTER_THRUSTER_READ_H_
