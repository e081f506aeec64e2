// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "thruster/inflow.h"

#include <cmath>

#include "shared/numbers.h"

namespace fluid_sim {
namespace {

constexpr mjtNum kStill = 1e-9;  // a rotor whose blades would push at less than this stands [m/s]

}  // namespace

LoadChange InflowChange(const InflowLoss& loss, mjtNum omega, mjtNum thrust, mjtNum inflow) {
  const int side = omega < 0 ? 1 : 0;
  const mjtNum sign = side ? -1 : 1, pitch_speed = loss.way[side] * std::abs(omega);
  if (loss.law == InflowLaw::kNone || pitch_speed < kStill) return {};
  const mjtNum x = sign * inflow / pitch_speed;
  if (loss.law == InflowLaw::kLinear) {
    const mjtNum measured = loss.measured[side];
    return {thrust * (measured - x) / (1 - measured), 0};
  }
  // w/V_p =: y solves (x + y) y = c (1 - x - y), c = h^2/(1 - h)
  const mjtNum h = loss.hover[side], c = h * h / (1 - h);
  const mjtNum y = 0.5 * (std::sqrt((x - c) * (x - c) + 4 * c) - (x + c));
  const mjtNum share = (1 - x - y) / (1 - h);
  return {thrust * (share - 1), loss.way[side] * thrust * (share * (x + y) - h)};
}

}  // namespace fluid_sim
