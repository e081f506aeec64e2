// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// For the energy watchdog: energy that the integrator makes or loses by itself; and forces and
// energies alone, for tests.

#include <mujoco/mujoco.h>

#include "api/api.h"
#include "api/quiet.h"
#include "api/untimed.h"
#include "assembly/assembly.h"
#include "body/stock_terms.h"
#include "shared/terms.h"

namespace fluid_sim {
namespace {

// Columns of the answer; engine.py names the same.
enum Answer { kKinetic = 0, kFeed = 1, kDissipation = 2 };

struct Balance {
  mjtNum kinetic;      // of bodies and flow [J]
  mjtNum power;        // of all forces that do work [W]
  mjtNum dissipation;  // by drag, damping and the surface [W]
};

// Holds the fluids of one data still: in a moving flow the added mass does work, and the energy of
// body and flow says nothing about the integrator.
class StillFluids {
 public:
  StillFluids(const mjModel* m, const mjData* d)
      : assembly_(const_cast<Assembly*>(FindAssembly(m, d))) {
    if (assembly_) assembly_->medium.still = true;
  }
  ~StillFluids() {
    if (assembly_) assembly_->medium.still = false;
  }
  StillFluids(const StillFluids&) = delete;
  StillFluids& operator=(const StillFluids&) = delete;

 private:
  Assembly* assembly_;
};

// Add J' f of the added-mass terms and of the terms that dissipate of every body.
void FluidForces(const mjModel* m, mjData* d, mjtNum* added_mass, mjtNum* drag) {
  for (int body = 1; body < m->nbody; ++body) {
    const mjtNum* origin = d->xpos + 3 * body;
    Wrench terms[kTermCount];
    AddLocalStockTerms(m, d, body, origin, terms);
    AddPluginTerms(m, d, body, origin, false, terms);
    mj_applyFT(m, d, terms[kAddedMass].force, terms[kAddedMass].torque, origin, body, added_mass);
    for (int i = 0; i < kTermCount; ++i) {
      if (!kTerms[i].dissipates) continue;
      mj_applyFT(m, d, terms[i].force, terms[i].torque, origin, body, drag);
    }
  }
}

// v.f of everything but the workless forces: convective added mass (subtracted from
// qfrc_passive) and gyroscopic (only the part of qfrc_bias at rest, gravity, is taken).
Balance Evaluate(const mjModel* m, mjData* d) {
  Balance out;
  mj_forward(m, d);
  mj_markStack(d);
  mjtNum* force = mj_stackAllocNum(d, m->nv);
  mjtNum* drag = mj_stackAllocNum(d, m->nv);
  mjtNum* velocity = mj_stackAllocNum(d, m->nv);
  mju_copy(velocity, d->qvel, m->nv);
  mju_zero(force, m->nv);
  mju_zero(drag, m->nv);
  FluidForces(m, d, force, drag);
  mju_scl(force, force, -1, m->nv);
  mju_addTo(force, d->qfrc_passive, m->nv);
  mju_addTo(force, d->qfrc_actuator, m->nv);
  mju_addTo(force, d->qfrc_applied, m->nv);
  mju_addTo(force, d->qfrc_constraint, m->nv);
  for (int body = 1; body < m->nbody; ++body) {
    const mjtNum* applied = d->xfrc_applied + 6 * body;
    mj_applyFT(m, d, applied, applied + 3, d->xipos + 3 * body, body, force);
  }
  const EnergyState energy = KineticEnergy(m, d);
  out.kinetic = energy.bodies + energy.flow;
  mju_zero(d->qvel, m->nv);
  mj_fwdVelocity(m, d);
  mju_subFrom(force, d->qfrc_bias, m->nv);
  mju_copy(d->qvel, velocity, m->nv);
  out.power = mju_dot(force, velocity, m->nv) - energy.surface_loss;
  out.dissipation = energy.surface_loss - mju_dot(drag, velocity, m->nv);
  mj_freeStack(d);
  return out;
}

}  // namespace
}  // namespace fluid_sim

using namespace fluid_sim;

// Kinetic energy of bodies and flow at the state in d [J]; the power that the integrator adds to it
// by itself [W], (T1 - T0)/h less the mean power of the forces over one step; and the power that
// drag and damping take out [W]. The step is taken on `scratch`, in still fluids.
FSR_API void fsr_energy_feed(const mjModel* m, const mjData* d, mjData* scratch, double* out) {
  const QuietWarnings quiet;
  const Untimed untimed;
  const StillFluids still(m, scratch);
  mj_copyState(m, d, scratch, mjSTATE_INTEGRATION);
  const Balance start = Evaluate(m, scratch);
  mj_step(m, scratch);
  const Balance end = Evaluate(m, scratch);
  out[kKinetic] = start.kinetic;
  out[kFeed] = (end.kinetic - start.kinetic) / m->opt.timestep - (start.power + end.power) / 2;
  out[kDissipation] = start.dissipation;
}

namespace {

// Energy that comes or goes by itself is worth a second look beyond this share per second [1/s];
// simulation/energy.py has the same.
constexpr mjtNum kNotableFeed = 1e-2;

// The feed [W] without the error of its measurement. The work of the forces is taken from both ends
// of a step. Where they change within it, as those of a stiff servo, that is off by the square of
// the timestep h, in which the feed of an integrator is of the first order (RK4: of the fourth). So
// a look at h/2 parts the two.
mjtNum RefinedFeed(mjModel* m, const mjData* d, mjData* scratch, mjtNum feed) {
  const mjtNum timestep = m->opt.timestep;
  mjtNum half[3];
  m->opt.timestep = 0.5 * timestep;
  fsr_energy_feed(m, d, scratch, half);
  m->opt.timestep = timestep;
  if (m->opt.integrator == mjINT_RK4) return (feed - 4 * half[kFeed]) * 4 / 3;
  return 4 * half[kFeed] - feed;
}

}  // namespace

// For the watch over a run: add what holds at the state in d, for the `seconds` that have passed
// since the last time, to sums[3]: what the integrator added by itself [J], what drag and damping
// took out [J], and the largest kinetic energy [J]. A state with contacts is left out, since the
// work of an impact is not known from its ends.
FSR_API void fsr_energy_take(mjModel* m, const mjData* d, mjData* scratch, double seconds,
                             double* sums) {
  mjtNum balance[3];
  fsr_energy_feed(m, d, scratch, balance);
  bool contacts = d->ncon || scratch->ncon;  // before the step, or after it
  mjtNum feed = balance[kFeed];
  const mjtNum quiet = mju_max(balance[kDissipation], kNotableFeed * balance[kKinetic]);
  if (mju_abs(feed) > quiet && balance[kKinetic] > 0) {
    feed = RefinedFeed(m, d, scratch, feed);
    contacts |= scratch->ncon > 0;
  }
  if (contacts) return;
  sums[0] += feed * seconds;
  sums[1] += mju_max(balance[kDissipation], 0) * seconds;
  sums[2] = mju_max(sums[2], balance[kKinetic]);
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
