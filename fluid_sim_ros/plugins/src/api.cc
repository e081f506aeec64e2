// C functions for Python (bound in plugins/native.py): watched stepping and observation.

#include <mujoco/mujoco.h>

#include <cmath>
#include <cstring>

#include "assembly.h"
#include "fluid_terms.h"
#include "quiet.h"

#define FSR_API extern "C" __attribute__((visibility("default")))

namespace fluid_sim {
namespace {

// Columns of one row that fsr_observe writes per vehicle; native.py holds the same numbers.
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
  kTerms = 34,                // kTermCount wrenches
  kRowWidth = kTerms + 6 * kTermCount
};

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

// Index of the free joint of `body`, or -1.
int FreeJoint(const mjModel* m, int body) {
  const int joint = m->body_jntadr[body];
  return joint >= 0 && m->jnt_type[joint] == mjJNT_FREE ? joint : -1;
}

// Kinematics straight from the state: exact for a free base, without any forward pass.
void ObserveFreeBase(const mjModel* m, const mjData* d, int joint, mjtNum* row) {
  const mjtNum* qpos = d->qpos + m->jnt_qposadr[joint];
  const mjtNum* qvel = d->qvel + m->jnt_dofadr[joint];
  mjtNum inverse[4];
  mju_copy3(row + kPosition, qpos);
  mju_copy4(row + kQuaternion, qpos + 3);
  mju_normalize4(row + kQuaternion);
  mju_negQuat(inverse, row + kQuaternion);
  mju_rotVecQuat(row + kLinearVelocity, qvel, inverse);
  mju_copy3(row + kAngularVelocity, qvel + 3);
}

void ObserveJointedBase(const mjModel* m, const mjData* d, int body, mjtNum* row) {
  mjtNum spatial[6];
  mju_copy3(row + kPosition, d->xpos + 3 * body);
  mju_copy4(row + kQuaternion, d->xquat + 4 * body);
  mj_objectVelocity(m, d, mjOBJ_XBODY, body, spatial, 1);
  mju_copy3(row + kAngularVelocity, spatial);
  mju_copy3(row + kLinearVelocity, spatial + 3);
}

// Motion of every base body; `scratch` takes the forward pass, for bases without a free joint too.
void ObserveMotion(const mjModel* m, const mjData* d, mjData* scratch, const int* bases, int count,
                   bool forces, double* rows) {
  bool jointed = false;
  for (int i = 0; i < count; ++i) jointed |= FreeJoint(m, bases[i]) < 0;
  if (forces || jointed) {
    mj_copyState(m, d, scratch, mjSTATE_INTEGRATION);
    if (forces) {
      mj_forward(m, scratch);
      mj_rnePostConstraint(m, scratch);
    } else {
      mj_fwdPosition(m, scratch);
      mj_fwdVelocity(m, scratch);
    }
  }
  for (int i = 0; i < count; ++i) {
    double* row = rows + kRowWidth * i;
    const int joint = FreeJoint(m, bases[i]);
    if (joint >= 0) {
      ObserveFreeBase(m, d, joint, row);
    } else {
      ObserveJointedBase(m, scratch, bases[i], row);
    }
  }
}

void StoreWrench(const Wrench& wrench_w, const mjtNum* rotation, mjtNum* target) {
  mju_mulMatTVec3(target, rotation, wrench_w.force);
  mju_mulMatTVec3(target + 3, rotation, wrench_w.torque);
}

void ObserveWrenches(const mjModel* m, const mjData* d, int base, mjtNum* row) {
  const mjtNum* rotation = d->xmat + 9 * base;
  const mjtNum* origin = d->xpos + 3 * base;
  Wrench terms[kTermCount];
  // a subtree is contiguous in MuJoCo's depth-first body order
  for (int body = base; body < m->nbody; ++body) {
    if (body > base && m->body_parentid[body] < base) break;
    AddLocalStockTerms(m, d, body, origin, terms);
    AddPluginTerms(m, d, body, origin, true, terms);
  }
  mju_zero(row + kTotal, 6);
  for (int i = 0; i < kTermCount; ++i) {
    mjtNum* target = row + kTerms + 6 * i;
    StoreWrench(terms[i], rotation, target);
    mju_addTo(row + kTotal, target, 6);
  }
  mju_zero(row + kThrust, 6);
  const int joint = FreeJoint(m, base);
  if (joint >= 0) {
    const mjtNum* generalized = d->qfrc_actuator + m->jnt_dofadr[joint];
    mju_mulMatTVec3(row + kThrust, rotation, generalized);
    mju_copy3(row + kThrust + 3, generalized + 3);
  }
}

void ObserveAcceleration(const mjModel* m, const mjData* d, int base, mjtNum* row) {
  mjtNum spatial[6];  // rotational, then linear minus gravity (cacc holds -g at the root)
  mj_objectAcceleration(m, d, mjOBJ_XBODY, base, spatial, 1);
  mju_copy3(row + kAngularAcceleration, spatial);
  mju_copy3(row + kSpecificForce, spatial + 3);
}

}  // namespace
}  // namespace fluid_sim

