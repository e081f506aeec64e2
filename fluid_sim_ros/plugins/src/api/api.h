// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The C functions of the library that Python calls (bound in plugins/native.py).
//
// What each does stands at its definition; here is only what several of these files need.

#ifndef FLUID_SIM_API_API_H_
#define FLUID_SIM_API_API_H_

#include <mujoco/mujoco.h>

#include <cstdint>

#include "lean/lean.h"
#include "lean/step_commands.h"
#include "shared/terms.h"

#define FSR_API extern "C" __attribute__((visibility("default")))

namespace fluid_sim {

// Columns of the row that fsr_observe writes per vehicle. Python reads kColumns from the library.
enum Column {
  kPosition = 0,              // base_link origin, world [m]
  kQuaternion = 3,            // base_link to world, wxyz
  kLinearVelocity = 7,        // of the origin, base_link axes [m/s]
  kAngularVelocity = 10,      // base_link axes [rad/s]
  kSpecificForce = 13,        // acceleration minus gravity at the origin, base_link axes [m/s^2]
  kAngularAcceleration = 16,  // base_link axes [rad/s^2]
  kMediumVelocity = 19,       // undisturbed medium at the origin, world [m/s]
  kTotal = 22,                // fluid wrench, force then torque, base_link axes, about the origin
  kThrust = 28,               // wrench of the actuators on the base
  kFirstTerm = 34,            // kTermCount wrenches
  kRowWidth = kFirstTerm + 6 * kTermCount
};

struct ColumnInfo {
  const char* name;
  int first, end;
};

constexpr ColumnInfo kColumns[] = {
    {"position", kPosition, kQuaternion},
    {"quaternion", kQuaternion, kLinearVelocity},
    {"linear_velocity", kLinearVelocity, kAngularVelocity},
    {"angular_velocity", kAngularVelocity, kSpecificForce},
    {"specific_force", kSpecificForce, kAngularAcceleration},
    {"angular_acceleration", kAngularAcceleration, kMediumVelocity},
    {"medium_velocity", kMediumVelocity, kTotal},
    {"total", kTotal, kThrust},
    {"thrust", kThrust, kFirstTerm},
    {"terms", kFirstTerm, kRowWidth},
};

// As fsr_step; `lean` leaves out what cannot change the state, null: nothing. `commands` are
// written before each step, the first of which is at `tick`; null: none.
int TakeSteps(const mjModel* m, mjData* d, int n, double* report, Lean* lean,
              StepCommands* commands, std::int64_t tick);

}  // namespace fluid_sim

FSR_API int fsr_step(const mjModel* m, mjData* d, int n, double* report);
FSR_API void fsr_observe(const mjModel* m, const mjData* d, mjData* scratch, const int* bases,
                         int count, int forces, double* rows);
FSR_API int fsr_limits(const mjModel* m, const mjData* d, int i, double* out);
FSR_API void fsr_forget_limits(const mjModel* m, const mjData* d);
FSR_API void fsr_energy_feed(const mjModel* m, const mjData* d, mjData* scratch, double* out);
FSR_API void fsr_energy_take(mjModel* m, const mjData* d, mjData* scratch, double seconds,
                             double* sums);
FSR_API void fsr_raise_largest(const mjModel* m, const mjData* d, mjData* scratch, const int* bases,
                               int count, const double* start, double* largest, double* rows);

#endif  // FLUID_SIM_API_API_H_
