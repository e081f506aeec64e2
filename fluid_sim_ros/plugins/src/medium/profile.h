// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Vertical profile of a wind or a current: a factor on the run-time velocity.

#ifndef FLUID_SIM_MEDIUM_PROFILE_H_
#define FLUID_SIM_MEDIUM_PROFILE_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "shared/config.h"

namespace fluid_sim {

struct ProfileValue {
  mjtNum factor;  // [-]
  mjtNum slope;   // d(factor)/d(height) [1/m]
};

// "uniform" | "power EXPONENT REFERENCE" | "log ROUGHNESS REFERENCE" | "table h0 s0 h1 s1 ...".
// Heights are above a datum: the ground or the surface for wind, the bed (or, with negative
// heights, the surface) for a current [m].
class Profile {
 public:
  bool Parse(const Config& config, const char* key);
  ProfileValue At(mjtNum height) const;
  bool uniform() const { return kind_ == kUniform; }
  bool from_ground() const { return kind_ == kPower || kind_ == kLog; }

 private:
  enum Kind { kUniform, kPower, kLog, kTable } kind_ = kUniform;
  mjtNum first_ = 0, reference_ = 1;
  std::vector<mjtNum> heights_, factors_;
};

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_PROFILE_H_
