// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "exchange/instruments.h"

#include <algorithm>
#include <cmath>

#include "api/api.h"

namespace fluid_sim {
namespace {

// ISO 2533:1975, sea level and troposphere; the same numbers as in atmosphere.py.
constexpr double kPressure = 101325.0;      // [Pa]
constexpr double kTemperature = 288.15;     // [K]
constexpr double kGravity = 9.80665;        // [m/s^2]
constexpr double kGasConstant = 287.05287;  // specific, of air [J/(kg K)]
constexpr double kLapse = -0.0065;          // [K/m]
constexpr double kTropopause = 11000.0;     // [m], geopotential
constexpr double kEarthRadius = 6356766.0;  // nominal, of the standard [m]
constexpr double kExponent = -kGravity / (kGasConstant * kLapse);
constexpr double kAtTropopause = 1.0 + kLapse * kTropopause / kTemperature;

// A ray steps over own and translucent geoms, at most this many; and goes on so far behind each
// [m].
constexpr int kPassed = 64;
constexpr double kStep = 1e-6;

double Geopotential(double altitude) { return kEarthRadius * altitude / (kEarthRadius + altitude); }

// The axes of base_link in the world, row by row.
struct Attitude {
  mjtNum m[9];
  explicit Attitude(const Carrier& carrier) { mju_quat2Mat(m, carrier.row + kQuaternion); }

