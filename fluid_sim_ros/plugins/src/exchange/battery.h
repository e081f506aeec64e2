// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// A battery that a vehicle's thrusters draw on; the twin of mavlink/battery.py, which see.

#ifndef FLUID_SIM_EXCHANGE_BATTERY_H_
#define FLUID_SIM_EXCHANGE_BATTERY_H_

#include <cstdint>

namespace fluid_sim {

struct Battery {
  double voltage, current;      // at its terminals [V], [A]
  double used, left;            // charge that was drawn [Ah], share of the capacity that is left
  double full, empty;           // voltages without load [V]
  double capacity, resistance;  // [Ah], [ohm]
  double idle, full_current;    // [A]
  int64_t thrusters;
  const double* limits;  // largest thrust of each [N]
};

// Use it for a while: `thrusts` of all thrusters [N].
void Draw(Battery* b, const double* thrusts, double seconds);

}  // namespace fluid_sim

#endif  // FLUID_SIM_EXCHANGE_BATTERY_H_
