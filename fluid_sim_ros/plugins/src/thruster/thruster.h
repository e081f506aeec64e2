// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// fluid_sim.thruster: a rotor on a site, from the command to thrust, reaction torque and drag.
//
// One plugin instance serves up to two actuators on one site: the force along the thrust axis and
// the torque about it. With a lag the first has actdim="2": act[0] is the speed at the start of
// the step (act_dot 0), act[1] a clock (act_dot 1). The speed is their closed-form function, so
// that it is exact at every stage of every integrator; the end of a step folds it into act[0].

#ifndef FLUID_SIM_THRUSTER_THRUSTER_H_
#define FLUID_SIM_THRUSTER_THRUSTER_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "medium/medium.h"
#include "shared/terms.h"
#include "thruster/inflow.h"
#include "thruster/thruster_curve.h"

namespace fluid_sim {

enum class Command { kNewton, kNormalized, kRadPerS, kPwm };
enum class Works { kConstant, kLocal, kWater, kAir };

// What command and lag alone make of a rotor.
struct RotorState {
  mjtNum target = 0, omega = 0;  // [rad/s]
  mjtNum rate = 0;               // domega/dt [rad/s^2]
  mjtNum thrust = 0;             // at rest [N]
  mjtNum torque = 0;             // at rest, of the sign of omega [N m]
  bool saturated = false;        // the command was beyond what the thruster can do
};

// The last one and what it was asked for: actuators, passive forces and the stages of an integrator
// ask for the same.
struct KeptState {
  mjtNum asked[3];  // command, speed at the start of the step, time since
  bool any = false;
  RotorState state;
};

struct Thruster {
  int thrust = -1, torque = -1;  // actuators; -1: none
  int site = -1, body = -1;
  bool lagged = false;
  mjtNum axis[3] = {0, 0, 0};  // thrust axis, site axes

  Command command = Command::kNewton;
  RotorCurve curve;
  InflowLoss loss;                     // off unless the model asks for it
  std::vector<Knot> table;             // thrust by pulse width
  mjtNum limit[2] = {0, 0};            // largest speed forward and in reverse [rad/s]
  mjtNum pwm[3] = {1100, 1500, 1900};  // full reverse, neutral, full forward [us]
  mjtNum dead[2] = {1500, 1500};       // edges of the dead zone [us]
  Lag lag;
  mjtNum spin = 1;  // +1: a positive speed turns about the thrust axis (ccw)

  mjtNum inertia = 0;        // of the rotor about its axis [kg m^2]
  mjtNum drag[2] = {0, 0};   // across and along the axis [N/((rad/s)(m/s))]
  mjtNum rolling = 0;        // [N m/((rad/s)(m/s))]
  mjtNum ground_effect = 0;  // strength; < 0: Cheeseman and Bennett
  mjtNum ground = 0;         // height of the ground, world z [m]

  Works works = Works::kConstant;
  Medium medium;  // constants only; its state is in mjData
  mutable KeptState kept;

  bool passive() const { return inertia > 0 || drag[0] > 0 || drag[1] > 0 || rolling > 0; }
  bool has_drag() const { return drag[0] > 0 || drag[1] > 0 || rolling > 0; }
  bool thrust_needs_flow() const {
    return curve.kind == Curve::kCoefficients || works != Works::kConstant ||
           loss.law != InflowLaw::kNone;
  }
};

// What a thruster does now.
struct RotorLoad {
  mjtNum omega = 0;   // [rad/s]
  mjtNum target = 0;  // that the command asks for [rad/s]
  mjtNum rate = 0;    // domega/dt [rad/s^2]
  mjtNum thrust = 0;  // [N]
  mjtNum torque = 0;  // that the fluid resists with, of the sign of omega at rest [N m]
  mjtNum inflow = 0;  // along the axis [m/s]
  bool saturated = false;
  mjtNum drag_w[3] = {0, 0, 0};    // [N], at the site
  mjtNum moment_w[3] = {0, 0, 0};  // rolling moment [N m]
  mjtNum gyro_w[3] = {0, 0, 0};    // [N m]
};

extern const char* const kThrusterAttributes[];
extern const int kThrusterAttributeCount;

// Read and check one instance; false after one line of explanation.
bool ReadThruster(const mjModel* m, int instance, Thruster* out);

// Speed that a command asks for [rad/s]; tells whether it was beyond what the thruster can do.
mjtNum CommandedSpeed(const Thruster& thruster, mjtNum command, bool* saturated);

// What a command and the lag make of the rotor now; kept in the thruster.
const RotorState& PresentState(const mjModel* m, const mjData* d, const Thruster& thruster,
                               mjtNum command);

// What a load is asked for.
enum class Loads {
  kActuators,  // thrust and torque along the axis
  kPassive,    // drag, rolling moment and gyroscopic torque
  kAll
};

// From the command, activation, positions and velocities in d; the rest of the load stays zero.
RotorLoad EvaluateThruster(const mjModel* m, const mjData* d, const Thruster& thruster,
                           Loads loads = Loads::kAll);

// The thruster that an actuator belongs to, or null.
const Thruster* FindThruster(const mjModel* m, const mjData* d, int actuator);

// A rotor on `body` is dragged by the flow across and along it.
bool HasRotorDrag(const mjModel* m, const mjData* d, int body);

// Add the drag of the rotors on `body` in world axes about `point_w`.
void AddRotorTerms(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                   Wrench terms[kTermCount]);

void RegisterThruster();

}  // namespace fluid_sim

#endif  // FLUID_SIM_THRUSTER_THRUSTER_H_
