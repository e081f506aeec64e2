// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// fluid_sim.noop: a passive plugin that does nothing (measures the cost of plugin dispatch).

#ifndef FLUID_SIM_ASSEMBLY_NOOP_H_
#define FLUID_SIM_ASSEMBLY_NOOP_H_

namespace fluid_sim {

void RegisterNoop();

}  // namespace fluid_sim

#endif  // FLUID_SIM_ASSEMBLY_NOOP_H_
