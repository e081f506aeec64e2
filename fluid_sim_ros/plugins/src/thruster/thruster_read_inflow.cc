// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Reads what the inflow takes of the thrust of a fluid_sim.thruster.

#include <algorithm>
#include <cmath>
#include <string>

#include "shared/numbers.h"
#include "thruster/thruster_read.h"

namespace fluid_sim {
namespace {

constexpr char kAdvance[] =
    "1 or 2 numbers > 0 [-]: V/(n D) at which the thrust vanishes, forward (and in reverse)";

// v_h/V_p: the flow that the disc draws at rest over the speed at which its thrust vanishes.
bool ReadHover(const Config& config, const Thruster& thruster, InflowLoss* loss) {
  const RotorCurve& curve = thruster.curve;
  const mjtNum area = kPi / 4 * curve.diameter * curve.diameter;
  for (int side = 0; side < 2; ++side) {
    const mjtNum drawn = std::sqrt(curve.k[side] / (2 * curve.density * area));  // per speed [m]
    loss->hover[side] = drawn / loss->way[side];
    if (loss->hover[side] < 1 || thruster.limit[side] <= 0) continue;
    const mjtNum least = drawn * 2 * kPi / curve.diameter;
    return config.Refuse("zero_thrust_advance",
                         "above " + std::to_string(least) +
                             " with inflow_law momentum: at less the disc draws more at rest than "
                             "its blades can push (a duct: inflow_law linear)");
  }
  return true;
}

}  // namespace

bool ReadInflow(const Config& config, Thruster* out) {
  const int on = config.Word("inflow", {"false", "true"});
  const int law = config.Word("inflow_law", {"linear", "momentum"});
  mjtNum advance[2] = {0, 0};
  if (on < 0 || law < 0 || !ReadPair(config, "zero_thrust_advance", kTiny, kAdvance, 1, advance)) {
    return false;
  }
  if (!config.Has("zero_thrust_advance")) {
    const bool asked = on || config.Has("inflow_law") || config.Has("measured_advance");
    return !asked || Require(config, "zero_thrust_advance", kAdvance);
  }
  const Curve kind = out->curve.kind;
  if (kind != Curve::kQuadratic && kind != Curve::kTable) {
    return config.Fail(
        "zero_thrust_advance needs curve=\"quadratic\" or \"table\" (coefficients have the inflow "
        "in c1 and c2)");
  }
  if (!Require(config, "diameter", "a number > 0 [m]")) return false;
  InflowLoss loss;
  loss.law = law ? InflowLaw::kMomentum : InflowLaw::kLinear;
  mjtNum measured = 0;
  const char* below = "a number >= 0 [-], below zero_thrust_advance; with inflow_law linear only";
  if (!config.Number("measured_advance", 0, kInfinity, below, &measured)) return false;
  if (measured >= std::min(advance[0], advance[1]) || (law && measured > 0)) {
    return config.Refuse("measured_advance", below);
  }
  for (int side = 0; side < 2; ++side) {
    loss.measured[side] = measured / advance[side];
    loss.way[side] = advance[side] * out->curve.diameter / (2 * kPi);
  }
  if (law && !ReadHover(config, *out, &loss)) return false;
  if (on) out->loss = loss;
  return true;
}

}  // namespace fluid_sim
