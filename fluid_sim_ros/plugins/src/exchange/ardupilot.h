// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The reply to ArduPilot at the end of each frame.

#ifndef FLUID_SIM_EXCHANGE_ARDUPILOT_H_
#define FLUID_SIM_EXCHANGE_ARDUPILOT_H_

#include <cstdint>

#include "exchange/instruments.h"

namespace fluid_sim {

constexpr int kLongestReply = 4096;  // [bytes]
constexpr int kChannels = 18;        // of a radio control

// What a reply is made from; what a vehicle lacks is null.
struct ArduPilotState {
  Carrier carrier;
  Instrument *airspeed, *rangefinder;
  int64_t aerial;             // it meets wind
  double sea_density;         // of the standard atmosphere at sea level [kg/m^3]
  double indicated;           // airspeed of the last reading [m/s]
  double distance;            // of the last reading [m]
  int64_t channels;           // of the radio control: 0 for none
  int64_t pulses[kChannels];  // [us]
  int64_t metered;            // there is a battery
  double voltage, current;    // [V], [A]
};

// Write the reply for the time `time_s` by the autopilot's clock. Returns its size, 0 where it
// does not fit, or -1 - i where instrument i (airspeed, rangefinder) first needs its noise.
int WriteReply(ArduPilotState* s, int64_t tick, double time_s, char* text, int64_t capacity);

}  // namespace fluid_sim

#endif  // FLUID_SIM_EXCHANGE_ARDUPILOT_H_
