// Watched stepping.

#include <mujoco/mujoco.h>

#include <cmath>

#include "api/api.h"
#include "api/quiet.h"

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
}  // namespace fluid_sim

using namespace fluid_sim;

// Take up to n steps and stop at the first bad one (NaN, or a MuJoCo warning that resets the state
// silently). Returns the number of good steps; report[0] = time at the start of the bad step,
// report[1] = its dof or -1.
FSR_API int fsr_step(const mjModel* m, mjData* d, int n, double* report) {
  const QuietWarnings quiet;  // a bad step is in the report, MuJoCo need not print it too
  const int before = FatalWarnings(d);
  for (int i = 0; i < n; ++i) {
    const mjtNum time = d->time;
    mj_step(m, d);
    if (FatalWarnings(d) != before || !AllFinite(d->qpos, m->nq) || !AllFinite(d->qvel, m->nv)) {
      report[0] = time;
      report[1] = BadDof(m, d);
      return i;
    }
  }
  return n;
}
