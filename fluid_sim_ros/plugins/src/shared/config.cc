// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "shared/config.h"

#include <locale.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace fluid_sim {
namespace {

std::string Title(const mjModel* m, int type, const std::string& kind, int id) {
  const char* name = mj_id2name(m, type, id);
  return kind + (name && name[0] ? "'" + std::string(name) + "'" : std::to_string(id));
}

}  // namespace

std::vector<std::string> Split(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool ParseNumber(const std::string& word, mjtNum* out) {
  // a stream for each number would take seconds for a long time series
  static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
  if (word.empty() || word.find_first_of("xX") != std::string::npos) return false;  // hexadecimal
  char* end = nullptr;
  *out = strtod_l(word.c_str(), &end, classic);
  return end == word.c_str() + word.size() && std::isfinite(*out);
}

std::string BodyTitle(const mjModel* m, int body) { return Title(m, mjOBJ_BODY, "body ", body); }

std::string ActuatorTitle(const mjModel* m, int actuator) {
  return Title(m, mjOBJ_ACTUATOR, "actuator ", actuator);
}

std::string InstanceTitle(const mjModel* m, int instance) {
  return Title(m, mjOBJ_PLUGIN, "instance ", instance);
}

const char* PluginName(const mjModel* m, int instance) {
  const mjpPlugin* plugin = mjp_getPluginAtSlot(m->plugin[instance]);
  return plugin ? plugin->name : "";
}

int PluginSlot(const char* name) {
  int slot = -1;
  mjp_getPlugin(name, &slot);
  return slot;
}

bool IsPlugin(const mjModel* m, int instance, const char* name) {
  return std::strcmp(PluginName(m, instance), name) == 0;
}

std::string Config::Text(const char* key) const {
  const char* value = instance_ < 0 ? nullptr : mj_getPluginConfig(model_, instance_, key);
  const std::string text = value ? value : "";
  const size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

bool Config::Numbers(const char* key, std::initializer_list<int> counts, const char* allowed,
                     std::vector<mjtNum>* out) const {
  out->clear();
  for (const std::string& word : Split(Text(key))) {
    mjtNum number;
    if (!ParseNumber(word, &number)) return Refuse(key, allowed);
    out->push_back(number);
  }
  if (out->empty()) return true;
  for (int count : counts) {
    if (static_cast<int>(out->size()) == count) return true;
  }
  return Refuse(key, std::string(allowed) + " (got " + std::to_string(out->size()) + " numbers)");
}

bool Config::Number(const char* key, mjtNum low, mjtNum high, const char* allowed,
                    mjtNum* out) const {
  std::vector<mjtNum> numbers;
  if (!Numbers(key, {1}, allowed, &numbers)) return false;
  if (numbers.empty()) return true;
  if (numbers[0] < low || numbers[0] > high) return Refuse(key, allowed);
  *out = numbers[0];
  return true;
}

int Config::Word(const char* key, std::initializer_list<const char*> words) const {
  const std::string text = Text(key);
  if (text.empty()) return 0;
  std::string allowed;
  int index = 0;
  for (const char* word : words) {
    if (text == word) return index;
    allowed += (index++ ? ", " : "") + std::string(word);
  }
  Refuse(key, allowed);
  return -1;
}

bool Config::Refuse(const char* key, const std::string& allowed) const {
  std::string value = Text(key);
  if (value.size() > 60) value = value.substr(0, 57) + "...";
  return Fail(std::string(key) + " = '" + value + "'; allowed: " + allowed);
}

bool Config::Fail(const std::string& sentence) const {
  const char* plugin = instance_ < 0 ? kBodyPlugin : PluginName(model_, instance_);
  mju_warning("%s: %s: %s", plugin, owner_.c_str(), sentence.c_str());
  return false;
}

void Config::Warn(const std::string& sentence) const { Fail(sentence); }

}  // namespace fluid_sim
