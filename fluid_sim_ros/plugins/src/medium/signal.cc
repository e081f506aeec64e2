// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "medium/signal.h"

#include <algorithm>
#include <cmath>

#include "shared/numbers.h"

namespace fluid_sim {
namespace {

constexpr char kSignals[] =
    "groups of ramp AX AY AZ START DURATION | sine AX AY AZ PERIOD PHASE | "
    "gust AX AY AZ START RISE [HOLD] ([m/s], [s], [rad]; DURATION, PERIOD, RISE > 0, HOLD >= 0)";
constexpr char kSeries[] = "two or more rows t x y z, t rising [s], [m/s]";

// One group from words[*next] on; advances *next past it.
bool ReadSignal(const std::vector<std::string>& words, size_t* next, Signal* out) {
  const char* names[] = {"ramp", "sine", "gust"};
  const auto kind = std::find(names, names + 3, words[*next]);
  if (kind == names + 3) return false;
  std::vector<mjtNum> numbers;
  mjtNum number;
  while (++*next < words.size() && ParseNumber(words[*next], &number)) numbers.push_back(number);
  const size_t most = *kind == names[2] ? 6 : 5;
  if (numbers.size() < 5 || numbers.size() > most) return false;
  out->kind = static_cast<Signal::Kind>(kind - names);
  mju_copy3(out->amplitude, numbers.data());
  out->start = numbers[3];
  out->duration = numbers[4];
  if (out->kind == Signal::kSine) {
    out->duration = numbers[3];
    out->phase = numbers[4];
  }
  if (numbers.size() == 6) out->hold = numbers[5];
  return out->duration > 0 && (numbers.size() < 6 || out->hold >= 0);
}

struct Scalar {
  mjtNum value, rate;
};

// (1 - cos(pi s))/2 of s = elapsed/rise between 0 and 1.
Scalar Rise(mjtNum elapsed, mjtNum rise) {
  if (elapsed <= 0) return {0, 0};
  if (elapsed >= rise) return {1, 0};
  const mjtNum angle = kPi * elapsed / rise;
  return {0.5 * (1 - std::cos(angle)), 0.5 * kPi / rise * std::sin(angle)};
}

Scalar Gust(const Signal& s, mjtNum elapsed) {
  const mjtNum falling = elapsed - s.duration - s.hold;
  if (s.hold < 0 || falling <= 0) return Rise(elapsed, s.duration);
  const Scalar fall = Rise(falling, s.duration);
  return {1 - fall.value, -fall.rate};
}

Scalar Factor(const Signal& s, mjtNum time) {
  const mjtNum elapsed = time - s.start;
  switch (s.kind) {
    case Signal::kRamp:
      if (elapsed <= 0) return {0, 0};
      if (elapsed >= s.duration) return {1, 0};
      return {elapsed / s.duration, 1 / s.duration};
    case Signal::kSine: {
      const mjtNum omega = 2 * kPi / s.duration, angle = omega * time + s.phase;
      return {std::sin(angle), omega * std::cos(angle)};
    }
    case Signal::kGust:
      return Gust(s, elapsed);
  }
  return {0, 0};
}

// Slopes of the parabola through each row and its neighbours; 0 at the ends, where the value holds.
void SetSlopes(Series* series) {
  const std::vector<mjtNum>&t = series->times, &v = series->velocities;
  series->slopes.assign(v.size(), 0);
  for (size_t i = 1; i + 1 < t.size(); ++i) {
    const mjtNum before = t[i] - t[i - 1], after = t[i + 1] - t[i];
    for (size_t k = 3 * i; k < 3 * i + 3; ++k) {
      const mjtNum slope_before = (v[k] - v[k - 3]) / before,
                   slope_after = (v[k + 3] - v[k]) / after;
      series->slopes[k] = (after * slope_before + before * slope_after) / (before + after);
    }
  }
}

}  // namespace

bool ReadSignals(const Config& config, const char* key, std::vector<Signal>* signals) {
  const std::vector<std::string> words = Split(config.Text(key));
  for (size_t next = 0; next < words.size();) {
    Signal signal;
    if (!ReadSignal(words, &next, &signal)) return config.Refuse(key, kSignals);
    signals->push_back(signal);
  }
  return true;
}

bool ReadSeries(const Config& config, const char* key, Series* series) {
  const std::vector<std::string> words = Split(config.Text(key));
  if (words.empty()) return true;
  if (words.size() < 8 || words.size() % 4) return config.Refuse(key, kSeries);
  for (size_t i = 0; i < words.size(); ++i) {
    mjtNum number;
    if (!ParseNumber(words[i], &number)) return config.Refuse(key, kSeries);
    if (i % 4) {
      series->velocities.push_back(number);
    } else {
      if (i && number <= series->times.back()) return config.Refuse(key, kSeries);
      series->times.push_back(number);
    }
  }
  SetSlopes(series);
  return true;
}

void AddSignal(const Signal& signal, mjtNum time, mjtNum velocity[3], mjtNum rate[3]) {
  const Scalar factor = Factor(signal, time);
  mju_addToScl3(velocity, signal.amplitude, factor.value);
  mju_addToScl3(rate, signal.amplitude, factor.rate);
}

void AddSeries(const Series& series, mjtNum time, mjtNum velocity[3], mjtNum rate[3]) {
  const std::vector<mjtNum>& times = series.times;
  if (times.empty()) return;
  if (!(time > times.front())) return mju_addTo3(velocity, series.velocities.data());
  if (time >= times.back()) {
    return mju_addTo3(velocity, series.velocities.data() + series.velocities.size() - 3);
  }
  const size_t i = std::upper_bound(times.begin(), times.end(), time) - times.begin() - 1;
  const mjtNum step = times[i + 1] - times[i], s = (time - times[i]) / step;
  for (size_t k = 3 * i; k < 3 * i + 3; ++k) {
    const mjtNum a = series.velocities[k], b = series.velocities[k + 3];
    const mjtNum p = step * series.slopes[k], q = step * series.slopes[k + 3];
    // a + p s + c s^2 + e s^3
    const mjtNum c = 3 * (b - a) - 2 * p - q, e = 2 * (a - b) + p + q;
    velocity[k - 3 * i] += a + s * (p + s * (c + s * e));
    rate[k - 3 * i] += (p + s * (2 * c + 3 * s * e)) / step;
  }
}

}  // namespace fluid_sim
