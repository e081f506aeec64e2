// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Reads the attributes of fluid_sim.foil (units, signs and defaults: doc/foil.md).

#include <cmath>
#include <cstring>

#include "foil/foil.h"
#include "shared/config.h"
#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// A coefficient of one number: its key and where it goes.
struct Coefficient {
  const char* key;
  mjtNum* target;
  mjtNum low, high;
  const char* allowed;
};

constexpr char kAny[] = "a number [-]";
constexpr char kNotNegative[] = "a number >= 0 [-]";
constexpr char kPositive[] = "a number > 0 [-]";
constexpr char kPerRad[] = "a number [1/rad]";
constexpr char kLength[] = "a number > 0 [m]";
constexpr char kArea[] = "a number > 0 [m^2]";

std::vector<Coefficient> WingKeys(Wing* w) {
  return {{"aspect_ratio", &w->aspect_ratio, kTiny, kInfinity, kPositive},
          {"lift_0", &w->lift_0, -kInfinity, kInfinity, kAny},
          {"lift_slope", &w->lift_slope, 0, kInfinity, "a number >= 0 [1/rad]"},
          {"drag_0", &w->drag_0, 0, kInfinity, kNotNegative},
          {"pitch_0", &w->pitch_0, -kInfinity, kInfinity, kAny},
          {"efficiency", &w->efficiency, kTiny, kInfinity, kPositive},
          {"reverse", &w->reverse, 0, kInfinity, kNotNegative},
          {"plate_normal", &w->plate_normal, 0, kInfinity, kNotNegative},
          {"lift_delta", &w->lift_delta, -kInfinity, kInfinity, kPerRad},
          {"drag_delta", &w->drag_delta, 0, kInfinity, "a number >= 0 [1/rad]"},
          {"pitch_delta", &w->pitch_delta, -kInfinity, kInfinity, kPerRad},
          {"velocity_point", &w->velocity_point, -1, 1, "a number in -1..1 [chords]"}};
}

std::vector<Coefficient> AircraftKeys(Aircraft* a) {
  std::vector<Coefficient> keys = {{"efficiency", &a->efficiency, kTiny, kInfinity, kPositive}};
  static const char* const names[3][4] = {{"lift_0", "lift_alpha", "lift_q", "lift_elevator"},
                                          {"drag_0", "drag_alpha", "drag_q", "drag_elevator"},
                                          {"pitch_0", "pitch_alpha", "pitch_q", "pitch_elevator"}};
  static const char* const lateral[3][6] = {
      {"side_0", "side_beta", "side_p", "side_r", "side_aileron", "side_rudder"},
      {"roll_0", "roll_beta", "roll_p", "roll_r", "roll_aileron", "roll_rudder"},
      {"yaw_0", "yaw_beta", "yaw_p", "yaw_r", "yaw_aileron", "yaw_rudder"}};
  mjtNum* const sets[3] = {a->lift, a->drag, a->pitch};
  mjtNum* const others[3] = {a->side, a->roll, a->yaw};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) {
      keys.push_back({names[i][j], sets[i] + j, -kInfinity, kInfinity, kAny});
    }
    for (int j = 0; j < 6; ++j) {
      keys.push_back({lateral[i][j], others[i] + j, -kInfinity, kInfinity, kAny});
    }
  }
  return keys;
}

bool ReadKeys(const Config& config, const std::vector<Coefficient>& keys) {
  for (const Coefficient& key : keys) {
    if (!config.Number(key.key, key.low, key.high, key.allowed, key.target)) return false;
  }
  return true;
}

// A key of the other kind of foil would be off without a word.
bool CheckForeign(const Config& config, const std::vector<Coefficient>& others,
                  const std::vector<Coefficient>& own, std::initializer_list<const char*> words,
                  const char* kind) {
  std::vector<const char*> foreign(words);
  for (const Coefficient& other : others) foreign.push_back(other.key);
  for (const char* key : foreign) {
    bool known = false;
    for (const Coefficient& mine : own) known |= std::strcmp(mine.key, key) == 0;
    if (!known && config.Has(key)) {
      return config.Fail(std::string(key) + " needs kind=\"" + kind + "\"");
    }
  }
  return true;
}

bool ReadSize(const Config& config, mjtNum* area, mjtNum* span, mjtNum* chord) {
  for (const char* key : {"span", "chord"}) {
    if (!config.Has(key)) {
      return config.Fail(std::string(key) + " is missing; give a number > 0 [m]");
    }
  }
  if (!config.Number("span", kTiny, kInfinity, kLength, span) ||
      !config.Number("chord", kTiny, kInfinity, kLength, chord)) {
    return false;
  }
  *area = *span * *chord;
  return config.Number("area", kTiny, kInfinity, kArea, area);
}

