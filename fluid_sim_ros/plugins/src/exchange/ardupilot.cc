// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The reply to ArduPilot at the end of each frame: one line of JSON.
//
// The same bytes as mavlink/ardupilot/json_state.py and json_packets.py write; see there for units
// and axes. Numbers are written as printf writes them, whatever the process's locale.

#include "exchange/ardupilot.h"

#include <charconv>
#include <cmath>
#include <cstring>

#include "api/api.h"
#include "shared/numbers.h"

namespace fluid_sim {
namespace {

constexpr double kOutOfRange = 1000.0;     // what a rangefinder without an echo says [m]
constexpr double kStraight = 1.0 - 1e-12;  // sine of the pitch that counts as straight up
const double kHalf = std::sqrt(0.5);

// Writes text up to the end of a buffer, which the longest reply does not reach.
class Text {
 public:
  Text(char* begin, char* end) : begin_(begin), at_(begin), end_(end) {}

  Text& operator<<(const char* words) {
    const size_t size = std::strlen(words);
    if (size <= static_cast<size_t>(end_ - at_)) {
      std::memcpy(at_, words, size);
      at_ += size;
    } else {
      full_ = true;
    }
    return *this;
  }

  // As "%.<precision>g", or "%.<precision>f" where `fixed`.
  Text& Number(double value, int precision, bool fixed = false) {
    if (std::isnan(value)) return *this << "nan";  // printf may write -nan
    const auto format = fixed ? std::chars_format::fixed : std::chars_format::general;
    const auto [to, fault] = std::to_chars(at_, end_, value, format, precision);
    full_ |= fault != std::errc();
    if (fault == std::errc()) at_ = to;
    return *this;
  }

  Text& Numbers(const double* values, int n, int precision) {
    *this << "[";
    for (int i = 0; i < n; ++i) {
      if (i) *this << ",";
      Number(values[i], precision);
    }
    return *this << "]";
  }

  Text& Integer(int64_t value) {
    const auto [to, fault] = std::to_chars(at_, end_, value);
    full_ |= fault != std::errc();
    if (fault == std::errc()) at_ = to;
    return *this;
  }

  int size() const { return full_ ? 0 : static_cast<int>(at_ - begin_); }

 private:
  char *begin_, *at_, *end_;
  bool full_ = false;
};

void EnuToNed(const double* enu, double* ned) {
  const double east = enu[0];
  ned[0] = enu[1];
  ned[1] = east;
  ned[2] = -enu[2];
}

void FluToFrd(const double* flu, double* frd) {
  frd[0] = flu[0];
  frd[1] = -flu[1];
  frd[2] = -flu[2];
}

// Rotation FRD to NED of a rotation FLU to ENU; see mavlink/ned.py.
void AttitudeToNed(const double* q, double* ned) {
  ned[0] = kHalf * (q[0] + q[3]);
  ned[1] = kHalf * (q[1] + q[2]);
  ned[2] = kHalf * (q[1] - q[2]);
  ned[3] = kHalf * (q[0] - q[3]);
}

// Roll, pitch and yaw [rad]; see mavlink/ned.py.
void Euler(const double* q, double* angles) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double sine = 2.0 * (w * y - z * x);
  if (std::fabs(sine) > kStraight) {
    angles[0] = 0.0;
    angles[1] = std::copysign(kPi / 2.0, sine);
    angles[2] = std::remainder(-2.0 * std::copysign(1.0, sine) * std::atan2(x, w), 2.0 * kPi);
    return;
  }
  angles[0] = std::atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y));
  angles[1] = std::asin(sine);
  angles[2] = std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
}

}  // namespace

int WriteReply(ArduPilotState* s, int64_t tick, double time_s, char* text, int64_t capacity) {
  Instrument* instruments[] = {s->airspeed, s->rangefinder};
  for (int i = 0; i < 2; ++i) {
    if (instruments[i] && !Look(s->carrier, instruments[i], tick)) return -1 - i;
  }
  if (s->airspeed && s->airspeed->fresh) {
    const double q = s->airspeed->values[0];
    s->indicated = std::copysign(std::sqrt(2.0 * std::fabs(q) / s->sea_density), q);
  }
  if (s->rangefinder && s->rangefinder->fresh) s->distance = s->rangefinder->values[0];

  const double* row = s->carrier.row;
  mjtNum velocity_w[3];
  double gyro[3], force[3], position[3], attitude[4], angles[3], velocity[3], air[3];
  mju_rotVecQuat(velocity_w, row + kLinearVelocity, row + kQuaternion);
  FluToFrd(row + kAngularVelocity, gyro);
  FluToFrd(row + kSpecificForce, force);
  EnuToNed(row + kPosition, position);
  AttitudeToNed(row + kQuaternion, attitude);
  Euler(attitude, angles);
  EnuToNed(velocity_w, velocity);

  Text out(text, text + capacity);
  out << "\n{\"timestamp\":";
  out.Number(time_s, 10, true) << ",\"imu\":{\"gyro\":";
  out.Numbers(gyro, 3, 9) << ",\"accel_body\":";
  out.Numbers(force, 3, 9) << "},\"position\":";
  out.Numbers(position, 3, 12) << ",\"attitude\":";
  out.Numbers(angles, 3, 9) << ",\"quaternion\":";
  out.Numbers(attitude, 4, 9) << ",\"velocity\":";
  out.Numbers(velocity, 3, 9);
  if (s->aerial) {
    EnuToNed(row + kMediumVelocity, air);
    out << ",\"velocity_wind\":";
    out.Numbers(air, 3, 9);
  }
  if (s->airspeed) {
    out << ",\"airspeed\":";
    out.Number(s->indicated, 9);
  }
  if (s->rangefinder) {
    out << ",\"rng_1\":";
    out.Number(std::fmin(std::fmax(s->distance, 0.0), kOutOfRange), 9);
  }
  if (s->aerial) {  // where the wind comes from, clockwise from ahead, as the vehicle meets it
    const double north = velocity[0] - air[0], east = velocity[1] - air[1];
    const double speed = std::sqrt(north * north + east * east);
    double direction = 0.0;
    if (speed != 0.0) direction = std::remainder(std::atan2(east, north) - angles[2], 2.0 * kPi);
    out << ",\"windvane\":{\"direction\":";
    out.Number(direction, 9) << ",\"speed\":";
    out.Number(speed, 9) << "}";
  }
  if (s->channels) {
    out << ",\"rc\":{";
    for (int64_t i = 0; i < s->channels; ++i) {
      out << (i ? ",\"rc_" : "\"rc_");
      out.Integer(i + 1) << "\":";
      out.Integer(s->pulses[i]);
    }
    out << "}";
  }
  if (s->metered) {
    out << ",\"battery\":{\"voltage\":";
    out.Number(s->voltage, 6) << ",\"current\":";
    out.Number(s->current, 6) << "}";
  }
  out << "}\n";
  return out.size();
}

}  // namespace fluid_sim

using namespace fluid_sim;

FSR_API int fsr_ardupilot_state(ArduPilotState* s, int64_t tick, double time_s, char* text,
                                int64_t capacity) {
  return WriteReply(s, tick, time_s, text, capacity);
}
