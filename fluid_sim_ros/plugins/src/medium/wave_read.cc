// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Components of the waves (see waves.h), made once when the model is loaded.
// numpy twins: physics/waves.py, physics/wave_spectrum.py.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "medium/waves.h"
#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

constexpr mjtNum kDeep = 20;       // k depth beyond which the bed is not felt (e^-40)
constexpr mjtNum kLowest = 0.5;    // lowest frequency of a sea over the peak's
constexpr int kBinPoints = 64;     // midpoint rule per bin of the spectrum
constexpr int kTurnPoints = 4096;  // and over the spreading function
constexpr char kAllowed[] =
    "none | regular HEIGHT PERIOD | jonswap HEIGHT PERIOD [GAMMA] (HEIGHT >= 0 [m], PERIOD > 0 "
    "[s], GAMMA 1 to 10)";

// What the keys say.
struct Choice {
  mjtNum height = 0, period = 0;  // [m], [s]; of a sea: significant height and peak period
  mjtNum gamma = 3.3;
  mjtNum along[2] = {1, 0};  // unit
  mjtNum spreading = 0, components = 64, repeat = 0, cutoff = 4, seed = 0;
};

// k of omega^2 = g k tanh(k h): Newton's method from Guo (2002), Coastal Engineering 45:71.
mjtNum Wavenumber(mjtNum omega, mjtNum depth, mjtNum gravity) {
  const mjtNum deep = omega * omega / gravity, target = deep * depth;
  if (!std::isfinite(depth)) return deep;
  mjtNum x = target * std::pow(1 - std::exp(-std::pow(target, 1.25)), -0.4);
  for (int i = 0; i < 4; ++i) {
    const mjtNum t = std::tanh(x);
    x -= (x * t - target) / (t + x * (1 - t * t));
  }
  return x / depth;
}

// Height at which waves of a period break: Miche (1944), .142 L tanh(k h).
mjtNum BreakingHeight(mjtNum period, mjtNum depth, mjtNum gravity) {
  const mjtNum k = Wavenumber(2 * kPi / period, depth, gravity);
  return 0.142 * 2 * kPi / k * std::tanh(k * depth);
}

WaveComponent Component(mjtNum amplitude, mjtNum omega, mjtNum phase, mjtNum depth,
                        mjtNum gravity) {
  const mjtNum k = Wavenumber(omega, depth, gravity), floor = std::exp(-2 * k * depth);
  return {amplitude, omega, k, {1, 0}, phase, k * depth < kDeep ? floor : 0};
}

std::uint64_t Mix(std::uint64_t state) {
  state = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9u;
  state = (state ^ (state >> 27)) * 0x94D049BB133111EBu;
  return state ^ (state >> 31);
}

// Number `index` in [0, 1) of a seed: SplitMix64 (Steele, Lea and Flood 2014).
mjtNum Uniform(std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t mixed = Mix(Mix(seed) + (index + 1) * 0x9E3779B97F4A7C15u);
  return static_cast<mjtNum>(mixed >> 11) * 0x1p-53;
}

// r^-5 exp(-5/4 r^-4) gamma^exp(-(r - 1)^2/(2 sigma^2)): Hasselmann et al. (1973).
mjtNum JonswapShape(mjtNum ratio, mjtNum gamma) {
  const mjtNum off = (ratio - 1) / (ratio <= 1 ? 0.07 : 0.09);
  return std::pow(ratio, -5.0) * std::exp(-1.25 * std::pow(ratio, -4.0)) *
         std::pow(gamma, std::exp(-0.5 * off * off));
}

// Distribution of cos^2s(chi/2) on (-pi, pi), inverted by linear interpolation.
class Spreading {
 public:
  explicit Spreading(mjtNum s) {
    if (s == 0) return;
    below_.push_back(0);
    for (int i = 0; i < kTurnPoints; ++i) {
      const mjtNum chi = -kPi + (i + 0.5) * kStep;
      below_.push_back(below_.back() + std::pow(std::cos(0.5 * chi), 2 * s));
    }
  }

