// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// From the command to the speed of a rotor, and what it does at rest at that speed.

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "thruster/thruster.h"

namespace fluid_sim {
namespace {

// Pulse width [us] of a command in -1..1.
mjtNum PulseWidth(const mjtNum pwm[3], mjtNum command) {
  return pwm[1] + command * (command < 0 ? pwm[1] - pwm[0] : pwm[2] - pwm[1]);
}

// Speed beyond the dead zone, linear in the pulse width.
mjtNum SpeedForPulse(const Thruster& t, mjtNum pulse) {
  if (pulse > t.dead[1]) return t.limit[0] * (pulse - t.dead[1]) / (t.pwm[2] - t.dead[1]);
  if (pulse < t.dead[0]) return -t.limit[1] * (t.dead[0] - pulse) / (t.dead[0] - t.pwm[0]);
  return 0;
}

// By the bits: a zero of another sign is another number.
bool SameBits(const mjtNum a, const mjtNum b) {
  std::uint64_t x, y;
  std::memcpy(&x, &a, sizeof(a));
  std::memcpy(&y, &b, sizeof(b));
  return x == y;
}

bool SameBits3(const mjtNum a[3], const mjtNum b[3]) {
  return SameBits(a[0], b[0]) && SameBits(a[1], b[1]) && SameBits(a[2], b[2]);
}

}  // namespace

mjtNum CommandedSpeed(const Thruster& t, mjtNum command, bool* saturated) {
  mjtNum low = -t.limit[1], high = t.limit[0];  // rad/s
  if (t.command == Command::kNormalized) {
    low = t.limit[1] > 0 ? -1 : 0, high = 1;
  } else if (t.command == Command::kPwm) {
    low = t.table.empty() ? t.pwm[0] : t.table.front().command;
    high = t.table.empty() ? t.pwm[2] : t.table.back().command;
  } else if (t.command == Command::kNewton) {
    low = t.table.empty() ? StaticThrust(t.curve, low) : t.table.front().thrust;
    high = t.table.empty() ? StaticThrust(t.curve, high) : t.table.back().thrust;
  }
  const mjtNum kept = std::clamp(command, low, high);
  *saturated |= kept != command;
  if (t.command == Command::kRadPerS) return kept;
  mjtNum thrust = kept;
  if (t.command != Command::kNewton) {
    const mjtNum pulse = t.command == Command::kPwm ? kept : PulseWidth(t.pwm, kept);
    if (t.table.empty()) return SpeedForPulse(t, pulse);
    thrust = Interpolate(t.table, pulse);
  }
  return SpeedForThrust(t.curve, thrust, t.limit[thrust < 0 ? 1 : 0]);
}

const RotorState& PresentState(const mjModel* m, const mjData* d, const Thruster& t,
                               mjtNum command) {
  const mjtNum* act = t.lagged ? d->act + m->actuator_actadr[t.thrust] : nullptr;
  const mjtNum asked[3] = {command, act ? act[0] : 0, act ? act[1] : 0};
  KeptState& kept = t.kept;
  RotorState& state = kept.state;
  if (kept.any && SameBits3(asked, kept.asked)) return state;
  if (!kept.any || !SameBits(asked[0], kept.asked[0])) {
    state.saturated = false;
    state.target = CommandedSpeed(t, command, &state.saturated);
  }
  const LaggedSpeed speed =
      t.lagged ? Follow(t.lag, asked[1], state.target, asked[2]) : LaggedSpeed{state.target, 0};
  state.omega = speed.omega;
  state.rate = speed.rate;
  state.thrust = StaticThrust(t.curve, state.omega);
  state.torque = StaticTorque(t.curve, state.omega, state.thrust);
  std::copy(asked, asked + 3, kept.asked);
  kept.any = true;
  return state;
}

}  // namespace fluid_sim
