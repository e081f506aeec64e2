// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The terms that a fluid wrench is made of, and what a wrench is.

#ifndef FLUID_SIM_SHARED_TERMS_H_
#define FLUID_SIM_SHARED_TERMS_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// Index of each term in an array of wrenches, Wrench terms[kTermCount].
enum Term {
  kDrag = 0,
  kViscous,
  kAddedMass,
  kMagnus,
  kKutta,
  kBuoyancy,
  kDamping,
  kFoil,
  kTermCount
};

// What the rest of the package needs to know of a term. Python reads this table from the library.
struct TermInfo {
  const char* name;  // of the topic, of the column in logs and tables
  bool dissipates;   // takes energy out of the motion of body and fluid (for the energy watchdog)
};

// In the order of Term.
constexpr TermInfo kTerms[] = {
    {"drag", true},   {"viscous", true},   {"added_mass", false}, {"magnus", false},
    {"kutta", false}, {"buoyancy", false}, {"damping", true},     {"foil", false},
};
static_assert(sizeof(kTerms) / sizeof(kTerms[0]) == kTermCount, "kTerms has a row for each Term");

struct Wrench {
  mjtNum force[3] = {0, 0, 0};   // [N]
  mjtNum torque[3] = {0, 0, 0};  // [N m]
};

struct FluidConstants {
  mjtNum density;    // [kg/m^3]
  mjtNum viscosity;  // dynamic [Pa s]
};

}  // namespace fluid_sim

#endif  // FLUID_SIM_SHARED_TERMS_H_
