// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Reads the attributes of fluid_sim.thruster (units, signs and defaults: doc/thruster.md).

#include "thruster/thruster_read.h"

#include <cmath>

#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

constexpr mjtNum kAligned = 1e-6;  // allowed error of a gear's length and direction

const mjtNum* Gear(const mjModel* m, int actuator) {
  return m->actuator_gear + 6 * m->actuator_outadr[actuator];
}

// Sort the instance's actuators into force and torque by their gear.
bool FindActuators(const mjModel* m, int instance, Thruster* out) {
  for (int i = 0; i < m->nactuator; ++i) {
    if (m->actuator_plugin[i] != instance) continue;
    const Config config(m, instance, ActuatorTitle(m, i));
    if (m->actuator_trntype[i] != mjTRN_SITE || m->actuator_trnid[2 * i + 1] >= 0) {
      return config.Fail(
          "a thruster acts at a site; give the actuator site=\"NAME\" (and no "
          "refsite)");
    }
    const mjtNum *force = Gear(m, i), *torque = force + 3;
    const mjtNum pull = mju_norm3(force), turn = mju_norm3(torque);
    const bool unit = std::abs(pull + turn - 1) < kAligned && pull * turn == 0;
    int* slot = pull > 0 ? &out->thrust : &out->torque;
    if (unit && *slot >= 0) {
      return config.Fail(
          "its instance drives another actuator of this kind already; give each thruster an "
          "<instance> of its own in <extension>");
    }
    if (!unit) {
      return config.Fail(
          "wrong gear; allowed: one actuator with a unit force axis (gear=\"0 0 1 0 0 0\": thrust) "
          "and at most one with the same torque axis (gear=\"0 0 0 0 0 1\": reaction torque)");
    }
    if (m->actuator_dyntype[i] != mjDYN_NONE || m->actuator_delay[i] > 0) {
      return config.Fail(
          "dyntype and delay do not go with fluid_sim.thruster; its lag is "
          "time_constant [s]");
    }
    *slot = i;
  }
  const Config config(m, instance, InstanceTitle(m, instance));
  if (out->thrust < 0) {
    return config.Fail(
        "no actuator gives thrust; add <plugin plugin=\"fluid_sim.thruster\" "
        "instance=\"...\" site=\"...\" gear=\"0 0 1 0 0 0\"/> to <actuator>");
  }
  out->site = m->actuator_trnid[2 * out->thrust];
  out->body = m->site_bodyid[out->site];
  mju_copy3(out->axis, Gear(m, out->thrust));
  if (out->torque < 0) return true;
  if (m->actuator_trnid[2 * out->torque] == out->site &&
      mju_dist3(Gear(m, out->torque) + 3, out->axis) < kAligned) {
    return true;
  }
  return Config(m, instance, ActuatorTitle(m, out->torque))
      .Fail("the reaction torque must be on the thrust's site, about the thrust's axis");
}

bool ReadPulse(const Config& config, Thruster* out) {
  std::vector<mjtNum> range, dead;
  const char* pulses =
      "3 numbers [us], rising: full reverse, neutral, full forward (the first two "
      "equal for a thruster without reverse)";
  const char* edges = "2 numbers [us] within pwm_range, around neutral";
  if (!config.Numbers("pwm_range", {3}, pulses, &range) ||
      !config.Numbers("dead_zone", {2}, edges, &dead)) {
    return false;
  }
  if (out->limit[1] <= 0) out->pwm[0] = out->pwm[1] = 1000, out->pwm[2] = 2000;
  if (!range.empty()) mju_copy3(out->pwm, range.data());
  const mjtNum* p = out->pwm;
  const bool reverse = p[1] > p[0];
  if (p[0] > p[1] || p[1] >= p[2] || reverse != (out->limit[1] > 0)) {
    return config.Refuse("pwm_range", pulses);
  }
  out->dead[0] = out->dead[1] = p[1];
  if (!dead.empty()) mju_copy(out->dead, dead.data(), 2);
  const mjtNum* z = out->dead;
  const bool inside = z[0] >= p[0] && z[0] <= p[1] && z[1] >= p[1] && z[1] < p[2];
  if (!inside || (reverse && z[0] <= p[0])) return config.Refuse("dead_zone", edges);
  return true;
}

bool ReadLag(const mjModel* m, const Config& config, Thruster* out) {
  mjtNum tau[2] = {0, 0};
  const char* allowed = "1 or 2 numbers >= 0 [s]: speeding up (and slowing down)";
  if (!ReadPair(config, "time_constant", 0, allowed, 1, tau)) return false;
  out->lag.up = tau[0], out->lag.down = tau[1];
  out->lagged = tau[0] > 0 || tau[1] > 0;
  const int wanted = out->lagged ? 2 : 0;
  if (m->actuator_actnum[out->thrust] != wanted) {
    return config.Fail(out->lagged ? "time_constant needs actdim=\"2\" on this actuator"
                                   : "actdim needs time_constant > 0 [s]");
  }
  if (out->torque >= 0 && m->actuator_actnum[out->torque] != 0) {
    return config.Fail("the actuator of the reaction torque must not have actdim");
  }
  return true;
}

