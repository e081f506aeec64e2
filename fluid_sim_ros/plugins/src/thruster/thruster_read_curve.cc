// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Reads the curve of a fluid_sim.thruster.

#include <cmath>

#include "shared/numbers.h"
#include "thruster/thruster_read.h"

namespace fluid_sim {
namespace {

bool ReadLimit(const Config& config, Thruster* out) {
  const char* allowed = "1 or 2 numbers > 0 [rad/s]: forward (and reverse)";
  if (!Require(config, "rad_s_max", allowed)) return false;
  if (!ReadPair(config, "rad_s_max", kTiny, allowed, 0, out->limit)) return false;
  return true;
}

bool ReadPolynomialSide(const Config& config, const char* key, int side, Thruster* out) {
  const char* allowed =
      "numbers c1 c2 ... [N/(rad/s)^i]: thrust c1 w + c2 w^2 + ..., rising up to "
      "rad_s_max";
  std::vector<mjtNum>& c = out->curve.polynomial[side];
  for (const std::string& word : Split(config.Text(key))) {
    mjtNum number;
    if (!ParseNumber(word, &number)) return config.Refuse(key, allowed);
    c.push_back(number);
  }
  constexpr int kSamples = 1000;
  mjtNum before = 0;
  for (int i = 1; i <= kSamples; ++i) {
    const mjtNum omega = out->limit[side] * i / kSamples * (side ? -1 : 1);
    const mjtNum thrust = std::abs(StaticThrust(out->curve, omega));
    if (thrust <= before || StaticThrust(out->curve, omega) * omega < 0) {
      return config.Refuse(key, allowed);
    }
    before = thrust;
  }
  return true;
}

bool ReadPolynomial(const Config& config, Thruster* out) {
  if (!ReadLimit(config, out) ||
      !Require(config, "polynomial_forward", "numbers c1 c2 ... [N/(rad/s)^i]") ||
      !ReadPolynomialSide(config, "polynomial_forward", 0, out)) {
    return false;
  }
  if ((out->limit[1] > 0) != config.Has("polynomial_reverse")) {
    return config.Fail("polynomial_reverse and a second number of rad_s_max go together");
  }
  return out->limit[1] <= 0 || ReadPolynomialSide(config, "polynomial_reverse", 1, out);
}

bool ReadOwnTable(const Config& config, Thruster* out) {
  const char* allowed =
      "t200, or two or more pairs `pulse thrust` [us] [N], pulse rising, thrust "
      "not falling, zero at 1500 us (or at the first pulse: no reverse)";
  std::vector<mjtNum> numbers;
  for (const std::string& word : Split(config.Text("table"))) {
    mjtNum number;
    if (!ParseNumber(word, &number)) return config.Refuse("table", allowed);
    numbers.push_back(number);
  }
  if (numbers.size() < 4 || numbers.size() % 2) return config.Refuse("table", allowed);
  for (size_t i = 0; i < numbers.size(); i += 2) {
    const Knot knot = {numbers[i], numbers[i + 1]};
    if (!out->table.empty() &&
        (knot.command <= out->table.back().command || knot.thrust < out->table.back().thrust)) {
      return config.Refuse(
          "table", std::string(allowed) + " (pair " + std::to_string(i / 2 + 1) + " is not)");
    }
    out->table.push_back(knot);
  }
  const bool reverse = out->table.front().thrust < 0;
  const mjtNum neutral = reverse ? 1500 : out->table.front().command;
  if (Interpolate(out->table, neutral) != 0 || out->table.back().thrust <= 0) {
    return config.Refuse("table", allowed);
  }
  const mjtNum pwm[3] = {out->table.front().command, neutral, out->table.back().command};
  mju_copy3(out->pwm, pwm);
  return Require(config, "thrust_coefficient", "1 or 2 numbers > 0 [N/(rad/s)^2], for the speed");
}

bool ReadTable(const Config& config, Thruster* out) {
  if (!Require(config, "table", "t200 or pairs `pulse thrust` [us] [N]")) return false;
  const bool t200 = config.Text("table") == "t200";
  if (t200) {
    mjtNum voltage = 16;
    if (!config.Number("voltage", kT200LowVoltage, kT200HighVoltage, "a number in 10..20 [V]",
                       &voltage)) {
      return false;
    }
    out->table = T200Table(voltage);
    mju_copy(out->curve.k, kT200Speed, 2);
  } else if (config.Has("voltage")) {
    return config.Fail("voltage needs table=\"t200\"");
  } else if (!ReadOwnTable(config, out)) {
    return false;
  }
  for (const char* key : {"rad_s_max", "dead_zone", "pwm_range"}) {
    if (config.Has(key))
      return config.Fail(std::string(key) + " does not go with a table, which holds it");
  }
  if (!ReadPair(config, "thrust_coefficient", kTiny, "1 or 2 numbers > 0 [N/(rad/s)^2]", 1,
                out->curve.k)) {
    return false;
  }
  out->limit[0] = SpeedForThrust(out->curve, out->table.back().thrust, kInfinity);
  out->limit[1] = -SpeedForThrust(out->curve, out->table.front().thrust, kInfinity);
  return true;
}

bool ReadCoefficients(const Config& config, const char* key, mjtNum out[3]) {
  std::vector<mjtNum> numbers;
  if (!config.Numbers(key, {1, 2, 3}, "1 to 3 numbers c0 c1 c2 [-], c0 > 0: c0 + c1 J + c2 J^2",
                      &numbers)) {
    return false;
  }
  for (size_t i = 0; i < numbers.size(); ++i) out[i] = numbers[i];
  return numbers.empty() || out[0] > 0 ||
         config.Refuse(key, "1 to 3 numbers c0 c1 c2 [-], c0 > 0: c0 + c1 J + c2 J^2");
}

bool ReadKind(const Config& config, Thruster* out) {
  if (!Require(config, "curve", "quadratic, polynomial, table or coefficients")) return false;
  const int kind = config.Word("curve", {"quadratic", "polynomial", "table", "coefficients"});
  if (kind < 0) return false;
  RotorCurve& curve = out->curve;
  curve.kind = static_cast<Curve>(kind);
  if (curve.kind == Curve::kPolynomial) return ReadPolynomial(config, out);
  if (curve.kind == Curve::kTable) return ReadTable(config, out);
  if (!ReadLimit(config, out)) return false;
  if (curve.kind == Curve::kQuadratic) {
    return Require(config, "thrust_coefficient", "1 or 2 numbers > 0 [N/(rad/s)^2]") &&
           ReadPair(config, "thrust_coefficient", kTiny, "1 or 2 numbers > 0 [N/(rad/s)^2]", 1,
                    curve.k);
  }
  return Require(config, "thrust_coefficients", "CT: 1 to 3 numbers c0 c1 c2 [-]") &&
         ReadCoefficients(config, "thrust_coefficients", curve.thrust_j) &&
         ReadCoefficients(config, "torque_coefficients", curve.torque_j) &&
         Require(config, "diameter", "a number > 0 [m]") &&
         ReadPair(config, "reverse_scale", kTiny, "1 or 2 numbers > 0 [-]: thrust (and torque)", 1,
                  curve.reverse);
}

// Keys that only one curve reads.
bool CheckUnused(const Config& config, Curve kind) {
  struct Owner {
    const char* key;
    bool used;
    const char* needs;
  };
  const bool table = kind == Curve::kTable, coefficients = kind == Curve::kCoefficients;
  const bool polynomial = kind == Curve::kPolynomial;
  const Owner owners[] = {{"table", table, "table"},
                          {"voltage", table, "table"},
                          {"polynomial_forward", polynomial, "polynomial"},
                          {"polynomial_reverse", polynomial, "polynomial"},
                          {"thrust_coefficients", coefficients, "coefficients"},
                          {"torque_coefficients", coefficients, "coefficients"},
                          {"reverse_scale", coefficients, "coefficients"},
                          {"thrust_coefficient", table || kind == Curve::kQuadratic, "quadratic"},
                          {"torque_ratio", !coefficients, "quadratic"}};
  for (const Owner& owner : owners) {
    if (config.Has(owner.key) && !owner.used) {
      return config.Fail(std::string(owner.key) + " needs curve=\"" + owner.needs + "\"");
    }
  }
  return true;
}

}  // namespace

bool ReadPair(const Config& config, const char* key, mjtNum low, const char* allowed, mjtNum other,
              mjtNum out[2]) {
  std::vector<mjtNum> numbers;
  if (!config.Numbers(key, {1, 2}, allowed, &numbers)) return false;
  if (numbers.empty()) return true;
  out[0] = numbers[0];
  out[1] = numbers.size() == 2 ? numbers[1] : other * numbers[0];
  return (numbers[0] >= low && numbers.back() >= low) || config.Refuse(key, allowed);
}

bool Require(const Config& config, const char* key, const char* what) {
  return config.Has(key) || config.Fail(std::string(key) + " is missing; give " + what);
}

bool ReadCurve(const Config& config, Thruster* out) {
  return ReadKind(config, out) && CheckUnused(config, out->curve.kind);
}

}  // namespace fluid_sim
