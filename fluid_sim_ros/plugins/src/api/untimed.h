// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Keeps MuJoCo from reading the clock at the begin and the end of every stage.

#ifndef FLUID_SIM_API_UNTIMED_H_
#define FLUID_SIM_API_UNTIMED_H_

namespace fluid_sim {

// While one lives, MuJoCo's profiling timers (mjData.timer) count calls of this thread but measure
// no durations: the clock of its Python package, read some 25 times per evaluation, takes a fifth
// of a step. Other threads, and MuJoCo called by itself, are not concerned.
class Untimed {
 public:
  Untimed();
  ~Untimed();
  Untimed(const Untimed&) = delete;
  Untimed& operator=(const Untimed&) = delete;
};

}  // namespace fluid_sim

#endif  // FLUID_SIM_API_UNTIMED_H_
