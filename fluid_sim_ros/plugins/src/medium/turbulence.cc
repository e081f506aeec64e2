// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "medium/turbulence.h"

#include <algorithm>
#include <cmath>

#include "medium/turbulence_tables.h"
#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

constexpr mjtNum kMostTick = 10;  // [s]

// One Dryden process in the sum: share of the variance, and of the length scale.
struct Mode {
  mjtNum variance, length;
};

// (1 + y)^(-5/6) = integral of e^(q/6) / (e^q + 1 + y) dq / 2 pi (a Stieltjes transform), by the
// trapezoidal rule: nodes kFirst + k kStep, all below the first in one at a^2 = 1. With the two
// numbers below the spectra are within 0.1 dB of von Karman's up to 15 corner frequencies, and
// the variance is exact (physics/turbulence.py, test/physics/test_turbulence.py).
constexpr int kNodes = 3, kMostModes = kNodes + 1;
constexpr mjtNum kFirst = 1.3, kStep = 3.8;
constexpr mjtNum kVonKarman = 1.339;  // a in (1 + (a L Omega)^2), MIL-F-8785C

int Modes(Turbulence::Kind kind, Mode modes[kMostModes]) {
  if (kind == Turbulence::kDryden) {
    modes[0] = {1, 1};
    return 1;
  }
  mjtNum total = 0;
  for (int k = 0; k < kMostModes; ++k) {
    const mjtNum q = kFirst + (k - 1) * kStep;
    const mjtNum a = k ? std::sqrt(1 + std::exp(q)) : 1;
    const mjtNum weight = std::exp(q / 6) / (k ? 1 : 1 - std::exp(-kStep / 6));
    modes[k] = {weight / a, kVonKarman / a};
    total += modes[k].variance;
  }
  for (int k = 0; k < kMostModes; ++k) modes[k].variance /= total;
  return kMostModes;
}

// Longitudinal: sigma sqrt(2 tau) / (1 + tau s).
void AddLongitudinal(ColouredNoise* noise, mjtNum tau, mjtNum share) {
  const mjtNum a[1] = {-1 / tau}, b[1] = {std::sqrt(2 / tau)};
  Filter* f = AddFilter(noise, 1, a, b);
  f->output[0] = 0;
  f->weight[0][0] = std::sqrt(share);
}

// Lateral: sigma sqrt(tau) (1 + sqrt(3) tau s) / (1 + tau s)^2 as a cascade of two lags; `rate`
// is the output of the angular rate sign s/V / (1 + lag s) of it, for lag > 0.
void AddLateral(ColouredNoise* noise, int output, mjtNum tau, mjtNum share, mjtNum airspeed,
                mjtNum lag, int rate, mjtNum sign) {
  const mjtNum root = std::sqrt(mjtNum{3}), scale = std::sqrt(share / 2);
  const mjtNum c[2] = {scale * root, scale * (1 - root)};
  const bool rotates = lag > 0;
  const mjtNum r = 1 / tau, l = rotates ? 1 / lag : 0;
  const mjtNum two[4] = {-r, 0, r, -r};
  const mjtNum three[9] = {-r, 0, 0, r, -r, 0, c[0] * l, c[1] * l, -l};
  const mjtNum b[3] = {std::sqrt(2 * r), 0, 0};
  Filter* f = AddFilter(noise, rotates ? 3 : 2, rotates ? three : two, b);
  f->output[0] = output;
  mju_copy(f->weight[0], c, 2);
  f->weight[0][2] = 0;
  if (!rotates) return;
  f->output[1] = rate;
  for (int i = 0; i < 3; ++i) f->weight[1][i] = sign * l / airspeed * (i < 2 ? c[i] : -1);
}

// The six unit processes u, v, w, p, q, r. The pattern passes the vehicle along +x, so that its
// gradients are -1/V of its rates of change, and a rigid rotation has d(u_z)/dx = -Omega_y,
// d(u_y)/dx = Omega_z.
ColouredNoise UnitProcesses(const Turbulence& t, const mjtNum length[3], mjtNum airspeed) {
  ColouredNoise out;
  out.tick = t.noise.tick;
  out.outputs = t.span > 0 ? 6 : 3;
  const mjtNum lag_q = 4 * t.span / (kPi * airspeed), lag_r = 3 * t.span / (kPi * airspeed);
  Mode modes[kMostModes];
  const int count = Modes(t.kind, modes);
  for (int k = 0; k < count; ++k) {
    const mjtNum scale = modes[k].length / airspeed, share = modes[k].variance;
    AddLongitudinal(&out, length[0] * scale, share);
    AddLateral(&out, 1, length[1] * scale, share, airspeed, lag_r, 5, -1);
    AddLateral(&out, 2, length[2] * scale, share, airspeed, lag_q, 4, 1);
  }
  if (t.span > 0) {  // variance: integral of 0.8 (pi L/4b)^(1/3) / (V L) / (1 + (4b w/pi V)^2)
    const mjtNum a[1] = {-1 / lag_q}, b[1] = {std::sqrt(2 / lag_q)};
    Filter* f = AddFilter(&out, 1, a, b);
    f->output[0] = 3;
    f->weight[0][0] = std::sqrt(0.8 * std::cbrt(kPi * length[2] / (4 * t.span)) * kPi * kPi /
                                (8 * t.span * length[2]));
  }
  return out;
}

