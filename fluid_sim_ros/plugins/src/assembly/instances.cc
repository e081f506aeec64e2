// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "assembly/instances.h"

#include "shared/config.h"

namespace fluid_sim {

// First instance that takes part in the assembly, or -1; asked for every body that is observed.
int FirstInstance(const mjModel* m) {
  static const int body = PluginSlot(kBodyPlugin), medium = PluginSlot(kMediumPlugin),
                   foil = PluginSlot(kFoilPlugin);
  for (int i = 0; i < m->nplugin; ++i) {
    const int slot = m->plugin[i];
    if (slot == body || slot == medium || slot == foil) return i;
  }
  return -1;
}

// The last of them: when it advances, the others have.
int LastInstance(const mjModel* m) {
  int last = -1;
  for (int i = 0; i < m->nplugin; ++i) {
    if (IsPlugin(m, i, kBodyPlugin) || IsPlugin(m, i, kMediumPlugin) || IsPlugin(m, i, kFoilPlugin))
      last = i;
  }
  return last;
}

// Every fluid_sim.body instance is on a body: one that is not would be off without a word.
bool CheckInstancesUsed(const mjModel* m) {
  for (int i = 0; i < m->nplugin; ++i) {
    if (!IsPlugin(m, i, kBodyPlugin)) continue;
    bool used = false;
    for (int body = 1; body < m->nbody; ++body) used |= m->body_plugin[body] == i;
    if (used) continue;
    return Config(m, i, InstanceTitle(m, i))
        .Fail("is on no body; put <plugin instance=\"...\"/> into a body");
  }
  return true;
}

}  // namespace fluid_sim
