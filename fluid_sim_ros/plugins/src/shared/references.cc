// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "shared/references.h"

#include <string>

#include "shared/config.h"

namespace fluid_sim {
namespace {

constexpr char kRemedy[] =
    ": MuJoCo's attach drops a plugin that is configured inside an element; give the attached "
    "model a named <instance> in <extension> and refer to it by instance=\"...\"";

const char* NameOf(const mjModel* m, int type, int id) {
  const char* name = mj_id2name(m, type, id);
  return name ? name : "";
}

bool HasCapability(const mjModel* m, int instance, int capability) {
  const mjpPlugin* plugin = mjp_getPluginAtSlot(m->plugin[instance]);
  return plugin && (plugin->capabilityflags & capability);
}

bool CanBeOnBody(const mjModel* m, int instance) {
  return HasCapability(m, instance, mjPLUGIN_PASSIVE) && !IsPlugin(m, instance, kMediumPlugin) &&
         !IsPlugin(m, instance, kThrusterPlugin);
}

// Copies of one body, as <replicate> makes them: they share an instance without a name.
bool AreAlike(const mjModel* m, int a, int b) {
  return m->body_mass[a] == m->body_mass[b] &&
         mju_dist3(m->body_inertia + 3 * a, m->body_inertia + 3 * b) == 0 &&
         m->body_geomnum[a] == m->body_geomnum[b] && m->body_jntnum[a] == m->body_jntnum[b];
}

bool IsOurs(const mjModel* m, int instance) {
  return IsPlugin(m, instance, kBodyPlugin) || IsPlugin(m, instance, kFoilPlugin);
}

bool CheckBodyReference(const mjModel* m, int body) {
  const int instance = m->body_plugin[body];
  if (instance < 0) return true;
  const std::string plugin = PluginName(m, instance);
  const Config config(m, instance, BodyTitle(m, body));
  if (!CanBeOnBody(m, instance)) {
    return config.Fail("its plugin is " + plugin + ", which is none for a body" + kRemedy);
  }
  if (!IsOurs(m, instance) || NameOf(m, mjOBJ_PLUGIN, instance)[0]) return true;
  for (int other = 1; other < body; ++other) {
    if (m->body_plugin[other] != instance || AreAlike(m, other, body)) continue;
    return config.Fail("its plugin is that of " + BodyTitle(m, other) + kRemedy);
  }
  return true;
}

}  // namespace

bool CheckReferences(const mjModel* m) {
  for (int body = 1; body < m->nbody; ++body) {
    if (!CheckBodyReference(m, body)) return false;
  }
  for (int i = 0; i < m->nactuator; ++i) {
    const int instance = m->actuator_plugin[i];
    if (instance < 0 || HasCapability(m, instance, mjPLUGIN_ACTUATOR)) continue;
    return Config(m, instance, ActuatorTitle(m, i))
        .Fail("its plugin is " + std::string(PluginName(m, instance)) +
              ", which is none for an actuator" + kRemedy);
  }
  return true;
}

}  // namespace fluid_sim
