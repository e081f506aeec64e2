// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "medium/turbulence_tables.h"

#include <algorithm>
#include <cmath>

namespace fluid_sim {
namespace {

constexpr mjtNum kLowest = 10, kLow = 1000, kHigh = 2000;  // [ft]

// MIL-F-8785C, figure 7: rms turbulence [ft/s] over the altitude [ft], one row per probability.
constexpr int kAltitudes = 12;
constexpr mjtNum kAltitude[kAltitudes] = {500,   1750,  3750,  7500,  15000, 25000,
                                          35000, 45000, 55000, 65000, 75000, 80000};
constexpr mjtNum kRms[kExceedances][kAltitudes] = {
    {3.2, 2.2, 1.5, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    {4.2, 3.6, 3.3, 1.6, 0, 0, 0, 0, 0, 0, 0, 0},
    {6.6, 6.9, 7.4, 6.7, 4.6, 2.7, 0.4, 0, 0, 0, 0, 0},
    {8.6, 9.6, 10.6, 10.1, 8.0, 6.6, 5.0, 4.2, 2.7, 0, 0, 0},
    {11.8, 13.0, 16.0, 15.1, 11.6, 9.7, 8.1, 8.2, 7.9, 4.9, 3.2, 2.1},
    {15.6, 17.6, 23.0, 23.6, 22.1, 20.0, 16.0, 15.1, 12.1, 7.9, 6.2, 5.1},
    {18.7, 21.5, 28.4, 30.2, 30.7, 31.0, 25.2, 23.1, 17.5, 10.7, 8.4, 7.2}};

struct Line {
  mjtNum value, slope;
};

// Rms at an altitude [ft/s] and its slope [1/s].
Line RmsAt(const mjtNum* row, mjtNum feet) {
  if (!(feet > kAltitude[0])) return {row[0], 0};  // NaN too
  if (feet >= kAltitude[kAltitudes - 1]) return {row[kAltitudes - 1], 0};
  const int i = std::upper_bound(kAltitude, kAltitude + kAltitudes, feet) - kAltitude;
  const mjtNum slope = (row[i] - row[i - 1]) / (kAltitude[i] - kAltitude[i - 1]);
  return {row[i - 1] + slope * (feet - kAltitude[i - 1]), slope};
}

}  // namespace

const char* const kExceedanceWords[kExceedances] = {"2e-1", "1e-1", "1e-2", "1e-3",
                                                    "1e-4", "1e-5", "1e-6"};

Intensity IntensityAt(mjtNum height, mjtNum wind_6m, int exceedance) {
  const mjtNum feet = height / kFoot, low = 0.1 * wind_6m;
  if (feet <= kLow) {
    const mjtNum base = 0.177 + 0.000823 * std::max(feet, kLowest);
    const mjtNum horizontal = low / std::pow(base, 0.4);
    const mjtNum slope = feet < kLowest ? 0 : -0.4 * 0.000823 / kFoot * horizontal / base;
    return {{horizontal, horizontal, low}, {slope, slope, 0}};
  }
  const mjtNum* row = kRms[exceedance];
  Line line = RmsAt(row, std::max(feet, kHigh));
  line.value *= kFoot;
  if (feet < kHigh) {
    line.slope = (line.value - low) / (kHigh - kLow) / kFoot;
    line.value = low + line.slope * kFoot * (feet - kLow);
  }
  return {{line.value, line.value, line.value}, {line.slope, line.slope, line.slope}};
}

void LengthsAt(mjtNum height, mjtNum high, mjtNum length[3]) {
  const mjtNum feet = std::max(height / kFoot, kLowest);
  if (feet > kLow) {
    const mjtNum share = std::min<mjtNum>((feet - kLow) / (kHigh - kLow), 1);
    const mjtNum value = kLow * kFoot + share * (high - kLow * kFoot);
    length[0] = length[1] = length[2] = value;
    return;
  }
  length[2] = feet * kFoot;
  length[0] = length[1] = length[2] / std::pow(0.177 + 0.000823 * feet, 1.2);
}

}  // namespace fluid_sim
