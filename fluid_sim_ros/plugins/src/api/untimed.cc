// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "api/untimed.h"

#include <mujoco/mujoco.h>

namespace fluid_sim {
namespace {

// Read so often that a call to find the thread's copy would cost as much as the clock saves.
__attribute__((tls_model("initial-exec"))) thread_local int untimed_depth = 0;

// The clock that was there when the first of us came: that of MuJoCo's Python package, or none.
const mjfTime kFound = mjcb_time;

mjtNum Clock() { return untimed_depth > 0 ? 0 : kFound(); }

}  // namespace

Untimed::Untimed() {
  // set_mjcb_time(None) brings it back; a clock that a user sets is his to read
  if (kFound && mjcb_time == kFound) mjcb_time = Clock;
  ++untimed_depth;
}

Untimed::~Untimed() { --untimed_depth; }

}  // namespace fluid_sim
