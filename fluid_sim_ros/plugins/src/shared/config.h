// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Reads the attributes of a plugin instance; every problem becomes one line for the user.

#ifndef FLUID_SIM_SHARED_CONFIG_H_
#define FLUID_SIM_SHARED_CONFIG_H_

#include <mujoco/mujoco.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace fluid_sim {

// Attribute values of one instance, for the owner that messages name ("body 'hull'"). Instance -1
// is a fluid_sim.body without any key.
class Config {
 public:
  Config(const mjModel* m, int instance, std::string owner)
      : model_(m), instance_(instance), owner_(std::move(owner)) {}

  // The value without leading and trailing blanks; empty when the key is not given.
  std::string Text(const char* key) const;
  bool Has(const char* key) const { return !Text(key).empty(); }

  // Finite numbers, as many as one of `counts`; an absent key leaves `out` empty.
  // `allowed` says in words what the value may be.
  bool Numbers(const char* key, std::initializer_list<int> counts, const char* allowed,
               std::vector<mjtNum>* out) const;

  // One number in [low, high]; an absent key leaves `out` as it is.
  bool Number(const char* key, mjtNum low, mjtNum high, const char* allowed, mjtNum* out) const;

  // Index of the word among `words`, 0 for an absent key, -1 (reported) for any other word.
  int Word(const char* key, std::initializer_list<const char*> words) const;

  // Report "owner: key = 'value': allowed: ..." and return false.
  bool Refuse(const char* key, const std::string& allowed) const;

  // Report "owner: sentence" and return false.
  bool Fail(const std::string& sentence) const;

  // Warn "owner: sentence"; the model still loads.
  void Warn(const std::string& sentence) const;

 private:
  const mjModel* model_;
  int instance_;
  std::string owner_;
};

// The words (or numbers) of a text, split at blanks.
std::vector<std::string> Split(const std::string& text);

// A finite number from the whole word, independent of the locale.
bool ParseNumber(const std::string& word, mjtNum* out);

// "body 'name'" (or its number when it has no name).
std::string BodyTitle(const mjModel* m, int body);

// "actuator 'name'" (or its number when it has no name).
std::string ActuatorTitle(const mjModel* m, int actuator);

// "instance 'name'" (or its number when it has no name).
std::string InstanceTitle(const mjModel* m, int instance);

// Name of the plugin of an instance ("" if unknown).
const char* PluginName(const mjModel* m, int instance);

// Number that a plugin was registered under: what m->plugin holds, and quicker than its name. -1:
// it was not.
int PluginSlot(const char* name);

// The instance is of the plugin `name`.
bool IsPlugin(const mjModel* m, int instance, const char* name);

// Names of our plugins.
constexpr char kBodyPlugin[] = "fluid_sim.body", kMediumPlugin[] = "fluid_sim.medium";
constexpr char kFoilPlugin[] = "fluid_sim.foil", kThrusterPlugin[] = "fluid_sim.thruster";

}  // namespace fluid_sim

#endif  // FLUID_SIM_SHARED_CONFIG_H_