using namespace fluid_sim;

// Version of MuJoCo that this library was compiled against (mjVERSION_HEADER).
FSR_API int fsr_built_for() { return mjVERSION_HEADER; }

FSR_API int fsr_row_width() { return kRowWidth; }

FSR_API int fsr_term_count() { return kTermCount; }

// Configuration key i of a plugin by name, or null.
FSR_API const char* fsr_plugin_key(const char* name, int i) {
  const mjpPlugin* plugin = mjp_getPlugin(name, nullptr);
  return plugin && i >= 0 && i < plugin->nattribute ? plugin->attributes[i] : nullptr;
}

// Value of a configuration key of a plugin instance, or null unless it is of plugin `name`.
FSR_API const char* fsr_plugin_config(const mjModel* m, int instance, const char* name,
                                      const char* key) {
  if (instance < 0 || instance >= m->nplugin) return nullptr;
  const mjpPlugin* plugin = mjp_getPluginAtSlot(m->plugin[instance]);
  if (!plugin || std::strcmp(plugin->name, name) != 0) return nullptr;
  return mj_getPluginConfig(m, instance, key);
}

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

// Fill one row of kRowWidth numbers per base body from the state of d.
// With `forces` the state is copied to `scratch` and a full forward pass is made there, so that
// accelerations (1), and wrenches too (2), belong to this very state and d is not touched.
FSR_API void fsr_observe(const mjModel* m, const mjData* d, mjData* scratch, const int* bases,
                         int count, int forces, double* rows) {
  ObserveMotion(m, d, scratch, bases, count, forces, rows);
  for (int i = 0; i < count; ++i) {
    double* row = rows + kRowWidth * i;
    const Flow flow = FluidAround(m, d, bases[i], row + kPosition);
    mju_copy3(row + kMediumVelocity, flow.velocity);
    if (forces) ObserveAcceleration(m, scratch, bases[i], row);
    if (forces > 1) ObserveWrenches(m, scratch, bases[i], row);
  }
}

// Look at the motion of the base bodies: raise largest[3 * i + 0..2] to the speed [m/s], the tilt
// [rad] and the distance [m] from start[3 * i + 0..2] of base i where these are larger (NaN is
// not), and fill the motion of `rows`; its flow and forces stay as they are.
FSR_API void fsr_look(const mjModel* m, const mjData* d, mjData* scratch, const int* bases,
                      int count, const double* start, double* largest, double* rows) {
  ObserveMotion(m, d, scratch, bases, count, false, rows);
  for (int i = 0; i < count; ++i) {
    const double* row = rows + kRowWidth * i;
    const double* quat = row + kQuaternion;
    const double up = 1 - 2 * (quat[1] * quat[1] + quat[2] * quat[2]);
    const double seen[3] = {mju_norm3(row + kLinearVelocity), std::acos(mju_clip(up, -1, 1)),
                            mju_dist3(row + kPosition, start + 3 * i)};
    for (int k = 0; k < 3; ++k) largest[3 * i + k] = std::fmax(largest[3 * i + k], seen[k]);
  }
}

// Explicit generalized fluid force of MuJoCo and the plugins at the state in d, from the terms
// alone: sum of J' wrench, out[nv]. For checks against qfrc_fluid. Uses and needs `scratch`.
FSR_API void fsr_explicit_force(const mjModel* m, const mjData* d, mjData* scratch, double* out) {
  mj_copyState(m, d, scratch, mjSTATE_INTEGRATION);
  mj_fwdPosition(m, scratch);
  mj_fwdVelocity(m, scratch);
  mju_zero(out, m->nv);
  for (int body = 1; body < m->nbody; ++body) {
    const mjtNum* origin = scratch->xpos + 3 * body;
    Wrench terms[kTermCount];
    AddLocalStockTerms(m, scratch, body, origin, terms);
    AddPluginTerms(m, scratch, body, origin, false, terms);
    for (const Wrench& term : terms) {
      mj_applyFT(m, scratch, term.force, term.torque, origin, body, out);
    }
  }
}

// Kinetic energy [J] at the state in d: out[0] of the bodies, out[1] of the flow around them.
FSR_API void fsr_kinetic_energy(const mjModel* m, const mjData* d, mjData* scratch, double* out) {
  mj_copyState(m, d, scratch, mjSTATE_INTEGRATION);
  mj_fwdPosition(m, scratch);
  mj_fwdVelocity(m, scratch);
  const EnergyState energy = KineticEnergy(m, scratch);
  out[0] = energy.bodies;
  out[1] = energy.flow;
}
