// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// From an autopilot's outputs to commands, as mavlink/actuator_map.py turns them.

#include "exchange/outputs.h"

#include <algorithm>
#include <cmath>

#include "api/api.h"

namespace fluid_sim {
namespace {

// y at x between points; the first and the last y beyond them.
double Interpolate(double x, const double* xs, const double* ys, int64_t n) {
  const int64_t i = std::upper_bound(xs, xs + n, x) - xs;
  if (i == 0) return ys[0];
  if (i == n) return ys[n - 1];
  return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
}

double Command(const OutputCurve& c, double value) {
  double share = 0.0;  // also where the value is no number
  if (c.rest < value && value < HUGE_VAL) {
    share = std::min((value - c.rest) * c.ahead, 1.0);
  } else if (-HUGE_VAL < value && value < c.rest && !(c.silent && value == 0)) {
    share = std::max((value - c.rest) * c.back, -1.0);
  }
  if (c.reversed) share = -share;
  if (c.kind == kT200) {
    const double thrust = Interpolate(1500.0 + 400.0 * share, c.pulses, c.thrusts, c.points);
    return std::min(std::max(thrust, c.low), c.high);
  }
  if (c.kind == kRotorSpeed) return share * share * (share >= 0 ? c.high : c.low);
  return share * (share >= 0 ? c.high : -c.low);
}

bool Finite(const double* values, int64_t n) {
  for (int64_t i = 0; i < n; ++i) {
    if (!std::isfinite(values[i])) return false;
  }
  return true;
}

// Saturate and write n finite commands; returns how many were beyond the limits.
int Write(const double* commands, int64_t n, const double* limits, const double* scale,
          const int64_t* ids, double* control) {
  int beyond = 0;
  for (int64_t i = 0; i < n; ++i) {
    const double command = std::min(std::max(commands[i], limits[i]), limits[n + i]);
    beyond += command != commands[i];
    control[ids[i]] = scale ? command / scale[i] : command;
  }
  return beyond;
}

int Write(const Controls& c, const double* commands) {
  return Write(commands, c.count, c.limits, c.scale, c.ids, c.control);
}

}  // namespace

bool Drive(Driven* d) {
  const int64_t count = d->thrusters.count + d->joints.count;
  for (int64_t i = 0; i < count; ++i) {
    d->commands[i] = Command(d->curves[i], d->outputs[d->curves[i].place]);
  }
  if (!Finite(d->commands, count)) return false;
  d->beyond = Write(d->thrusters, d->commands) + Write(d->joints, d->commands + d->thrusters.count);
  return true;
}

}  // namespace fluid_sim

using namespace fluid_sim;

// commands[i] of n curves from the outputs' values.
FSR_API void fsr_outputs(const OutputCurve* curves, int n, const double* outputs,
                         double* commands) {
  for (int i = 0; i < n; ++i) commands[i] = Command(curves[i], outputs[curves[i].place]);
}

// Check n commands, saturate them by limits (n low, then n high), divide by `scale` unless null,
// and write them to control[ids[i]]. Returns how many were beyond the limits, or -1 where one is
// not finite; then nothing is written.
FSR_API int fsr_command(const double* commands, int n, const double* limits, const double* scale,
                        const int64_t* ids, double* control) {
  return Finite(commands, n) ? Write(commands, n, limits, scale, ids, control) : -1;
}