  mjtNum Angle(mjtNum share) const {
    if (below_.empty()) return 0;
    const mjtNum target = share * below_.back();
    const auto above = std::upper_bound(below_.begin() + 1, below_.end() - 1, target);
    const auto knot = above - 1;
    const mjtNum part = (target - *knot) / (*above - *knot);
    return -kPi + (static_cast<mjtNum>(knot - below_.begin()) + part) * kStep;
  }

 private:
  static constexpr mjtNum kStep = 2 * kPi / kTurnPoints;
  std::vector<mjtNum> below_;
};

// One component per bin of frequencies that grow by a constant factor: all of the bin's energy at
// a multiple of 2 pi/repeat drawn from within it. Scaled to sum a^2/2 = H_s^2/16.
void MakeSea(const Choice& choice, mjtNum depth, mjtNum gravity,
             std::vector<WaveComponent>* components) {
  const int count = static_cast<int>(choice.components);
  const mjtNum step = 2 * kPi / choice.repeat, omega_p = 2 * kPi / choice.period;
  const std::uint64_t seed = static_cast<std::uint64_t>(choice.seed);
  const Spreading spreading(choice.spreading);
  const auto edge = [&](int bin) {
    const mjtNum growth =
        std::pow(choice.cutoff / kLowest, static_cast<mjtNum>(bin) / choice.components);
    return std::floor(kLowest * (omega_p / step) * growth + 0.5);
  };
  mjtNum whole = 0;
  for (int i = 0; i < count; ++i) {
    const mjtNum first = edge(i), width = edge(i + 1) - first;
    mjtNum energy = 0;
    for (int j = 0; j < kBinPoints; ++j) {
      const mjtNum multiple = first - 0.5 + (j + 0.5) / kBinPoints * width;
      energy += JonswapShape(multiple * step / omega_p, choice.gamma) * width;
    }
    whole += energy;
    const mjtNum multiple = first + std::floor(Uniform(seed, 3 * i) * width);
    WaveComponent wave =
        Component(energy, step * multiple, 2 * kPi * Uniform(seed, 3 * i + 1), depth, gravity);
    const mjtNum angle = spreading.Angle(Uniform(seed, 3 * i + 2));
    const mjtNum cosine = std::cos(angle), sine = std::sin(angle);
    wave.direction[0] = cosine * choice.along[0] - sine * choice.along[1];
    wave.direction[1] = sine * choice.along[0] + cosine * choice.along[1];
    components->push_back(wave);
  }
  const mjtNum scale = choice.height * choice.height / 8 / whole;
  for (WaveComponent& wave : *components) wave.amplitude = std::sqrt(scale * wave.amplitude);
}

void MakeRegular(const Choice& choice, mjtNum depth, mjtNum gravity,
                 std::vector<WaveComponent>* components) {
  WaveComponent wave = Component(0.5 * choice.height, 2 * kPi / choice.period, 0, depth, gravity);
  wave.direction[0] = choice.along[0];
  wave.direction[1] = choice.along[1];
  components->push_back(wave);
}

bool ReadDirection(const Config& config, mjtNum along[2]) {
  const char* allowed = "x and y of the direction of travel, not both 0";
  std::vector<mjtNum> numbers;
  if (!config.Numbers("wave_direction", {2}, allowed, &numbers)) return false;
  if (numbers.empty()) return true;
  const mjtNum length = std::hypot(numbers[0], numbers[1]);
  if (length <= 0) return config.Refuse("wave_direction", allowed);
  along[0] = numbers[0] / length;
  along[1] = numbers[1] / length;
  return true;
}

