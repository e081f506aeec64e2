// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "lean/lean.h"

#include <algorithm>

#include "lean/facts.h"

namespace fluid_sim {
namespace {

constexpr int kWait = 4;  // steps after one in which geoms came near; more would lose, fewer cost

bool HasKnownStages(int integrator) {
  return integrator == mjINT_EULER || integrator == mjINT_RK4 || integrator == mjINT_IMPLICIT ||
         integrator == mjINT_IMPLICITFAST;
}

Whole WhyWhole(const mjModel* m, bool own_plugins) {
  if (m->nflex > 0) return Whole::kFlexes;
  if (!own_plugins) return Whole::kPlugins;
  if (!NoCallbacks()) return Whole::kCallbacks;
  if ((m->opt.enableflags & ~mjENBL_ENERGY) || (m->opt.disableflags & mjDSBL_AUTORESET) ||
      !HasKnownStages(m->opt.integrator)) {
    return Whole::kOptions;
  }
  return Whole::kNo;
}

int FatalWarnings(const mjData* d) {
  return d->warning[mjWARN_BADQPOS].number + d->warning[mjWARN_BADQVEL].number +
         d->warning[mjWARN_BADQACC].number;
}

// The arrays of mjData that a step carries on, with their sizes.
struct Carried {
  mjtNum* numbers;
  mjtSize count;
};

template <class Visit>
void VisitCarried(const mjModel* m, const mjData* d, const Visit& visit) {
  const Carried all[] = {{d->qpos, m->nq},          {d->qvel, m->nv},
                         {d->act, m->na},           {d->qacc_warmstart, m->nv},
                         {d->history, m->nhistory}, {d->plugin_state, m->npluginstate}};
  for (const Carried& each : all) visit(each.numbers, static_cast<int>(each.count));
}

}  // namespace

void Lean::Learn(const mjModel* m) {
  head_ = *m;
  buffer_ = m->buffer;
  ReadFacts(m, &facts_);
  clearance_ = std::make_unique<Clearance>(m);
  transmission_.Learn(m);
  fluid_.Learn(m);
  own_plugins_ = OwnPluginsOnly(m);
  constraints_ = HasConstraints(m);
  kept_.resize(1 + m->nq + 2 * m->nv + m->na + m->nhistory + m->npluginstate);
  wait_ = 0;
}

void Lean::Begin(const mjModel* m) {
  if (m->buffer != buffer_ || m->signature != head_.signature || !SameFacts(m, facts_)) Learn(m);
  whole_ = WhyWhole(m, own_plugins_);
  head_.opt = m->opt;
  head_.stat = m->stat;
  head_.actuator_trntype = m->actuator_trntype;
  head_.actuator_trnid = m->actuator_trnid;
  disguised_ = whole_ == Whole::kNo && transmission_.Ready(m);
  if (disguised_) transmission_.Disguise(&head_);
  fluid_ready_ = whole_ == Whole::kNo && fluid_.Ready(m);
  if (fluid_ready_) fluid_.Disguise(&head_);
  moved_geoms_ = NeededGeoms(m, fluid_ready_);
}

void Lean::Step(const mjModel* m, mjData* d, bool last) {
  if (whole_ != Whole::kNo) return mj_step(m, d);
  const Contacts contacts = clearance_->contacts();
  off_ = contacts == Contacts::kNever;
  if (contacts == Contacts::kWatched && --wait_ < 0) {
    off_ = clearance_->Clear(d->qpos);
    if (!off_) wait_ = kWait;
  }
  const int flags = constraints_ ? mjDSBL_CONTACT : mjDSBL_CONTACT | mjDSBL_CONSTRAINT;
  head_.opt.disableflags = off_ ? m->opt.disableflags | flags : m->opt.disableflags;
  if (m->nsensor == 0) head_.opt.disableflags |= mjDSBL_SENSOR;  // nor a loop over plugins
  // geoms that collide may stand anywhere in the list
  const bool fewer = off_ && !last;
  head_.ngeom = fewer ? moved_geoms_ : m->ngeom;
  head_.ncam = fewer && m->nsensor == 0 ? 0 : m->ncam;
  head_.nlight = fewer && m->nsensor == 0 ? 0 : m->nlight;
  const int before = FatalWarnings(d);
  const Served served({&head_, m, disguised_, fluid_ready_ ? &fluid_ : nullptr});
  TakeStep(m, d, last);
  if (off_ && FatalWarnings(d) != before) StepAfterReset(m, d);
}

void Lean::TakeStep(const mjModel* m, mjData* d, bool last) {
  const int integrator = m->opt.integrator;
  if (integrator == mjINT_RK4 && off_ && clearance_->contacts() == Contacts::kWatched) {
    if (StepRungeKutta(m, d)) return;
    off_ = false;
    wait_ = kWait;
    mj_step(m, d);
  } else if (fluid_ready_ && (integrator == mjINT_IMPLICIT || integrator == mjINT_IMPLICITFAST)) {
    StepImplicit(m, d, last);
  } else {
    mj_step(&head_, d);
  }
}

// mj_step of the head in the parts that MuJoCo names, with the slopes of the fluid.
void Lean::StepImplicit(const mjModel* m, mjData* d, bool last) {
  mj_checkPos(&head_, d);
  mj_checkVel(&head_, d);
  mj_forward(&head_, d);
  mj_checkAcc(&head_, d);
  if (fluid_.ReadySlopes(m)) return fluid_.Integrate(m, &head_, d, last);
  head_.opt.density = m->opt.density;
  head_.opt.viscosity = m->opt.viscosity;
  mj_implicit(&head_, d);
  fluid_.Disguise(&head_);
}

// mj_step of the head in the parts that MuJoCo names. False, with d as it was, where geoms could
// have touched at one of the later stages x + h/2 v, x + h/2 (v + h/2 a) and the last, whose
// positions the evaluation leaves in d.
bool Lean::StepRungeKutta(const mjModel* m, mjData* d) {
  Keep(m, d);
  mj_checkPos(&head_, d);
  mj_checkVel(&head_, d);
  mj_forward(&head_, d);
  mj_checkAcc(&head_, d);
  const mjtNum half = 0.5 * m->opt.timestep;
  if (clearance_->ClearAfter(m, d, half, 0) && clearance_->ClearAfter(m, d, half, half)) {
    mj_RungeKutta(&head_, d, 4);
    if (clearance_->ClearAt(d)) return true;
  }
  Restore(m, d);
  return false;
}

// MuJoCo has set the state back to the model's initial one in this step, where geoms may touch.
void Lean::StepAfterReset(const mjModel* m, mjData* d) {
  std::copy(d->warning, d->warning + mjNWARNING, kept_warnings_);
  mj_resetData(m, d);
  mj_step(m, d);
  std::copy(kept_warnings_, kept_warnings_ + mjNWARNING, d->warning);
}

void Lean::Keep(const mjModel* m, const mjData* d) {
  mjtNum* next = kept_.data();
  *next++ = d->time;
  VisitCarried(m, d, [&next](const mjtNum* numbers, int count) {
    next = std::copy(numbers, numbers + count, next);
  });
  std::copy(d->warning, d->warning + mjNWARNING, kept_warnings_);
}

void Lean::Restore(const mjModel* m, mjData* d) const {
  const mjtNum* next = kept_.data();
  d->time = *next++;
  VisitCarried(m, d, [&next](mjtNum* numbers, int count) {
    std::copy(next, next + count, numbers);
    next += count;
  });
  std::copy(kept_warnings_, kept_warnings_ + mjNWARNING, d->warning);
}

}  // namespace fluid_sim
