// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Moments of actuators at sites, along the site's own tree alone.
//
// mj_transmission makes a Jacobian over all degrees of freedom for each of them: in a fleet it
// takes most of a step, and its cost grows with the square of the number of vehicles. The steps
// here are of a copy of mjModel's head in which those actuators look as if they were at a joint,
// which costs nothing; MuJoCo's control callback, called before it uses the moments, then writes
// what mj_transmission would have written, to the bit.

#ifndef FLUID_SIM_LEAN_TRANSMISSION_H_
#define FLUID_SIM_LEAN_TRANSMISSION_H_

#include <mujoco/mujoco.h>

#include <vector>

namespace fluid_sim {

class Transmission {
 public:
  // Whether these actuators can be served: at sites without another to refer to, or at hinges and
  // slides, without damping and armature of their own; and nothing looks at them on the way.
  void Learn(const mjModel* m);

  // Likewise as the options are now. With it the callback is there.
  bool Ready(const mjModel* m) const;

  // Let the head's actuators look so that mj_transmission has nothing to do.
  void Disguise(mjModel* head) const;

 private:
  bool served_ = false;
  std::vector<int> type_, target_;  // in the disguise
};

// What mj_transmission and mj_fwdVelocity write for such actuators.
void WriteMoments(const mjModel* m, mjData* d);

}  // namespace fluid_sim

#endif  // FLUID_SIM_LEAN_TRANSMISSION_H_
