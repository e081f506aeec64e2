// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "thruster/thruster_curve.h"

#include <algorithm>
#include <cmath>

#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// sum of c_i x^(i+1)
mjtNum Polynomial(const std::vector<mjtNum>& c, mjtNum x) {
  mjtNum value = 0;
  for (size_t i = c.size(); i-- > 0;) value = (value + c[i]) * x;
  return value;
}

// The root of a rising polynomial in [0, limit]. Bisection to the last bit: no start value, no
// failure, the same result everywhere; 60 evaluations of a few products.
mjtNum PolynomialRoot(const std::vector<mjtNum>& c, mjtNum value, mjtNum limit) {
  mjtNum low = 0, high = limit;
  for (int i = 0; i < 60; ++i) {
    const mjtNum middle = 0.5 * (low + high);
    (Polynomial(c, middle) < value ? low : high) = middle;
  }
  return high;
}

// rho D^4 (c1 |n| V/D + c2 V|V|/D^2)
mjtNum InflowPart(const RotorCurve& curve, const mjtNum c[3], mjtNum omega, mjtNum inflow) {
  const mjtNum n = std::abs(omega) / (2 * kPi), d = curve.diameter;
  return curve.density * d * d * inflow * (c[1] * n * d + c[2] * std::abs(inflow));
}

}  // namespace

mjtNum StaticThrust(const RotorCurve& curve, mjtNum omega) {
  const int side = omega < 0 ? 1 : 0;
  if (curve.kind == Curve::kPolynomial) {
    const mjtNum size = Polynomial(curve.polynomial[side], std::abs(omega));
    return side ? -size : size;
  }
  return curve.k[side] * omega * std::abs(omega);
}

mjtNum SpeedForThrust(const RotorCurve& curve, mjtNum thrust, mjtNum limit) {
  const int side = thrust < 0 ? 1 : 0;
  if (thrust == 0 || limit <= 0) return 0;
  mjtNum size;
  if (curve.kind == Curve::kPolynomial) {
    size = PolynomialRoot(curve.polynomial[side], std::abs(thrust), limit);
  } else {
    size = std::min(std::sqrt(std::abs(thrust) / curve.k[side]), limit);
  }
  return side ? -size : size;
}

mjtNum InflowThrust(const RotorCurve& curve, mjtNum omega, mjtNum inflow) {
  if (curve.kind != Curve::kCoefficients) return 0;
  return InflowPart(curve, curve.thrust_j, omega, inflow);
}

mjtNum InflowTorque(const RotorCurve& curve, mjtNum omega, mjtNum inflow) {
  if (curve.kind != Curve::kCoefficients) return 0;
  return curve.diameter * InflowPart(curve, curve.torque_j, omega, inflow);
}

mjtNum StaticTorque(const RotorCurve& curve, mjtNum omega, mjtNum static_thrust) {
  if (curve.kind != Curve::kCoefficients) return curve.torque_ratio * static_thrust;
  const mjtNum n = omega / (2 * kPi), d = curve.diameter;
  const mjtNum scale = omega < 0 ? curve.reverse[1] : 1;
  return curve.density * d * d * d * d * d * curve.torque_j[0] * scale * n * std::abs(n);
}

mjtNum Interpolate(const std::vector<Knot>& table, mjtNum command) {
  if (command <= table.front().command) return table.front().thrust;
  if (command >= table.back().command) return table.back().thrust;
  size_t i = 1;
  while (table[i].command < command) ++i;
  const Knot &low = table[i - 1], &high = table[i];
  const mjtNum share = (command - low.command) / (high.command - low.command);
  return (1 - share) * low.thrust + share * high.thrust;  // exact at both ends
}

LaggedSpeed Follow(const Lag& lag, mjtNum start, mjtNum target, mjtNum elapsed) {
  if (start * target < 0) {  // through zero first
    const mjtNum crossing = lag.down > 0 ? lag.down * std::log1p(-start / target) : 0;
    if (elapsed < crossing) {
      const mjtNum omega = target + (start - target) * std::exp(-elapsed / lag.down);
      return {omega, (target - omega) / lag.down};
    }
    elapsed -= crossing;
    start = 0;
  }
  const mjtNum tau = std::abs(target) >= std::abs(start) ? lag.up : lag.down;
  if (tau <= 0) return {target, 0};
  const mjtNum omega = target + (start - target) * std::exp(-elapsed / tau);
  return {omega, (target - omega) / tau};
}

mjtNum DiscShare(mjtNum depth, mjtNum radius, mjtNum axis_z) {
  // a level disc would leap: let it count as tilted by at least 0.1 rad
  const mjtNum reach =
      radius * std::max<mjtNum>(std::sqrt(std::max<mjtNum>(1 - axis_z * axis_z, 0)), 0.1);
  const mjtNum p = std::clamp<mjtNum>(depth / reach, -1, 1);
  return 0.5 + (p * std::sqrt(1 - p * p) + std::asin(p)) / kPi;
}

}  // namespace fluid_sim
