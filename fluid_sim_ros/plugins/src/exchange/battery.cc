// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "exchange/battery.h"

#include <algorithm>
#include <cmath>

#include "api/api.h"

namespace fluid_sim {
namespace {

constexpr double kHour = 3600.0;  // [s]
constexpr double kPower = 1.5;    // of the thrust, to which current goes

}  // namespace

void Draw(Battery* b, const double* thrusts, double seconds) {
  double shares = 0.0;
  for (int64_t i = 0; i < b->thrusters; ++i) {
    shares += std::pow(std::fabs(thrusts[i]) / b->limits[i], kPower);
  }
  b->current = b->idle + b->full_current * shares / static_cast<double>(b->thrusters);
  b->used += b->current * seconds / kHour;
  b->left = std::max(0.0, 1.0 - b->used / b->capacity);
  const double open = b->empty + b->left * (b->full - b->empty);
  b->voltage = std::max(0.0, open - b->resistance * b->current);
}

}  // namespace fluid_sim

FSR_API void fsr_draw(fluid_sim::Battery* battery, const double* thrusts, double seconds) {
  Draw(battery, thrusts, seconds);
}