bool ReadStall(const Config& config, Stall* stall) {
  if (!config.Number("stall_angle", 0.01, 1.2, "a number in 0.01..1.2 [rad]", &stall->angle) ||
      !config.Number("stall_sharpness", 5, 200, "a number in 5..200 [1/rad]", &stall->sharpness)) {
    return false;
  }
  // what is left of the attached flow at 90 deg, where forward and reverse flow meet
  if (stall->sharpness * (kPi / 2 - stall->angle) < 12) {
    return config.Fail(
        "stall_sharpness (pi/2 - stall_angle) must be at least 12, or the flow is "
        "still attached at 90 deg");
  }
  return true;
}

// `joint NAME [GAIN]` or `actuator NAME [GAIN]`.
bool ReadDeflection(const mjModel* m, const Config& config, const char* key, Deflection* out) {
  const char* allowed =
      "`joint NAME` (a hinge) or `actuator NAME` with one control, and a gain if "
      "it is not 1";
  const std::vector<std::string> words = Split(config.Text(key));
  if (words.empty()) return true;
  if (words.size() < 2 || words.size() > 3) return config.Refuse(key, allowed);
  if (words.size() == 3 && !ParseNumber(words[2], &out->gain)) return config.Refuse(key, allowed);
  const char* name = words[1].c_str();
  if (words[0] == "joint") {
    out->joint = mj_name2id(m, mjOBJ_JOINT, name);
    if (out->joint >= 0 && m->jnt_type[out->joint] == mjJNT_HINGE) return true;
  } else if (words[0] == "actuator") {
    out->actuator = mj_name2id(m, mjOBJ_ACTUATOR, name);
    if (out->actuator >= 0 && m->actuator_ctrlnum[out->actuator] == 1) return true;
  }
  return config.Refuse(key, allowed);
}

bool ReadWing(const mjModel* m, const Config& config, Foil* foil) {
  Wing& wing = foil->wing;
  Aircraft unused;
  if (!ReadSize(config, &wing.area, &wing.span, &wing.chord)) return false;
  wing.aspect_ratio = wing.span * wing.span / wing.area;
  const std::vector<Coefficient> keys = WingKeys(&wing);
  if (!ReadKeys(config, keys) || !ReadStall(config, &wing.stall)) return false;
  mjtNum section = 2 * kPi, panels = 1;
  if (!config.Number("section_slope", 0, kInfinity, "a number >= 0 [1/rad]", &section) ||
      !config.Number("panels", 1, 64, "a whole number in 1..64", &panels)) {
    return false;
  }
  if (panels != std::floor(panels)) return config.Refuse("panels", "a whole number in 1..64");
  wing.panels = static_cast<int>(panels);
  if (config.Has("lift_slope") && config.Has("section_slope")) {
    return config.Fail(
        "lift_slope (of the wing) and section_slope (of the section) exclude each "
        "other");
  }
  if (!config.Has("lift_slope")) {  // Helmbold (1942)
    const mjtNum k = section / (kPi * wing.aspect_ratio);
    wing.lift_slope = section / (std::sqrt(1 + k * k) + k);
  }
  const int power = config.Word("plate", {"newton", "sine"});
  const int center = config.Word("center_of_pressure", {"fixed", "moving"});
  if (power < 0 || center < 0) return false;
  wing.plate_power = power == 0 ? 2 : 1;
  wing.moving_center = center == 1;
  return ReadDeflection(m, config, "deflection", foil->deflection) &&
         CheckForeign(config, AircraftKeys(&unused), keys, {"aileron", "elevator", "rudder"},
                      "aircraft");
}

bool ReadAircraft(const mjModel* m, const Config& config, Foil* foil) {
  Aircraft& set = foil->set;
  Wing unused;
  const std::vector<Coefficient> keys = AircraftKeys(&set);
  return ReadSize(config, &set.area, &set.span, &set.chord) && ReadKeys(config, keys) &&
         ReadStall(config, &set.stall) && ReadDeflection(m, config, "aileron", foil->deflection) &&
         ReadDeflection(m, config, "elevator", foil->deflection + 1) &&
         ReadDeflection(m, config, "rudder", foil->deflection + 2) &&
         CheckForeign(config, WingKeys(&unused), keys,
                      {"section_slope", "panels", "plate", "center_of_pressure", "deflection"},
                      "wing");
}

