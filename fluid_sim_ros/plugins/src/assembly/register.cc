// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Registers every fluid_sim.* plugin when the library is loaded (MuJoCo plugin mechanism).

#include <mujoco/mujoco.h>

#include "assembly/assembly.h"
#include "assembly/noop.h"
#include "thruster/thruster.h"

mjPLUGIN_LIB_INIT(fluid_sim) {
  fluid_sim::RegisterNoop();
  fluid_sim::RegisterAssembly();
  fluid_sim::RegisterThruster();
}
