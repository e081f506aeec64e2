// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Intensity and length of atmospheric turbulence by height: MIL-F-8785C, 3.7.2 and 3.7.3.

#ifndef FLUID_SIM_MEDIUM_TURBULENCE_TABLES_H_
#define FLUID_SIM_MEDIUM_TURBULENCE_TABLES_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// Probabilities of exceedance that figure 7 has a curve for, as words, rising severity.
constexpr int kExceedances = 7;
extern const char* const kExceedanceWords[kExceedances];

struct Intensity {
  mjtNum sigma[3];  // of u, v, w [m/s]
  mjtNum slope[3];  // d(sigma)/d(height) [1/s]
};

// By the mean wind 6 m (20 ft) above the ground [m/s] up to 1000 ft, by the curve of figure 7 from
// 2000 ft on, linear between; the height [m] counts from 10 ft.
Intensity IntensityAt(mjtNum height, mjtNum wind_6m, int exceedance);

// Length scales of u, v, w [m] in the notation of MIL-F-8785C (twice that of MIL-HDBK-1797 for v
// and w): by height up to 1000 ft, from 2000 ft on `high`, linear between.
void LengthsAt(mjtNum height, mjtNum high, mjtNum length[3]);

// Length scale above 2000 ft [m]: 1750 ft (Dryden), 2500 ft (von Karman).
constexpr mjtNum kFoot = 0.3048;
constexpr mjtNum kDrydenLength = 1750 * kFoot, kVonKarmanLength = 2500 * kFoot;

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_TURBULENCE_TABLES_H_