mjtNum HighLength(const Turbulence& t) {
  return t.kind == Turbulence::kDryden ? kDrydenLength : kVonKarmanLength;
}

constexpr char kPositive3[] = "3 numbers > 0, of u v w [m]";

// sigma, or wind_6m with exceedance.
bool ReadIntensity(const Config& config, Turbulence* t) {
  std::vector<mjtNum> numbers;
  const char* sigma = "turbulence_sigma";
  if (!config.Numbers(sigma, {3}, "3 numbers >= 0, of u v w [m/s]", &numbers)) return false;
  t->by_wind = config.Has("turbulence_wind_6m");
  if (t->by_wind != numbers.empty()) {
    return config.Fail("turbulence needs either turbulence_wind_6m or turbulence_sigma [m/s]");
  }
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < 0) return config.Refuse(sigma, "3 numbers >= 0, of u v w [m/s]");
    t->sigma[i] = numbers[i];
  }
  t->exceedance = 2;
  if (config.Has("turbulence_exceedance")) {
    t->exceedance = config.Word(
        "turbulence_exceedance",
        {kExceedanceWords[0], kExceedanceWords[1], kExceedanceWords[2], kExceedanceWords[3],
         kExceedanceWords[4], kExceedanceWords[5], kExceedanceWords[6]});
  }
  return t->exceedance >= 0 &&
         config.Number("turbulence_wind_6m", 0, kInfinity, "a number >= 0 [m/s]", &t->wind_6m);
}

bool ReadLengths(const Config& config, Turbulence* t) {
  std::vector<mjtNum> numbers;
  const char* length = "turbulence_length";
  if (!config.Numbers(length, {3}, kPositive3, &numbers)) return false;
  if (config.Has("turbulence_height") != numbers.empty()) {
    return config.Fail("turbulence needs either turbulence_height or turbulence_length [m]");
  }
  mjtNum height = 0;
  if (!config.Number("turbulence_height", mjMINVAL, kInfinity, "a number > 0 [m]", &height)) {
    return false;
  }
  if (t->follows && !numbers.empty()) {
    return config.Fail(
        "turbulence_follow takes the lengths from the height; remove turbulence_length");
  }
  LengthsAt(height, HighLength(*t), t->length);
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] <= 0) return config.Refuse(length, kPositive3);
    t->length[i] = numbers[i];
  }
  return true;
}

bool ReadAxis(const Config& config, const mjtNum wind[3], Turbulence* t) {
  std::vector<mjtNum> numbers;
  const char* direction = "turbulence_direction";
  const char* allowed = "3 numbers that are not vertical";
  if (!config.Numbers(direction, {3}, allowed, &numbers)) return false;
  mjtNum along[3] = {wind[0], wind[1], 0};
  if (!numbers.empty()) {
    mju_copy(along, numbers.data(), 2);
    if (mju_norm3(along) < mjMINVAL) return config.Refuse(direction, allowed);
  }
  if (mju_normalize3(along) >= mjMINVAL) mju_copy3(t->axis, along);
  return true;
}

// The time constants that lengths and span make with the airspeed suit the tick.
bool CheckTimes(const Config& config, const Turbulence& t) {
  const char* length = config.Has("turbulence_length") ? "turbulence_length" : "turbulence_height";
  Mode modes[kMostModes];
  const int count = Modes(t.kind, modes);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < count; ++k) {
      if (SuitsTick(t.noise, t.length[i] * modes[k].length / t.airspeed)) continue;
      return config.Refuse(length, std::string("over turbulence_airspeed, ") + kSuitable);
    }
  }
  if (t.span <= 0 || SuitsTick(t.noise, t.span / t.airspeed)) return true;
  return config.Refuse("turbulence_span", std::string("over turbulence_airspeed, ") + kSuitable);
}

}  // namespace