// Stock MuJoCo drags the same body already.
bool CheckStock(const mjModel* m, const Config& config, int body) {
  const int stock = config.Word("stock_drag", {"refuse", "keep"});
  if (stock < 0) return false;
  if (stock == 1 || (m->opt.density <= 0 && m->opt.viscosity <= 0)) return true;
  if (m->body_mass[body] < mjMINVAL) return true;
  return config.Fail(
      "this foil and MuJoCo's own drag (opt.density or opt.viscosity > 0) both act on " +
      BodyTitle(m, body) +
      "; set opt density=\"0\" viscosity=\"0\" and give the fluid by fluid_sim.medium, or say "
      "stock_drag=\"keep\" to have both");
}

bool CheckFoil(const mjModel* m, const Config& config, const Medium& medium, int body) {
  if (body == 0) return config.Fail("a foil on the world cannot move; put it on a body");
  const mjtNum above = medium.has_surface ? medium.density[1] : 0;
  if (LowerDensity(medium, m) <= 0 && above <= 0) {
    return config.Fail("the fluid has no density; give it by fluid_sim.medium");
  }
  return CheckStock(m, config, body);
}

bool ReadInstance(const mjModel* m, int instance, const Medium& medium, std::vector<Foil>* foils) {
  std::string title = InstanceTitle(m, instance);
  std::vector<Foil> found;
  for (int body = 0; body < m->nbody; ++body) {
    if (m->body_plugin[body] != instance) continue;
    title = BodyTitle(m, body);
    found.emplace_back();
    found.back().body = body;
  }
  const Config config(m, instance, title);
  for (const std::string& word : Split(config.Text("site"))) {
    const int site = mj_name2id(m, mjOBJ_SITE, word.c_str());
    const int body = site < 0 ? -1 : m->site_bodyid[site];
    if (site < 0) return config.Refuse("site", "names of sites ('" + word + "' is none)");
    if (m->body_plugin[body] == instance) {  // at its site instead of the body's frame
      for (size_t i = 0; i < found.size(); ++i) {
        if (found[i].body == body && found[i].site < 0) found.erase(found.begin() + i--);
      }
    }
    found.emplace_back();
    found.back().body = body;
    found.back().site = site;
  }
  if (found.empty()) {
    return config.Fail(
        "is nowhere; give site=\"NAME\" or put <plugin instance=\"...\"/> into a "
        "body");
  }
  const int kind = config.Word("kind", {"wing", "aircraft"});
  if (kind < 0) return false;
  for (Foil& foil : found) {
    foil.aircraft = kind == 1;
    if (!(foil.aircraft ? ReadAircraft : ReadWing)(m, config, &foil) ||
        !CheckFoil(m, config, medium, foil.body)) {
      return false;
    }
    foils->push_back(foil);
  }
  return true;
}

}  // namespace

const char* const kFoilAttributes[] = {"kind",           "site",         "area",
                                       "span",           "chord",        "aspect_ratio",
                                       "section_slope",  "lift_slope",   "lift_0",
                                       "drag_0",         "pitch_0",      "efficiency",
                                       "reverse",        "stall_angle",  "stall_sharpness",
                                       "plate",          "plate_normal", "center_of_pressure",
                                       "velocity_point", "panels",       "deflection",
                                       "lift_delta",     "drag_delta",   "pitch_delta",
                                       "stock_drag",     "lift_alpha",   "lift_q",
                                       "lift_elevator",  "drag_alpha",   "drag_q",
                                       "drag_elevator",  "pitch_alpha",  "pitch_q",
                                       "pitch_elevator", "side_0",       "side_beta",
                                       "side_p",         "side_r",       "side_aileron",
                                       "side_rudder",    "roll_0",       "roll_beta",
                                       "roll_p",         "roll_r",       "roll_aileron",
                                       "roll_rudder",    "yaw_0",        "yaw_beta",
                                       "yaw_p",          "yaw_r",        "yaw_aileron",
                                       "yaw_rudder",     "aileron",      "elevator",
                                       "rudder"};
const int kFoilAttributeCount = sizeof(kFoilAttributes) / sizeof(kFoilAttributes[0]);

bool ReadFoils(const mjModel* m, const Medium& medium, std::vector<Foil>* foils) {
  for (int i = 0; i < m->nplugin; ++i) {
    if (!IsPlugin(m, i, kFoilPlugin)) continue;
    if (!ReadInstance(m, i, medium, foils)) return false;
  }
  return true;
}

}  // namespace fluid_sim
