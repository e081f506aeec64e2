// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The two messages of every exchange with PX4: HIL_SENSOR out, HIL_ACTUATOR_CONTROLS in.
//
// The same bytes as mavlink/px4/hil_state.py and hil_messages.py write; see there for units, axes
// and rates. https://mavlink.io/en/messages/common.html has the fields.

#include <cmath>

#include "api/api.h"
#include "exchange/frame.h"
#include "exchange/instruments.h"

namespace fluid_sim {
namespace {

// Ids, and the bytes that stand for the definitions in checksums.
constexpr uint32_t kHilSensor = 107, kHilActuatorControls = 93;
constexpr uint8_t kSensorExtra = 108, kControlsExtra = 47;
constexpr int kSensorSize = 65, kControlsSize = 81;  // of whole payloads [bytes]

// Bits of HIL_SENSOR.fields_updated.
constexpr uint32_t kImuBits = 0x03F, kFieldBits = 0x1C0, kPressureBits = 0x1A00,
                   kAirspeedBits = 0x400;
constexpr double kGauss = 1e4, kHectopascal = 1e-2, kCelsius = -273.15;

}  // namespace
}  // namespace fluid_sim

using namespace fluid_sim;

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
  double controls[16];
  int64_t mode;
};

// Write HIL_SENSOR of the readings at `tick` to `frame` (at least 80 bytes). Returns its size, or
// -1 - i where instrument i (in the order of Px4Sensors) first needs the noise of its block.
FSR_API int fsr_px4_sensors(Px4Sensors* s, int64_t tick, uint64_t time_us, int sequence, int system,
                            int component, uint8_t* frame) {
  Instrument* instruments[] = {s->imu, s->magnetometer, s->barometer, s->airspeed};
  for (int i = 0; i < 4; ++i) {
    if (instruments[i] && !Look(s->carrier, instruments[i], tick)) return -1 - i;
  }
  uint32_t bits = kImuBits;
  uint8_t* at = frame + kHead;
  Put<uint64_t>(&at, time_us);
  for (int k = 0; k < 6; k += 3) {  // FLU to FRD
    const double* v = s->imu->values + k;
    Put(&at, static_cast<float>(v[0]));
    Put(&at, static_cast<float>(-v[1]));
    Put(&at, static_cast<float>(-v[2]));
  }
  double field[3] = {0, 0, 0}, pressure = 0, differential = 0, altitude = 0, temperature = 0;
  if (s->magnetometer && s->magnetometer->fresh) {
    const double* v = s->magnetometer->values;
    field[0] = kGauss * v[0];
    field[1] = -kGauss * v[1];
    field[2] = -kGauss * v[2];
    bits |= kFieldBits;
  }
  if (s->given || (s->barometer && s->barometer->fresh)) {
    const double pascal = s->given ? s->pressure[0] : s->barometer->values[0];
    altitude = s->given ? s->pressure[1] : PressureAltitude(pascal);
    temperature = (s->given ? s->pressure[2] : StandardTemperature(altitude)) + kCelsius;
    pressure = kHectopascal * pascal;
    bits |= kPressureBits;
  }
  if (s->airspeed && s->airspeed->fresh) {
    differential = kHectopascal * s->airspeed->values[0];
    bits |= kAirspeedBits;
  }
  for (double v : field) Put(&at, static_cast<float>(v));
  for (double v : {pressure, differential, altitude, temperature}) Put(&at, static_cast<float>(v));
  Put<uint32_t>(&at, bits);
  Put<uint8_t>(&at, 0);  // number of the sensor
  static_assert(8 + 13 * 4 + 4 + 1 == kSensorSize, "HIL_SENSOR");
  return CloseFrame(frame, kSensorSize, kHilSensor, kSensorExtra, static_cast<uint8_t>(sequence),
                    static_cast<uint8_t>(system), static_cast<uint8_t>(component));
}

// Read bytes that may be one whole, sound, unsigned HIL_ACTUATOR_CONTROLS; returns whether.
FSR_API int fsr_px4_answer(const uint8_t* data, int64_t size, Px4Answer* out) {
  const int64_t payload = size - kHead - kChecksum;
  if (payload < 1 || payload > kControlsSize) return 0;
  if (data[0] != kMagic || data[1] != payload || data[2] != 0) return 0;
  const uint32_t message = data[7] | data[8] << 8 | static_cast<uint32_t>(data[9]) << 16;
  if (message != kHilActuatorControls) return 0;
  const uint8_t* end = data + size - kChecksum;
  if (Get<uint16_t>(&end) != Checksum(data + 1, static_cast<int>(size) - 3, kControlsExtra)) {
    return 0;
  }
  uint8_t whole[kControlsSize] = {};
  std::memcpy(whole, data + kHead, payload);
  const uint8_t* at = whole;
  out->time_us = Get<uint64_t>(&at);
  out->flags = Get<uint64_t>(&at);
  for (double& control : out->controls) control = Get<float>(&at);
  out->mode = Get<uint8_t>(&at);
  return 1;
}
