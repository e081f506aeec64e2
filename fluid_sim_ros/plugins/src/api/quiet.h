// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Keeps MuJoCo's log quiet about what the caller reports itself.

#ifndef FLUID_SIM_API_QUIET_H_
#define FLUID_SIM_API_QUIET_H_

namespace fluid_sim {

// While one lives, warnings of this thread go neither to the console nor to MUJOCO_LOG.TXT; the
// counters in mjData rise as always. Other threads, and errors, are not concerned.
class QuietWarnings {
 public:
  QuietWarnings();
  ~QuietWarnings();
  QuietWarnings(const QuietWarnings&) = delete;
  QuietWarnings& operator=(const QuietWarnings&) = delete;
};

}  // namespace fluid_sim

#endif  // FLUID_SIM_API_QUIET_H_
