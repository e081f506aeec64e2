// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// C function for Python (bound in plugins/native.py): many runs of one model in a single call.

#include <mujoco/mujoco.h>

#include <algorithm>
#include <vector>

#include "api/api.h"

using namespace fluid_sim;

// Fly `runs` runs of `steps` steps, each as fsr_lean_step and fsr_raise_largest do it: from its
// state (of mjSTATE_INTEGRATION) in `states`, in its wind of `winds` (opt.wind, which the last one
// leaves in the model), with a look at the `count` bases every `period` steps and at the end. A run
// ends at its first bad step. Per run: done[1] good steps, reports[2] of the bad one, rows[count *
// width] at the end, largest[3 * count]; and what watchdogs see: sums[3] of fsr_energy_take every
// `watch` steps and at the end, warned[mjNWARNING] the counts of MuJoCo's warnings, limits[4 *
// limited] of fsr_limits. The caller has set largest and sums to zero.
FSR_API void fsr_runs(mjModel* m, mjData* d, mjData* scratch, const int* bases, int count, int runs,
                      int steps, int period, const double* states, const double* winds, int* done,
                      double* reports, double* rows, double* largest, int watch, double* sums,
                      int* warned, int limited, double* limits) {
  const int size = mj_stateSize(m, mjSTATE_INTEGRATION);
  const int width = kRowWidth;
  std::vector<double> start(3 * count);
  Lean lean(m);
  for (int run = 0; run < runs; ++run) {
    mj_resetData(m, d);
    mj_setState(m, d, states + run * size, mjSTATE_INTEGRATION);
    mju_copy3(m->opt.wind, winds + 3 * run);
    double* run_rows = rows + run * count * width;
    fsr_observe(m, d, scratch, bases, count, 0, run_rows);
    for (int i = 0; i < count; ++i) mju_copy3(start.data() + 3 * i, run_rows + width * i);
    fsr_forget_limits(m, d);
    int at = 0, watched = 0;
    while (at < steps) {
      const int next = std::min({steps, (at / period + 1) * period, watched + watch});
      const int good = TakeSteps(m, d, next - at, reports + 2 * run, &lean, nullptr, 0);
      at += good;
      if (at < next) break;
      if (at % period == 0 || at == steps) {
        fsr_raise_largest(m, d, scratch, bases, count, start.data(), largest + 3 * count * run,
                          run_rows);
      }
      if (at == watched + watch || at == steps) {
        fsr_energy_take(m, d, scratch, (at - watched) * m->opt.timestep, sums + 3 * run);
        watched = at;
      }
    }
    done[run] = at;
    for (int i = 0; i < mjNWARNING; ++i) warned[run * mjNWARNING + i] = d->warning[i].number;
    for (int i = 0; i < limited; ++i) fsr_limits(m, d, i, limits + 4 * (limited * run + i));
    fsr_observe(m, d, scratch, bases, count, 0, run_rows);
  }
}
