// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// What Python sees of a state: one row per vehicle.

#include <mujoco/mujoco.h>

#include <cmath>

#include "api/api.h"
#include "api/untimed.h"
#include "assembly/acting.h"
#include "assembly/assembly.h"

namespace fluid_sim {
namespace {

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
    mjtNum* target = row + kFirstTerm + 6 * i;
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

// Fill one row of kRowWidth numbers per base body from the state of d.
// With `forces` the state is copied to `scratch` and a full forward pass is made there, so that
// accelerations (1), and wrenches too (2), belong to this very state and d is not touched.
FSR_API void fsr_observe(const mjModel* m, const mjData* d, mjData* scratch, const int* bases,
                         int count, int forces, double* rows) {
  const Untimed untimed;
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
FSR_API void fsr_raise_largest(const mjModel* m, const mjData* d, mjData* scratch, const int* bases,
                               int count, const double* start, double* largest, double* rows) {
  const Untimed untimed;
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

// Which terms can act on a body: acts[kTermCount] gets 1 for each that can, else 0.
FSR_API void fsr_acting_terms(const mjModel* m, const mjData* d, int body, int* acts) {
  bool can[kTermCount];
  ActingTerms(m, d, body, can);
  for (int i = 0; i < kTermCount; ++i) acts[i] = can[i];
}

// How far body number i of those with fluid_sim forces has left what they are good for, largest
// since the data was made or fsr_forget_limits: out[0] share of its extent that passed the surface
// in one step, out[1] speed at that [m/s], out[2] extent [m], out[3] Reynolds number of a drag that
// goes by it. Returns the body's id, or -1 beyond the last.
FSR_API int fsr_limits(const mjModel* m, const mjData* d, int i, double* out) {
  const Assembly* assembly = FindAssembly(m, d);
  if (!assembly || i < 0 || i >= static_cast<int>(assembly->limits.size())) return -1;
  const BodyLimits& limits = assembly->limits[i];
  out[0] = limits.crossing_share;
  out[1] = limits.crossing_speed;
  out[2] = limits.crossing_extent;
  out[3] = limits.reynolds;
  return assembly->bodies[i].id;
}

// Begin anew with the largest values of fsr_limits.
FSR_API void fsr_forget_limits(const mjModel* m, const mjData* d) {
  Assembly* assembly = const_cast<Assembly*>(FindAssembly(m, d));
  if (assembly) assembly->limits.assign(assembly->limits.size(), BodyLimits());
}
