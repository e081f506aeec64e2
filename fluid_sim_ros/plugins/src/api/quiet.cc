// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "api/quiet.h"

#include <mujoco/mujoco.h>

namespace fluid_sim {
namespace {

thread_local int quiet_depth = 0;

// The handler that was there before ours (MuJoCo's own is a function too); written once.
mjfLogHandler& Previous() {
  static mjfLogHandler previous = nullptr;
  return previous;
}

void Handle(const mjLogMessage* message) {
  if (quiet_depth > 0 && message->level == mjLOG_WARNING) return;
  if (Previous()) Previous()(message);
}

bool Install() {
  Previous() = mju_setLogHandler(Handle);
  return true;
}

}  // namespace

QuietWarnings::QuietWarnings() {
  static const bool installed = Install();
  (void)installed;
  ++quiet_depth;
}

QuietWarnings::~QuietWarnings() { --quiet_depth; }

}  // namespace fluid_sim
