// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// What the library says of itself: its version, the terms, the columns, the plugins' keys.

#include <mujoco/mujoco.h>

#include <cstring>

#include "api/api.h"
#include "shared/config.h"

using namespace fluid_sim;

// Version of MuJoCo that this library was compiled against (mjVERSION_HEADER).
FSR_API int fsr_built_for() { return mjVERSION_HEADER; }

// Name of term i, or null beyond the last.
FSR_API const char* fsr_term(int i) { return i >= 0 && i < kTermCount ? kTerms[i].name : nullptr; }

// Name of column block i of an observation row, or null beyond the last; bounds[2] takes its first
// column and the one after its last.
FSR_API const char* fsr_columns(int i, int* bounds) {
  constexpr int kCount = sizeof(kColumns) / sizeof(kColumns[0]);
  if (i < 0 || i >= kCount) return nullptr;
  bounds[0] = kColumns[i].first;
  bounds[1] = kColumns[i].end;
  return kColumns[i].name;
}

// Configuration key i of a plugin by name, or null.
FSR_API const char* fsr_plugin_key(const char* name, int i) {
  const mjpPlugin* plugin = mjp_getPlugin(name, nullptr);
  return plugin && i >= 0 && i < plugin->nattribute ? plugin->attributes[i] : nullptr;
}

// Name of the plugin of an instance; empty for one that MuJoCo does not know.
FSR_API const char* fsr_plugin_name(const mjModel* m, int instance) {
  return instance >= 0 && instance < m->nplugin ? PluginName(m, instance) : "";
}

// Value of a configuration key of a plugin instance, or null where it is not given.
FSR_API const char* fsr_plugin_config(const mjModel* m, int instance, const char* key) {
  if (instance < 0 || instance >= m->nplugin) return nullptr;
  return mj_getPluginConfig(m, instance, key);
}
