// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Sensors as an autopilot gets them: the true value at a state, and the errors of its reading.
//
// Each does what its class in fluid_sim_ros/sensors does, in the same order of operations, so that
// both give the same bits. The layout of the structs is that of plugins/exchange.py.

#ifndef FLUID_SIM_EXCHANGE_INSTRUMENTS_H_
#define FLUID_SIM_EXCHANGE_INSTRUMENTS_H_

#include <mujoco/mujoco.h>

#include <cstdint>

namespace fluid_sim {

constexpr int kLargestWidth = 6;
// Readings whose random numbers are drawn at once: BLOCK of sensors/noise.py.
constexpr int kNoiseBlock = 256;

enum InstrumentKind : int64_t { kImu, kMagnetometer, kBarometer, kAirspeed, kRangefinder };

// What the instruments of one vehicle sit on.
struct Carrier {
  const double* row;  // of fsr_observe
  const mjModel* model;
  const mjData* observed;  // evaluated at the same state
  int64_t base;            // body of base_link
};

// What is added to a number of a reading, and where it ends.
struct Axis {
  double quantum;       // 0: not rounded
  double low, high;     // range
  double below, above;  // what is read beyond it
};

struct Instrument {
  int64_t kind;         // InstrumentKind
  int64_t period;       // ticks between two readings
  int64_t width;        // numbers of a reading
  int64_t tick;         // of the last look; -1: none yet
  int64_t fresh;        // the last look found a new reading
  int64_t beyond;       // values beyond the range so far
  int64_t block;        // that `added` holds; -1: none
  const double* added;  // random numbers of a block of readings, kNoiseBlock x width
  Axis axes[kLargestWidth];
  double position_b[3];          // of its place in base_link [m]
  double rotation_sb[9];         // base_link axes to its own
  int64_t turned;                // 0: its axes are those of base_link
  double constants[5];           // by kind, see instruments.cc
  double values[kLargestWidth];  // the present reading
  const uint8_t* passed;         // of a rangefinder: whether rays pass each geom
};

// Measure where a reading is due at `tick`. Returns whether the noise of its block is there; if
// not, nothing was done.
bool Look(const Carrier& carrier, Instrument* instrument, int64_t tick);

// The standard atmosphere; see physics/environment/atmosphere.py. Altitudes [m], pressures [Pa],
// temperatures [K].
double StandardPressure(double altitude, double tropopause_pressure);
double StandardTemperature(double altitude);
double PressureAltitude(double pressure);

}  // namespace fluid_sim

#endif  // FLUID_SIM_EXCHANGE_INSTRUMENTS_H_
