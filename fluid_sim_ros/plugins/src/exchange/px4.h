// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The two messages of every exchange with PX4: HIL_SENSOR out, HIL_ACTUATOR_CONTROLS in.

#ifndef FLUID_SIM_EXCHANGE_PX4_H_
#define FLUID_SIM_EXCHANGE_PX4_H_

#include <cstdint>

#include "exchange/instruments.h"

namespace fluid_sim {

constexpr int kLongestFrame = 280;  // of MAVLink 2 [bytes]
constexpr int kPx4Outputs = 16;

// What HIL_SENSOR is made from; instruments that a vehicle lacks are null.
struct Px4Sensors {
  Carrier carrier;
  Instrument *imu, *magnetometer, *barometer, *airspeed;
  int64_t given;       // the pressure below is sent instead of the barometer's
  double pressure[3];  // [Pa], altitude that has it [m], temperature [K]
};

// What one HIL_ACTUATOR_CONTROLS says.
struct Px4Answer {
  uint64_t time_us, flags;
  double controls[kPx4Outputs];
  int64_t mode;
};

// Write HIL_SENSOR of the readings at `tick` to `frame` (at least kLongestFrame bytes). Returns its
// size, or -1 - i where instrument i (in the order of Px4Sensors) first needs the noise of its
// block.
int WriteSensors(Px4Sensors* s, int64_t tick, uint64_t time_us, int sequence, int system,
                 int component, uint8_t* frame);

// Read bytes that may be one whole, sound, unsigned HIL_ACTUATOR_CONTROLS; returns whether.
bool ReadAnswer(const uint8_t* data, int64_t size, Px4Answer* out);

}  // namespace fluid_sim

#endif  // FLUID_SIM_EXCHANGE_PX4_H_
