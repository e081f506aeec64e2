// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Watched stepping.

#include <mujoco/mujoco.h>

#include <cmath>
#include <utility>
#include <vector>

#include "api/api.h"
#include "api/quiet.h"
#include "api/untimed.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

bool AllFinite(const mjtNum* x, int n) {
  // a sum of zeros times x is zero exactly when every x is finite
  mjtNum probe = 0;
  for (int i = 0; i < n; ++i) probe += 0 * x[i];
  return probe == 0;
}

int FatalWarnings(const mjData* d) {
  return d->warning[mjWARN_BADQPOS].number + d->warning[mjWARN_BADQVEL].number +
         d->warning[mjWARN_BADQACC].number;
}

// Index of the first dof that is not finite, or what MuJoCo's last warning named, or -1.
int BadDof(const mjModel* m, const mjData* d) {
  for (int i = 0; i < m->nv; ++i) {
    if (!std::isfinite(d->qvel[i])) return i;
  }
  for (int joint = 0; joint < m->njnt; ++joint) {
    const int end = joint + 1 < m->njnt ? m->jnt_qposadr[joint + 1] : m->nq;
    for (int i = m->jnt_qposadr[joint]; i < end; ++i) {
      if (!std::isfinite(d->qpos[i])) return m->jnt_dofadr[joint];
    }
  }
  if (d->warning[mjWARN_BADQACC].number) return d->warning[mjWARN_BADQACC].lastinfo;
  if (d->warning[mjWARN_BADQVEL].number) return d->warning[mjWARN_BADQVEL].lastinfo;
  return -1;
}

}  // namespace

int TakeSteps(const mjModel* m, mjData* d, int n, double* report, Lean* lean,
              StepCommands* commands, std::int64_t tick) {
  const QuietWarnings quiet;  // a bad step is in the report, MuJoCo need not print it too
  const Untimed untimed;
  if (lean) lean->Begin(m);
  if (commands) commands->Begin(tick);
  const int before = FatalWarnings(d);
  for (int i = 0; i < n; ++i) {
    const mjtNum time = d->time;
    if (commands) commands->Write(tick + i, d);
    if (lean) {
      lean->Step(m, d, i + 1 == n);
    } else {
      mj_step(m, d);
    }
    if (FatalWarnings(d) != before || !AllFinite(d->qpos, m->nq) || !AllFinite(d->qvel, m->nv)) {
      report[0] = time;
      report[1] = BadDof(m, d);
      return i;
    }
  }
  return n;
}

}  // namespace fluid_sim

using namespace fluid_sim;

namespace {

// What Python steps, so that a call hands over one address.
struct Stepped {
  const mjModel* m;
  mjData* d;
  double* report;
  Lean lean;
  StepCommands commands;
};

}  // namespace

// Take up to n steps and stop at the first bad one (NaN, or a MuJoCo warning that resets the state
// silently). Returns the number of good steps; report[0] = time at the start of the bad step,
// report[1] = its dof or -1. Every step is MuJoCo's, whole.
FSR_API int fsr_step(const mjModel* m, mjData* d, int n, double* report) {
  return TakeSteps(m, d, n, report, nullptr, nullptr, 0);
}

// What fsr_lean_step steps; to be freed with fsr_lean_free, before m, d and report.
FSR_API void* fsr_lean(const mjModel* m, mjData* d, double* report) {
  return new Stepped{m, d, report, Lean(m), {}};
}

FSR_API void fsr_lean_free(void* stepped) { delete static_cast<Stepped*>(stepped); }

// As fsr_step, to the bit, without the work that cannot change the state (lean/lean.h), and with
// the commands that are written before each step; `tick` is the present one (StepClock).
FSR_API int fsr_lean_step(void* stepped, int n, long long tick) {
  Stepped* s = static_cast<Stepped*>(stepped);
  return TakeSteps(s->m, s->d, n, s->report, &s->lean, &s->commands, tick);
}

// Forget all gaits.
FSR_API void fsr_lean_forget_gaits(void* stepped) {
  static_cast<Stepped*>(stepped)->commands.gaits.clear();
}

// Add a gait (class Gait): beat[2] numerator and denominator, wave[3] period, frequency and ramp,
// for each of `count` joints its address in ctrl, and amplitude, phase and offset.
FSR_API void fsr_lean_add_gait(void* stepped, const long long* beat, const double* wave, int count,
                               const int* controls, const double* joints) {
  std::vector<Gait::Joint> all;
  for (int i = 0; i < count; ++i) {
    const double* joint = joints + 3 * i;
    all.push_back({controls[i], joint[0], joint[1], joint[2]});
  }
  static_cast<Stepped*>(stepped)->commands.gaits.emplace_back(beat[0], beat[1], wave[0], wave[1],
                                                              wave[2], std::move(all));
}

// Hold these wrenches and no others (struct HeldWrench): addresses[3] position, velocity and 1 for
// body axes, numbers[6] force and torque, for each of `count`.
FSR_API void fsr_lean_hold_wrenches(void* stepped, int count, const int* addresses,
                                    const double* numbers) {
  std::vector<HeldWrench>& held = static_cast<Stepped*>(stepped)->commands.wrenches;
  held.clear();
  for (int i = 0; i < count; ++i) {
    const int* address = addresses + 3 * i;
    HeldWrench wrench{address[0], address[1], address[2] != 0, {}, {}};
    Copy3(wrench.force, numbers + 6 * i);
    Copy3(wrench.torque, numbers + 6 * i + 3);
    held.push_back(wrench);
  }
}

// What the steps leave out: out[0] why nothing at all (enum Whole, 0: they do), out[1] when
// contacts are looked for (enum Contacts), out[2] 1 if there are other constraints, out[3] the
// geoms that move at every evaluation, out[4] 1 if the last step was without contacts, out[5] 1 if
// moments of actuators at sites are made along their own trees alone, out[6] 1 if MuJoCo's own
// fluid forces are made along each body's chain alone.
FSR_API void fsr_lean_about(void* stepped, int* out) {
  Stepped* s = static_cast<Stepped*>(stepped);
  s->lean.Begin(s->m);
  out[0] = static_cast<int>(s->lean.whole());
  out[1] = static_cast<int>(s->lean.contacts());
  out[2] = s->lean.constraints();
  out[3] = s->lean.moved_geoms();
  out[4] = s->lean.off();
  out[5] = s->lean.disguised();
  out[6] = s->lean.fluid();
}
