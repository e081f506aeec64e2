// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "lean/step_commands.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

using Wide = __int128;  // products of two 64-bit numbers

// x / y rounded down, y > 0
Wide Floor(Wide x, Wide y) { return x / y - (x % y < 0 ? 1 : 0); }

// The generalized force of a free joint: the force in world axes, the torque in body axes.
void WriteWrench(const HeldWrench& wrench, mjData* d) {
  const mjtNum* quat_wb = d->qpos + wrench.position + 3;
  mjtNum* target = d->qfrc_applied + wrench.velocity;
  if (wrench.in_body_axes) {
    mju_rotVecQuat(target, wrench.force, quat_wb);
    Copy3(target + 3, wrench.torque);
    return;
  }
  mjtNum quat_bw[4];
  mju_negQuat(quat_bw, quat_wb);
  Copy3(target, wrench.force);
  mju_rotVecQuat(target + 3, wrench.torque, quat_bw);
}

}  // namespace

Gait::Gait(std::int64_t numerator, std::int64_t denominator, mjtNum period, mjtNum frequency,
           mjtNum ramp, std::vector<Joint> joints)
    : p_(numerator),
      q_(denominator),
      period_(period),
      frequency_(frequency),
      ramp_(ramp),
      joints_(std::move(joints)) {}

// The k-th is at floor(k p/q + 1/2).
std::int64_t Gait::Place(std::int64_t index) const {
  return static_cast<std::int64_t>(Floor(2 * Wide{index} * p_ + q_, 2 * Wide{q_}));
}

// The first k with 2 k p >= (2 tick - 1) q.
void Gait::Begin(std::int64_t tick) {
  index_ = static_cast<std::int64_t>(-Floor((1 - 2 * Wide{tick}) * q_, 2 * Wide{p_}));
  due_ = Place(index_);
}

void Gait::WriteDue(mjtNum* control) {
  const mjtNum time = static_cast<mjtNum>(index_) * period_;
  mjtNum rise = 1;
  if (time < ramp_) rise = 0.5 * (1 - std::cos(kPi * std::max<mjtNum>(time, 0) / ramp_));
  const mjtNum turn = 2 * kPi * frequency_ * time;
  for (const Joint& joint : joints_) {
    control[joint.control] = joint.offset + rise * joint.amplitude * std::sin(turn + joint.phase);
  }
  due_ = Place(++index_);
}

void StepCommands::Write(std::int64_t tick, mjData* d) {
  for (Gait& gait : gaits) gait.Write(tick, d->ctrl);
  for (const HeldWrench& wrench : wrenches) WriteWrench(wrench, d);
}

}  // namespace fluid_sim
