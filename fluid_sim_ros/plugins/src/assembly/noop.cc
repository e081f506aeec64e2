// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "assembly/noop.h"

#include <mujoco/mujoco.h>

namespace fluid_sim {

void RegisterNoop() {
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = "fluid_sim.noop";
  plugin.capabilityflags = mjPLUGIN_PASSIVE;
  plugin.nstate = [](const mjModel*, int) { return 0; };
  plugin.init = [](const mjModel*, mjData*, int) { return 0; };
  plugin.compute = [](const mjModel*, mjData*, int, int) {};
  mjp_registerPlugin(&plugin);
}

}  // namespace fluid_sim
