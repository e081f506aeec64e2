// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The two messages of every exchange with PX4: HIL_SENSOR out, HIL_ACTUATOR_CONTROLS in.
//
// The same bytes as mavlink/px4/hil_state.py and hil_messages.py write; see there for units, axes
// and rates. https://mavlink.io/en/messages/common.html has the fields.

#include "exchange/px4.h"

#include <cmath>

#include "api/api.h"
#include "exchange/frame.h"

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

int WriteSensors(Px4Sensors* s, int64_t tick, uint64_t time_us, int sequence, int system,
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

bool ReadAnswer(const uint8_t* data, int64_t size, Px4Answer* out) {
  const int64_t payload = size - kHead - kChecksum;
  if (payload < 1 || payload > kControlsSize) return false;
  if (data[0] != kMagic || data[1] != payload || data[2] != 0) return false;
  const uint32_t message = data[7] | data[8] << 8 | static_cast<uint32_t>(data[9]) << 16;
  if (message != kHilActuatorControls) return false;
  const uint8_t* end = data + size - kChecksum;
  if (Get<uint16_t>(&end) != Checksum(data + 1, static_cast<int>(size) - 3, kControlsExtra)) {
    return false;
  }
  uint8_t whole[kControlsSize] = {};
  std::memcpy(whole, data + kHead, payload);
  const uint8_t* at = whole;
  out->time_us = Get<uint64_t>(&at);
  out->flags = Get<uint64_t>(&at);
  for (double& control : out->controls) control = Get<float>(&at);
  out->mode = Get<uint8_t>(&at);
  return true;
}

}  // namespace fluid_sim

using namespace fluid_sim;

FSR_API int fsr_px4_sensors(Px4Sensors* s, int64_t tick, uint64_t time_us, int sequence, int system,
                            int component, uint8_t* frame) {
  return WriteSensors(s, tick, time_us, sequence, system, component, frame);
}

FSR_API int fsr_px4_answer(const uint8_t* data, int64_t size, Px4Answer* out) {
  return ReadAnswer(data, size, out);
}
