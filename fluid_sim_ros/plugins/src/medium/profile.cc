// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "medium/profile.h"

#include <algorithm>
#include <cmath>

namespace fluid_sim {
namespace {

constexpr char kAllowed[] =
    "uniform | power EXPONENT HEIGHT | log ROUGHNESS HEIGHT (all > 0, ROUGHNESS < HEIGHT) | "
    "table h0 s0 h1 s1 ... (h rising) [m]";

// The power law's slope is unbounded at the ground: below this share of the reference height the
// factor goes to zero linearly.
constexpr mjtNum kLinearShare = 1e-3;

}  // namespace

bool Profile::Parse(const Config& config, const char* key) {
  const std::vector<std::string> words = Split(config.Text(key));
  if (words.empty() || (words[0] == "uniform" && words.size() == 1)) return true;
  std::vector<mjtNum> numbers(words.size() - 1);
  for (size_t i = 1; i < words.size(); ++i) {
    if (!ParseNumber(words[i], &numbers[i - 1])) return config.Refuse(key, kAllowed);
  }
  if (words[0] == "power" || words[0] == "log") {
    kind_ = words[0] == "power" ? kPower : kLog;
    if (numbers.size() != 2 || numbers[0] <= 0 || numbers[1] <= 0 ||
        (kind_ == kLog && numbers[0] >= numbers[1])) {
      return config.Refuse(key, kAllowed);
    }
    first_ = numbers[0];
    reference_ = numbers[1];
    return true;
  }
  if (words[0] != "table" || numbers.size() < 4 || numbers.size() % 2) {
    return config.Refuse(key, kAllowed);
  }
  kind_ = kTable;
  for (size_t i = 0; i < numbers.size(); i += 2) {
    if (!heights_.empty() && numbers[i] <= heights_.back()) return config.Refuse(key, kAllowed);
    heights_.push_back(numbers[i]);
    factors_.push_back(numbers[i + 1]);
  }
  return true;
}

ProfileValue Profile::At(mjtNum height) const {
  switch (kind_) {
    case kUniform:
      return {1, 0};
    case kPower: {
      if (height <= 0) return {0, 0};
      const mjtNum low = kLinearShare * reference_;
      if (height < low) {
        const mjtNum slope = std::pow(kLinearShare, first_) / low;
        return {slope * height, slope};
      }
      const mjtNum factor = std::pow(height / reference_, first_);
      return {factor, first_ * factor / height};
    }
    case kLog: {
      if (height <= first_) return {0, 0};
      const mjtNum scale = 1 / std::log(reference_ / first_);
      return {scale * std::log(height / first_), scale / height};
    }
    case kTable: {
      if (!(height > heights_.front())) return {factors_.front(), 0};  // NaN too
      if (height >= heights_.back()) return {factors_.back(), 0};
      const size_t i =
          std::upper_bound(heights_.begin(), heights_.end(), height) - heights_.begin();
      const mjtNum slope = (factors_[i] - factors_[i - 1]) / (heights_[i] - heights_[i - 1]);
      return {factors_[i - 1] + slope * (height - heights_[i - 1]), slope};
    }
  }
  return {1, 0};
}

}  // namespace fluid_sim