  void ToBody(const double* w, double* b) const {
    for (int i = 0; i < 3; ++i) b[i] = m[i] * w[0] + m[3 + i] * w[1] + m[6 + i] * w[2];
  }
  void ToWorld(const double* b, double* w) const {
    for (int i = 0; i < 3; ++i) w[i] = m[3 * i] * b[0] + m[3 * i + 1] * b[1] + m[3 * i + 2] * b[2];
  }
};

void Place(const Carrier& carrier, const Instrument& s, const Attitude& attitude, double* place) {
  attitude.ToWorld(s.position_b, place);
  for (int i = 0; i < 3; ++i) place[i] = carrier.row[kPosition + i] + place[i];
}

void ToSensor(const Instrument& s, double* v) {
  if (!s.turned) return;
  const double *r = s.rotation_sb, x = v[0], y = v[1], z = v[2];
  for (int i = 0; i < 3; ++i) v[i] = r[3 * i] * x + r[3 * i + 1] * y + r[3 * i + 2] * z;
}

// f + a x r + w x (w x r); see sensors/imu.py.
bool MeasureImu(const Carrier& carrier, const Instrument& s, double* out) {
  const double* w = carrier.row + kAngularVelocity;
  const double* f = carrier.row + kSpecificForce;
  const double* a = carrier.row + kAngularAcceleration;
  const double* r = s.position_b;
  const double along = w[0] * r[0] + w[1] * r[1] + w[2] * r[2];
  const double square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  out[0] = f[0] + a[1] * r[2] - a[2] * r[1] + w[0] * along - square * r[0];
  out[1] = f[1] + a[2] * r[0] - a[0] * r[2] + w[1] * along - square * r[1];
  out[2] = f[2] + a[0] * r[1] - a[1] * r[0] + w[2] * along - square * r[2];
  for (int i = 0; i < 3; ++i) out[3 + i] = w[i];
  ToSensor(s, out);
  ToSensor(s, out + 3);
  return true;
}

// constants: the Earth's field [T], world axes.
bool MeasureField(const Carrier& carrier, const Instrument& s, double* out) {
  Attitude(carrier).ToBody(s.constants, out);
  ToSensor(s, out);
  return true;
}

// constants: surface [m], altitude of home [m], weight of water [N/m^3], pressure at the surface
// and at the tropopause [Pa].
bool MeasurePressure(const Carrier& carrier, const Instrument& s, double* out) {
  double place[3];
  Place(carrier, s, Attitude(carrier), place);
  const double depth = s.constants[0] - place[2];
  out[0] = depth > 0 ? s.constants[3] + s.constants[2] * depth
                     : StandardPressure(s.constants[1] + place[2], s.constants[4]);
  return true;
}

// constants: surface [m], density of the air [kg/m^3]. No reading below the surface.
bool MeasureAirspeed(const Carrier& carrier, const Instrument& s, double* out) {
  const Attitude attitude(carrier);
  const double* v = carrier.row + kLinearVelocity;
  const double* w = carrier.row + kAngularVelocity;
  const double* r = s.position_b;
  double medium[3], place[3];
  attitude.ToBody(carrier.row + kMediumVelocity, medium);
  double flow[3] = {v[0] + w[1] * r[2] - w[2] * r[1] - medium[0],
                    v[1] + w[2] * r[0] - w[0] * r[2] - medium[1],
                    v[2] + w[0] * r[1] - w[1] * r[0] - medium[2]};
  ToSensor(s, flow);
  out[0] = 0.5 * s.constants[1] * flow[0] * std::fabs(flow[0]);
  Place(carrier, s, attitude, place);
  return place[2] >= s.constants[0];
}

// constants: direction of the ray, base_link axes.
bool MeasureRange(const Carrier& carrier, const Instrument& s, double* out) {
  const Attitude attitude(carrier);
  const mjModel* m = carrier.model;
  double start[3], direction[3], from[3], gone = 0.0;
  Place(carrier, s, attitude, start);
  attitude.ToWorld(s.constants, direction);
  mju_copy3(from, start);
  out[0] = HUGE_VAL;
  for (int i = 0; i < kPassed; ++i) {
    int geom = -1;
    const double distance = mj_ray(m, carrier.observed, from, direction, nullptr, 1,
                                   static_cast<int>(carrier.base), &geom, nullptr);
    if (distance < 0) break;
    gone += distance;
    if (!s.passed[geom]) {
      out[0] = gone;
      break;
    }
    gone += kStep;
    for (int k = 0; k < 3; ++k) from[k] = start[k] + gone * direction[k];
  }
  return true;
}

bool Measure(const Carrier& carrier, const Instrument& s, double* out) {
  switch (s.kind) {
    case kImu:
      return MeasureImu(carrier, s, out);
    case kMagnetometer:
      return MeasureField(carrier, s, out);
    case kBarometer:
      return MeasurePressure(carrier, s, out);
    case kAirspeed:
      return MeasureAirspeed(carrier, s, out);
    default:
      return MeasureRange(carrier, s, out);
  }
}

// Noise, bias, rounding and saturation, as Errors.apply of sensors/noise.py.
void Disturb(Instrument* s, int64_t index, double* numbers) {
  const double* added = s->added + (index % kNoiseBlock) * s->width;
  for (int64_t i = 0; i < s->width; ++i) {
    const Axis& axis = s->axes[i];
    double number = numbers[i] + added[i];
    if (axis.quantum != 0 && std::isfinite(number)) {
      // + 0.0: Python's whole numbers have no negative zero
      number = (std::nearbyint(number / axis.quantum) + 0.0) * axis.quantum;
    }
    if (number < axis.low || number > axis.high) {
      number = number < axis.low ? axis.below : axis.above;
      ++s->beyond;
    }
    numbers[i] = number;
  }
}

}  // namespace

double StandardPressure(double altitude, double tropopause_pressure) {
  const double height = Geopotential(altitude);
  if (height <= kTropopause) {
    return kPressure * std::pow(1.0 + kLapse * height / kTemperature, kExponent);
  }
  const double scale = kGasConstant * kTemperature * kAtTropopause / kGravity;
  return tropopause_pressure * std::exp((kTropopause - height) / scale);
}

double StandardTemperature(double altitude) {
  return kTemperature + kLapse * std::min(Geopotential(altitude), kTropopause);
}

double PressureAltitude(double pressure) {
  const double ratio = std::pow(std::max(pressure, 0.0) / kPressure, 1.0 / kExponent);
  const double height = kTemperature / kLapse * (ratio - 1.0);
  return kEarthRadius * height / (kEarthRadius - height);
}

bool Look(const Carrier& carrier, Instrument* s, int64_t tick) {
  if (tick == s->tick) return true;
  const bool due = tick % s->period == 0;
  const int64_t index = tick / s->period;
  if (due && s->block != index / kNoiseBlock) return false;
  s->tick = tick;
  s->fresh = 0;
  double numbers[kLargestWidth];
  if (due && Measure(carrier, *s, numbers)) {
    Disturb(s, index, numbers);
    std::copy(numbers, numbers + s->width, s->values);
    s->fresh = 1;
  }
  return true;
}

}  // namespace fluid_sim

using namespace fluid_sim;

// Look at one instrument; returns 1 for a new reading, 0 for none, -1 where it first needs the
// noise of its block.
FSR_API int fsr_look(const Carrier* carrier, Instrument* instrument, int64_t tick) {
  return Look(*carrier, instrument, tick) ? static_cast<int>(instrument->fresh) : -1;
}