bool ReadSea(const Config& config, Choice* choice) {
  const mjtNum most_seed = 0x1p53;
  choice->repeat = 200 * choice->period;
  if (!config.Number("wave_spreading", 0, 1000, "s of cos^2s, 0 (long-crested) to 1000",
                     &choice->spreading) ||
      !config.Number("wave_components", 1, 10000, "a whole number from 1 to 10000",
                     &choice->components) ||
      !config.Number("wave_repeat", 0, kInfinity, "a number > 0 [s]", &choice->repeat) ||
      !config.Number("wave_cutoff", 1, 100, "a number > 1, at most 100", &choice->cutoff) ||
      !config.Number("wave_seed", 0, most_seed, "a whole number from 0 to 2^53", &choice->seed)) {
    return false;
  }
  if (choice->components != std::floor(choice->components)) {
    return config.Refuse("wave_components", "a whole number from 1 to 10000");
  }
  if (choice->seed != std::floor(choice->seed)) {
    return config.Refuse("wave_seed", "a whole number from 0 to 2^53");
  }
  if (choice->cutoff <= 1) return config.Refuse("wave_cutoff", "a number > 1, at most 100");
  const mjtNum growth = std::pow(choice->cutoff / kLowest, 1 / choice->components);
  const mjtNum shortest = choice->period / (kLowest * (growth - 1));
  if (choice->repeat < shortest) {  // the first bin, the narrowest, holds no multiple
    const std::string needed = "wave_repeat >= " + std::to_string(shortest) + " [s]";
    if (!config.Has("wave_repeat")) {
      return config.Refuse("wave_components", "fewer, or " + needed + " for so many");
    }
    return config.Refuse("wave_repeat", needed + " for so many components, or fewer of them");
  }
  return true;
}

}  // namespace

bool ReadWaves(const Config& config, const mjModel* m, bool has_surface, mjtNum level,
               Waves* waves) {
  const std::vector<std::string> words = Split(config.Text("waves"));
  const bool none = words.empty() || (words[0] == "none" && words.size() == 1);
  for (const char* key : {"wave_direction", "wave_spreading", "wave_components", "wave_repeat",
                          "wave_cutoff", "wave_seed", "water_depth"}) {
    if (none && config.Has(key)) return config.Fail(std::string(key) + " without waves");
  }
  if (none) return true;
  Choice choice;
  const bool sea = words[0] == "jonswap";
  mjtNum* const numbers[] = {&choice.height, &choice.period, &choice.gamma};
  bool good = (sea || words[0] == "regular") && (words.size() == 3 || (sea && words.size() == 4));
  for (size_t i = 1; good && i < words.size(); ++i) good = ParseNumber(words[i], numbers[i - 1]);
  if (!good || choice.height < 0 || choice.period <= 0 || choice.gamma < 1 || choice.gamma > 10) {
    return config.Refuse("waves", kAllowed);
  }
  if (!has_surface) return config.Fail("waves without surface; give surface [m]");
  const mjtNum* gravity = m->opt.gravity;
  if (gravity[0] != 0 || gravity[1] != 0 || gravity[2] >= 0) {
    return config.Fail("waves need gravity straight down; set opt gravity to 0 0 -g");
  }
  waves->level = level;
  waves->depth = kInfinity;
  if (!config.Number("water_depth", mjMINVAL, kInfinity, "a number > 0 [m]", &waves->depth) ||
      !ReadDirection(config, choice.along)) {
    return false;
  }
  const mjtNum highest = BreakingHeight(choice.period, waves->depth, -gravity[2]);
  if (!(choice.height <= highest)) {
    return config.Refuse("waves", "HEIGHT up to " + std::to_string(highest) +
                                      " [m]: waves of this period break there");
  }
  if (sea) {
    if (!ReadSea(config, &choice)) return false;
    MakeSea(choice, waves->depth, -gravity[2], &waves->components);
    waves->repeat = choice.repeat;
  } else {
    for (const char* key :
         {"wave_spreading", "wave_components", "wave_repeat", "wave_cutoff", "wave_seed"}) {
      if (config.Has(key)) return config.Fail(std::string(key) + " with regular waves");
    }
    MakeRegular(choice, waves->depth, -gravity[2], &waves->components);
    waves->repeat = choice.period;
  }
  mjtNum steepness = 0;
  for (const WaveComponent& wave : waves->components) {
    waves->reach += wave.amplitude;
    steepness += wave.amplitude * wave.wavenumber;
  }
  waves->tilt = std::sqrt(1 + steepness * steepness);
  return true;
}

}  // namespace fluid_sim
