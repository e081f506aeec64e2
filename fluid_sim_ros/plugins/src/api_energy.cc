// C functions for the energy watchdog: what a first-order integrator feeds into the motion.

#include <mujoco/mujoco.h>

#include "assembly.h"
#include "fluid_terms.h"
#include "stock_terms.h"

#define FSR_API extern "C" __attribute__((visibility("default")))

namespace fluid_sim {
namespace {

// Columns of the answer; engine.py names the same.
enum Answer { kKinetic = 0, kFeed = 1, kDissipation = 2 };

// Generalized velocity-dependent bias of the bodies alone: bias(q, v) - bias(q, 0).
void Gyroscopic(const mjModel* m, mjData* d, mjtNum* force) {
  mj_markStack(d);
  mjtNum* velocity = mj_stackAllocNum(d, m->nv);
  mju_scl(force, d->qfrc_bias, -1, m->nv);
  mju_copy(velocity, d->qvel, m->nv);
  mju_zero(d->qvel, m->nv);
  mj_fwdVelocity(m, d);
  mju_addTo(force, d->qfrc_bias, m->nv);
  mju_copy(d->qvel, velocity, m->nv);
  mj_fwdVelocity(m, d);
  mj_freeStack(d);
}

// Add J' of one term of every body: of the plugins, and with `stock` of MuJoCo's own.
void AddTerm(const mjModel* m, mjData* d, Term term, bool stock, mjtNum* force) {
  for (int body = 1; body < m->nbody; ++body) {
    const mjtNum* origin = d->xpos + 3 * body;
    Wrench terms[kTermCount];
    if (stock) AddStockTerms(m, d, body, origin, terms);
    AddPluginTerms(m, d, body, origin, false, terms);
    mj_applyFT(m, d, terms[term].force, terms[term].torque, origin, body, force);
  }
}

}  // namespace
}  // namespace fluid_sim

using namespace fluid_sim;

// Kinetic energy of bodies and flow at the state in d [J], the power that the integrator feeds
// into it [W], and the power that drag and damping take out [W].
//
// A workless force g (gyroscopic, convective added mass) that is applied over a whole step h as it
// stood at the start adds h^2/2 g' M^-1 g to the energy of every step. RK4 is free of it to its
// order; implicit integrators take in MuJoCo's own part of g, but never a plugin's.
FSR_API void fsr_energy_feed(const mjModel* m, const mjData* d, mjData* scratch, double* out) {
  mj_copyState(m, d, scratch, mjSTATE_INTEGRATION);
  mj_forward(m, scratch);
  mjtNum kinetic[2];
  const int integrator = m->opt.integrator;
  const bool explicit_stock = integrator == mjINT_EULER || integrator == mjINT_DISCRETE;
  mj_markStack(scratch);
  mjtNum* workless = mj_stackAllocNum(scratch, m->nv);
  mjtNum* drag = mj_stackAllocNum(scratch, m->nv);
  mjtNum* answer = mj_stackAllocNum(scratch, m->nv);
  mju_zero(workless, m->nv);
  mju_zero(drag, m->nv);
  if (explicit_stock || integrator == mjINT_IMPLICITFAST) Gyroscopic(m, scratch, workless);
  AddTerm(m, scratch, kAddedMass, explicit_stock, workless);
  for (Term term : {kDrag, kViscous, kDamping}) AddTerm(m, scratch, term, true, drag);
  mj_forward(m, scratch);  // factorised inertia with the added mass
  mj_solveM(m, scratch, answer, workless, 1);
  out[kFeed] =
      integrator == mjINT_RK4 ? 0 : m->opt.timestep / 2 * mju_dot(workless, answer, m->nv);
  out[kDissipation] = -mju_dot(drag, scratch->qvel, m->nv);
  mj_freeStack(scratch);
  KineticEnergy(m, scratch, kinetic);
  out[kKinetic] = kinetic[0] + kinetic[1];
}
