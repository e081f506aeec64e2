// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// From an autopilot's outputs to commands, and on to mjData.ctrl.

#ifndef FLUID_SIM_EXCHANGE_OUTPUTS_H_
#define FLUID_SIM_EXCHANGE_OUTPUTS_H_

#include <cstdint>

namespace fluid_sim {

constexpr int kMostOutputs = 32;

enum CurveKind : int64_t { kShare, kRotorSpeed, kT200 };

struct OutputCurve {
  int64_t place;                   // of the output, from 0
  int64_t kind;                    // CurveKind
  int64_t reversed, silent;        // acts backwards; an output of 0 is off
  double rest, ahead, back;        // value at rest, shares of full command per value
  double low, high;                // limits of the command
  const double *pulses, *thrusts;  // table of a T200: [us], [N]
  int64_t points;                  // of the table
};

// Where the commands of some actuators go: Controls of simulation/actuation.py.
struct Controls {
  int64_t count;
  const double *limits, *scale;  // count low, then count high; command at a control of 1, or null
  const int64_t* ids;
  double* control;  // mjData.ctrl
};

// What an autopilot drives.
struct Driven {
  const OutputCurve* curves;  // of the thrusters, then of the joints
  Controls thrusters, joints;
  double* commands;              // the last ones, in the order of the curves
  int64_t known;                 // outputs that were there the last time
  double outputs[kMostOutputs];  // the last ones
  int64_t beyond;                // of the last commands, how many were saturated
};

// Command what the outputs drive. Returns false where a command is not finite; then nothing was
// commanded.
bool Drive(Driven* d);

}  // namespace fluid_sim

#endif  // FLUID_SIM_EXCHANGE_OUTPUTS_H_