bool ReadRotor(const mjModel* m, const Config& config, Thruster* out) {
  const int spin = config.Word("spin", {"ccw", "cw"});
  if (spin < 0) return false;
  out->spin = spin ? -1 : 1;
  if (!config.Number("torque_ratio", 0, kInfinity, "a number >= 0 [m]", &out->curve.torque_ratio) ||
      !config.Number("rotor_inertia", 0, kInfinity, "a number >= 0 [kg m^2]", &out->inertia) ||
      !ReadPair(config, "rotor_drag", 0,
                "1 or 2 numbers >= 0 [N/((rad/s)(m/s))]: across (and along) the axis", 0,
                out->drag) ||
      !config.Number("rolling_moment", 0, kInfinity, "a number >= 0 [N m/((rad/s)(m/s))]",
                     &out->rolling) ||
      !config.Number("diameter", kTiny, kInfinity, "a number > 0 [m]", &out->curve.diameter)) {
    return false;
  }
  const bool turns = out->curve.torque_ratio > 0 || out->curve.torque_j[0] > 0 || out->inertia > 0;
  if (turns && out->torque < 0) {
    return config.Fail(
        "the shaft torque has no actuator; add a second one with the same instance and site and "
        "gear=\"0 0 0 0 0 1\" (the thrust axis as torque)");
  }
  const int passive = mjDSBL_SPRING | mjDSBL_DAMPER;
  if (out->passive() && (m->opt.disableflags & passive) == passive) {
    return config.Fail(
        "flag spring and damper are both disabled, which disables rotor_drag, "
        "rolling_moment and rotor_inertia too; enable one of them");
  }
  if (!turns && out->torque >= 0) {
    return config.Fail(
        "the actuator of the reaction torque has no torque; give torque_ratio [m], "
        "torque_coefficients or rotor_inertia");
  }
  return true;
}

bool ReadGround(const Config& config, Thruster* out) {
  const std::string text = config.Text("ground_effect");
  if (text == "cheeseman_bennett") {
    out->ground_effect = -1;
  } else if (text != "none" &&
             !config.Number("ground_effect", 0, kInfinity,
                            "none, cheeseman_bennett or a number >= 0 [-]", &out->ground_effect)) {
    return false;
  }
  if (config.Has("ground") && out->ground_effect == 0) {
    return config.Fail("ground needs ground_effect");
  }
  if (out->ground_effect != 0 && !Require(config, "diameter", "a number > 0 [m]")) return false;
  return config.Number("ground", -kInfinity, kInfinity, "a height in world z [m]", &out->ground);
}

// The fluid, the density that the curve holds for, and k of the coefficient form.
bool ReadFluid(const mjModel* m, const Config& config, Thruster* out) {
  const int works = config.Word("fluid", {"constant", "local", "water", "air"});
  if (works < 0 || !ReadMedium(m, &out->medium)) return false;
  out->works = static_cast<Works>(works);
  RotorCurve& curve = out->curve;
  const Medium& medium = out->medium;
  const bool coefficients = curve.kind == Curve::kCoefficients;
  const bool layered = out->works == Works::kWater || out->works == Works::kAir;
  if (layered && !(medium.in_charge() && medium.has_surface)) {
    return config.Refuse("fluid",
                         "constant or local, for water and air need a fluid_sim.medium "
                         "with surface");
  }
  if (out->works != Works::kConstant && medium.has_surface &&
      !Require(config, "diameter", "a number > 0 [m], for the share of the disc in each fluid")) {
    return false;
  }
  if (layered) curve.density = medium.density[out->works == Works::kAir ? 1 : 0];
  if (coefficients && out->works == Works::kLocal) curve.density = LowerDensity(medium, m);
  if (!config.Number("density", kTiny, kInfinity, "a number > 0 [kg/m^3]", &curve.density)) {
    return false;
  }
  const bool momentum = config.Text("inflow_law") == "momentum";
  const bool needed = coefficients || momentum || out->works == Works::kLocal;
  if (!needed && config.Has("density")) {
    return config.Fail(
        "density needs curve=\"coefficients\", inflow_law=\"momentum\" or fluid=\"local\"");
  }
  if (needed && curve.density <= 0) {
    return config.Fail("the density that the curve holds for is missing; give density [kg/m^3]");
  }
  if (coefficients) {
    const mjtNum d = curve.diameter, turn = 2 * kPi;
    curve.k[0] = curve.density * d * d * d * d * curve.thrust_j[0] / (turn * turn);
    curve.k[1] = curve.k[0] * curve.reverse[0];
  }
  return true;
}

}  // namespace

const char* const kThrusterAttributes[] = {"command",
                                           "curve",
                                           "thrust_coefficient",
                                           "polynomial_forward",
                                           "polynomial_reverse",
                                           "table",
                                           "voltage",
                                           "thrust_coefficients",
                                           "torque_coefficients",
                                           "reverse_scale",
                                           "diameter",
                                           "density",
                                           "rad_s_max",
                                           "pwm_range",
                                           "dead_zone",
                                           "time_constant",
                                           "spin",
                                           "torque_ratio",
                                           "rotor_inertia",
                                           "rotor_drag",
                                           "rolling_moment",
                                           "ground_effect",
                                           "ground",
                                           "fluid",
                                           "inflow",
                                           "inflow_law",
                                           "zero_thrust_advance",
                                           "measured_advance"};
const int kThrusterAttributeCount = sizeof(kThrusterAttributes) / sizeof(kThrusterAttributes[0]);

bool ReadThruster(const mjModel* m, int instance, Thruster* out) {
  if (!FindActuators(m, instance, out)) return false;
  const Config config(m, instance, ActuatorTitle(m, out->thrust));
  const int command = config.Word("command", {"newton", "normalized", "rad_s", "pwm_us"});
  if (command < 0) return false;
  out->command = static_cast<Command>(command);
  if (!ReadCurve(config, out)) return false;
  if (out->curve.kind != Curve::kTable && !ReadPulse(config, out)) return false;
  return ReadRotor(m, config, out) && ReadGround(config, out) && ReadFluid(m, config, out) &&
         ReadInflow(config, out) && ReadLag(m, config, out);
}

}  // namespace fluid_sim
