// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// What is written into mjData before each step of a call: waves on joints, and wrenches that turn
// with their bodies.

#ifndef FLUID_SIM_LEAN_STEP_COMMANDS_H_
#define FLUID_SIM_LEAN_STEP_COMMANDS_H_

#include <mujoco/mujoco.h>

#include <cstdint>
#include <vector>

namespace fluid_sim {

// A vehicle's wave q_i = b_i + r(t) A_i sin(2 pi f t + phi_i), held between its beats; to the bit
// the twin of GaitCycle (scene/gaits.py), JointWave (control/gait.py) and Beat
// (step_clock/beat.py).
class Gait {
 public:
  struct Joint {
    int control;                      // address in ctrl
    mjtNum amplitude, phase, offset;  // [rad]
  };

  // A beat each `numerator`/`denominator` ticks (1 or more), which is `period` [s].
  Gait(std::int64_t numerator, std::int64_t denominator, mjtNum period, mjtNum frequency,
       mjtNum ramp, std::vector<Joint> joints);

  // Find the first beat at or after a tick.
  void Begin(std::int64_t tick);

  // Write the joint commands if there is a beat at this tick, which is the next one.
  void Write(std::int64_t tick, mjtNum* control) {
    if (tick == due_) WriteDue(control);
  }

 private:
  std::int64_t Place(std::int64_t index) const;
  void WriteDue(mjtNum* control);

  std::int64_t p_, q_;
  mjtNum period_, frequency_, ramp_;
  std::vector<Joint> joints_;
  std::int64_t index_ = 0, due_ = 0;  // of the next beat, and its tick
};

// Force and torque at a free body's origin, in its axes or in those of the world.
struct HeldWrench {
  int position, velocity;  // addresses in qpos and qvel of the free joint
  bool in_body_axes;
  mjtNum force[3], torque[3];  // [N], [N m]
};

class StepCommands {
 public:
  std::vector<Gait> gaits;
  std::vector<HeldWrench> wrenches;

  void Begin(std::int64_t tick) {
    for (Gait& gait : gaits) gait.Begin(tick);
  }

  void Write(std::int64_t tick, mjData* d);
};

}  // namespace fluid_sim

#endif  // FLUID_SIM_LEAN_STEP_COMMANDS_H_
