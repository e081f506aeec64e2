// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "assembly/assembly.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "assembly/instances.h"
#include "body/body_checks.h"
#include "body/body_forces.h"
#include "body/factor.h"
#include "body/inertia.h"
#include "body/stock_terms.h"
#include "lean/served.h"
#include "shared/config.h"
#include "shared/point_motion.h"
#include "shared/references.h"
#include "shared/spatial.h"
#include "thruster/thruster.h"

namespace fluid_sim {
namespace {

const Medium kNoMedium{};
constexpr mjtNum kNoSpin[3] = {0, 0, 0};

bool HasFoil(const Assembly& assembly, int body) {
  for (const Foil& foil : assembly.foils) {
    if (foil.body == body) return true;
  }
  return false;
}

std::unique_ptr<Assembly> BuildAssembly(const mjModel* m, int owner) {
  auto assembly = std::make_unique<Assembly>();
  assembly->owner = owner;
  assembly->last = LastInstance(m);
  if (!CheckReferences(m) || !ReadMedium(m, &assembly->medium) || !CheckInstancesUsed(m))
    return nullptr;
  if (!ReadFoils(m, assembly->medium, &assembly->foils)) return nullptr;
  for (int body = 1; body < m->nbody; ++body) {
    int instance = m->body_plugin[body];
    if (instance >= 0 && !IsPlugin(m, instance, kBodyPlugin)) instance = -1;
    const bool has_foil = HasFoil(*assembly, body);
    if (instance < 0 && (has_foil || !AsksForDrag(m, body, assembly->medium))) continue;
    BodyFluid fluid;
    if (!ReadBody(m, instance, body, assembly->medium, has_foil, &fluid)) return nullptr;
    assembly->bodies.push_back(std::move(fluid));
  }
  assembly->limits.resize(assembly->bodies.size());
  return CheckOptions(m, owner, assembly->bodies) ? std::move(assembly) : nullptr;
}

// Changes the inertia matrix at this call.
bool AddsInertia(const BodyFluid& body, bool secant) {
  const bool braked = body.damping.any || (body.plugin_drag() && body.implicit);
  return body.added_mass || (secant && braked);
}

void ApplyForces(const mjModel* m, mjData* d, const BodyFluid& body, const Motion& motion,
                 const BodyForces& forces) {
  mjtNum wrench[6] = {0, 0, 0, 0, 0, 0};
  for (const auto& term : forces.term) {
    for (int i = 0; i < 6; ++i) wrench[i] += term[i];
  }
  ApplyWrench(m, d, body, motion, wrench);
}

// MuJoCo's own forces were evaluated in opt.wind: add what the local flow makes of them.
void CorrectStockForces(const mjModel* m, mjData* d, const Medium& medium) {
  for (int body = 1; body < m->nbody; ++body) {
    if (m->body_mass[body] < mjMINVAL || IsAsleep(m, d, body)) continue;
    const mjtNum* center = d->xipos + 3 * body;
    Flow flow[2];
    FlowsAt(medium, m, d, body, center, 1, flow);
    Wrench local[kTermCount], stock[kTermCount], change;
    AddStockTerms(m, d, body, {flow[0].velocity, flow[0].spin}, center, local);
    AddStockTerms(m, d, body, {m->opt.wind, kNoSpin}, center, stock);
    for (int i = 0; i < kTermCount; ++i) {
      AddDifference3(change.force, local[i].force, stock[i].force);
      AddDifference3(change.torque, local[i].torque, stock[i].torque);
    }
    for (mjtNum* target : {d->qfrc_fluid, d->qfrc_passive}) {
      AddGeneralizedForce(m, d, body, center, change.force, change.torque, target);
    }
  }
}

void Note(const BodyForces& forces, mjtNum timestep, BodyLimits* limits) {
  const mjtNum share = forces.crossing.Share(timestep);
  if (share > limits->crossing_share) {
    limits->crossing_share = share;
    limits->crossing_speed = std::abs(forces.crossing.speed);
    limits->crossing_extent = forces.crossing.extent;
  }
  limits->reynolds = std::max(limits->reynolds, forces.reynolds);
}

// `fresh`: the inertia matrix was made since the positions came, and not changed. The secant D_s
// makes drag implicit for the first-order integrators: (M + A + h D_s) qacc = f.
// RK4 needs the true acceleration at each stage.
void Evaluate(Assembly& assembly, const mjModel* m, mjData* d, bool fresh) {
  const bool secant = m->opt.integrator != mjINT_RK4;
  bool any = false, chain = false;
  for (const BodyFluid& body : assembly.bodies) {
    const bool adds = AddsInertia(body, secant);
    any |= adds;
    chain |= adds && body.free_dof < 0;
  }
  if (chain && !fresh) mj_makeM(m, d);  // a repeated evaluation must not add A twice
  // the blocks of other trees are factored already
  bool factor_all = chain || (m->opt.enableflags & mjENBL_SLEEP);
  for (size_t i = 0; i < assembly.bodies.size(); ++i) {
    const BodyFluid& body = assembly.bodies[i];
    if (IsAsleep(m, d, body.id)) continue;
    const Motion motion = BodyMotion(m, d, body);
    BodyForces forces;
    EvaluateBody(m, d, assembly.medium, body, motion, secant && body.implicit, &forces);
    Note(forces, m->opt.timestep, &assembly.limits[i]);
    ApplyForces(m, d, body, motion, forces);
    if (!AddsInertia(body, secant)) continue;
    if (secant && body.implicit) AddScaled36(forces.inertia, forces.secant, m->opt.timestep);
    if (body.free_dof >= 0) {
      WriteFreeInertia(m, d, body, motion, forces.inertia);
      factor_all = factor_all || !FactorFreeTree(m, d, body.free_dof);
    } else {
      AddChainInertia(m, d, body, motion, forces.inertia);
    }
  }
  for (const Foil& foil : assembly.foils) ApplyFoil(m, d, assembly.medium, foil);
  if (assembly.medium.corrects_stock) CorrectStockForces(m, d, assembly.medium);
  if (any && factor_all) mj_factorM(m, d);
}

Assembly* Stored(const mjData* d, int instance) {
  return reinterpret_cast<Assembly*>(d->plugin_data[instance]);
}

int Init(const mjModel* m, mjData* d, int instance) {
  const int first = FirstInstance(m);
  if (instance != first) {
    d->plugin_data[instance] = d->plugin_data[first];
    return 0;
  }
  d->plugin_data[instance] = 0;
  std::unique_ptr<Assembly> assembly = BuildAssembly(m, first);
  if (!assembly) return -1;
  d->plugin_data[instance] = reinterpret_cast<uintptr_t>(assembly.release());
  return 0;
}

void Destroy(mjData* d, int instance) {
  Assembly* assembly = Stored(d, instance);
  if (!assembly) return;
  for (int i = 0; i < d->nplugin; ++i) {
    if (Stored(d, i) == assembly) d->plugin_data[i] = 0;
  }
  delete assembly;
}

void Reset(const mjModel* m, mjtNum* state, void* data, int instance) {
  const Assembly* assembly = static_cast<const Assembly*>(data);
  if (assembly && IsPlugin(m, instance, kMediumPlugin)) {
    ResetMediumState(assembly->medium, state);
  } else if (IsPlugin(m, instance, kBodyPlugin)) {
    mju_zero(state, HistoryStateSize(m, instance));
  }
}

void Compute(const mjModel* given, mjData* d, int instance, int) {
  const mjModel* m = WholeModel(given);
  Assembly* assembly = Stored(d, instance);
  if (assembly && assembly->owner == instance) Evaluate(*assembly, m, d, m != given);
}

void Advance(const mjModel* given, mjData* d, int instance) {
  const mjModel* m = WholeModel(given);
  const Assembly* assembly = Stored(d, instance);
  if (!assembly) return;
  if (assembly->medium.instance == instance) AdvanceMedium(assembly->medium, m, d);
  if (assembly->last != instance) return;
  for (const BodyFluid& body : assembly->bodies) {
    if (body.history.on()) AdvanceHistory(m, d, assembly->medium, body);
  }
}

void Register(const char* name, const char* const* attributes, int count,
              int (*nstate)(const mjModel*, int)) {
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = name;
  plugin.attributes = attributes;
  plugin.nattribute = count;
  plugin.capabilityflags = mjPLUGIN_PASSIVE;
  plugin.nstate = nstate;
  plugin.init = Init;
  plugin.destroy = Destroy;
  plugin.reset = Reset;
  plugin.compute = Compute;
  plugin.advance = Advance;
  mjp_registerPlugin(&plugin);
}

const BodyFluid* FindBody(const Assembly& assembly, int id) {
  for (const BodyFluid& body : assembly.bodies) {
    if (body.id == id) return &body;
  }
  return nullptr;
}

}  // namespace

const Assembly* FindAssembly(const mjModel* m, const mjData* d) {
  const int first = FirstInstance(m);
  return first < 0 ? nullptr : Stored(d, first);
}

EnergyState KineticEnergy(const mjModel* m, mjData* d) {
  EnergyState out;
  mj_makeM(m, d);
  for (int i = 0; i < m->nv; ++i) {  // lower triangle: off-diagonal entries count twice
    const int row = m->M_rowadr[i], last = row + m->M_rownnz[i] - 1;
    mjtNum momentum = 0.5 * d->M[last] * d->qvel[i];
    for (int k = row; k < last; ++k) momentum += d->M[k] * d->qvel[m->M_colind[k]];
    out.bodies += momentum * d->qvel[i];
  }
  const Assembly* assembly = FindAssembly(m, d);
  if (!assembly) return out;
  for (const BodyFluid& body : assembly->bodies) {
    BodyForces forces;
    EvaluateBody(m, d, assembly->medium, body, BodyMotion(m, d, body), false, &forces);
    out.flow += forces.fluid_energy;
    out.surface_loss += forces.surface_loss;
  }
  return out;
}

void AddPluginTerms(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                    bool acceleration, Wrench terms[kTermCount]) {
  AddRotorTerms(m, d, body, point_w, terms);
  const Assembly* assembly = FindAssembly(m, d);
  if (!assembly) return;
  for (const Foil& foil : assembly->foils) {
    if (foil.body != body) continue;
    const Wrench load = EvaluateFoil(m, d, assembly->medium, foil, point_w);
    mju_addTo3(terms[kFoil].force, load.force);
    mju_addTo3(terms[kFoil].torque, load.torque);
  }
  const BodyFluid* fluid = FindBody(*assembly, body);
  if (!fluid) return;
  const Motion motion = BodyMotion(m, d, *fluid);
  BodyForces forces;
  EvaluateBody(m, d, assembly->medium, *fluid, motion, false, &forces);
  if (acceleration) {
    mjtNum accel[6], push[6];
    PointAcceleration(m, d, *fluid, motion, accel);
    mju_mulMatVec(push, forces.inertia, accel, 6, 6);
    mju_subFrom(forces.term[kAddedMass], push, 6);
  }
  for (int i = 0; i < kTermCount; ++i) {
    Wrench local;
    mju_copy3(local.force, forces.term[i]);
    mju_copy3(local.torque, forces.term[i] + 3);
    AddLocalWrench(local, motion.rotation, motion.point_w, point_w, 1, terms + i);
  }
}

void AddLocalStockTerms(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                        Wrench terms[kTermCount]) {
  const Flow flow = FluidAround(m, d, body, d->xipos + 3 * body);
  AddStockTerms(m, d, body, {flow.velocity, flow.spin}, point_w, terms);
}

Flow FluidAround(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3]) {
  const Assembly* assembly = FindAssembly(m, d);
  const Medium& medium = assembly ? assembly->medium : kNoMedium;
  const bool above =
      medium.in_charge() && medium.has_surface && point_w[2] > SurfaceHeight(medium, d, point_w);
  Flow flows[2];
  FlowsAt(medium, m, d, body, point_w, above ? 0 : 1, flows);
  return flows[0];
}

void RegisterAssembly() {
  Register(kBodyPlugin, kBodyAttributes, kBodyAttributeCount, HistoryStateSize);
  Register(kMediumPlugin, kMediumAttributes, kMediumAttributeCount, MediumStateSize);
  Register(kFoilPlugin, kFoilAttributes, kFoilAttributeCount,
           [](const mjModel*, int) { return 0; });
}

}  // namespace fluid_sim