bool ReadTurbulence(const Config& config, mjtNum timestep, const mjtNum wind[3], Turbulence* t) {
  const int kind = config.Word("turbulence", {"none", "dryden", "von_karman"});
  if (kind < 0) return false;
  t->kind = static_cast<Turbulence::Kind>(kind);
  if (kind == Turbulence::kNone) return true;
  const int follows = config.Word("turbulence_follow", {"none", "vehicle"});
  if (follows < 0) return false;
  t->follows = follows == 1;
  t->noise.tick = 0.01;
  if (!config.Has("turbulence_airspeed")) {
    return config.Fail("turbulence needs turbulence_airspeed [m/s]");
  }
  if (!ReadIntensity(config, t) || !ReadLengths(config, t) || !ReadAxis(config, wind, t) ||
      !config.Number("turbulence_airspeed", mjMINVAL, kInfinity, "a number > 0 [m/s]",
                     &t->airspeed) ||
      !config.Number("turbulence_span", mjMINVAL, kInfinity, "a number > 0 [m]", &t->span) ||
      !config.Number("turbulence_ground", -kInfinity, kInfinity, "a height in world z [m]",
                     &t->ground) ||
      !config.Number("turbulence_tick", mjMINVAL, kMostTick, "a number > 0, up to 10 [s]",
                     &t->noise.tick)) {
    return false;
  }
  if (!CheckTick(config, "turbulence_tick", t->noise, timestep) || !CheckTimes(config, *t)) {
    return false;
  }
  t->noise = UnitProcesses(*t, t->length, t->airspeed);
  return true;
}

int TurbulenceStateSize(const Config& config) {
  const std::string kind = config.Text("turbulence");
  if (kind != "dryden" && kind != "von_karman") return 0;
  const bool rotates = config.Has("turbulence_span");
  const int modes = kind == "dryden" ? 1 : kMostModes;
  return NoiseStateSize(modes * (rotates ? 7 : 5) + (rotates ? 1 : 0), rotates ? 6 : 3);
}

std::uint64_t NoiseStream(const char* name, int vehicle) {
  if (!name || !name[0]) return 2 + vehicle;  // 0, 1: current and wind
  std::uint64_t hash = 0xcbf29ce484222325;    // offset and prime of FNV-1a, 64 bits
  for (; *name; ++name) hash = (hash ^ static_cast<unsigned char>(*name)) * 0x100000001b3;
  return hash;
}

void StartTurbulence(const Turbulence& t, std::uint64_t seed, std::uint64_t stream, mjtNum* state) {
  StartNoise(t.noise, seed, stream, state);
}

void AdvanceTurbulence(const Turbulence& t, std::uint64_t seed, std::uint64_t stream, mjtNum time,
                       const Followed& vehicle_at, mjtNum* state) {
  if (!t.follows || !NoiseIsDue(t.noise, time, state)) {
    return AdvanceNoise(t.noise, seed, stream, time, state);
  }
  mjtNum length[3];
  LengthsAt(vehicle_at.height, HighLength(t), length);
  // below a tenth of the stated airspeed the pattern would stand still
  const mjtNum airspeed = std::max(vehicle_at.airspeed, 0.1 * t.airspeed);
  const ColouredNoise now = UnitProcesses(t, length, airspeed);
  AdvanceNoise(now, seed, stream, time, state);
}

void AddTurbulence(const Turbulence& t, std::uint64_t seed, std::uint64_t stream, mjtNum time,
                   mjtNum z, const mjtNum arm_w[3], const mjtNum* state, FlowSample* flow) {
  mjtNum value[kMostOutputs], rate[kMostOutputs];
  SampleNoise(t.noise, seed, stream, time, state, value, rate);
  Intensity at = {{t.sigma[0], t.sigma[1], t.sigma[2]}, {0, 0, 0}};
  if (t.by_wind) at = IntensityAt(z - t.ground, t.wind_6m, t.exceedance);
  // u along the axis, v to its left, w up
  const mjtNum x = t.axis[0], y = t.axis[1];
  const auto add = [x, y](mjtNum out[3], mjtNum u, mjtNum v, mjtNum w) {
    out[0] += x * u - y * v;
    out[1] += y * u + x * v;
    out[2] += w;
  };
  const mjtNum *s = at.sigma, *slope = at.slope;
  add(flow->velocity, s[0] * value[0], s[1] * value[1], s[2] * value[2]);
  add(flow->rate, s[0] * rate[0], s[1] * rate[1], s[2] * rate[2]);
  if (t.by_wind) {
    mjtNum shear[3] = {0, 0, 0};  // du/dz
    add(shear, slope[0] * value[0], slope[1] * value[1], slope[2] * value[2]);
    for (int i = 0; i < 3; ++i) flow->gradient[3 * i + 2] += shear[i];
  }
  if (t.span <= 0) return;
  mjtNum spin[3] = {0, 0, 0}, spin_rate[3] = {0, 0, 0};  // p and q go with w, r with v
  add(spin, s[2] * value[3], s[2] * value[4], s[1] * value[5]);
  add(spin_rate, s[2] * rate[3], s[2] * rate[4], s[1] * rate[5]);
  // a rigid rotation about the vehicle's origin; its gradient is in the rates of change already
  AddCross(flow->velocity, spin, arm_w);
  AddCross(flow->rate, spin_rate, arm_w);
  for (int i = 0; i < 3; ++i) flow->spin[i] += spin[i];
}

}  // namespace fluid_sim
