// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "thruster/thruster.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "body/stock_terms.h"
#include "lean/served.h"
#include "shared/config.h"
#include "shared/point_motion.h"
#include "shared/references.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

bool IsThruster(const mjModel* m, int instance) { return IsPlugin(m, instance, kThrusterPlugin); }

bool IsOff(const mjModel* m, int actuator) {
  const int group = m->actuator_group[actuator];
  return (m->opt.disableflags & mjDSBL_ACTUATION) ||
         (group >= 0 && group < 31 && (m->opt.disableactuator & (1 << group)));
}

// The command as MuJoCo would hand it to an actuator of its own.
mjtNum ReadCommand(const mjModel* m, const mjData* d, int actuator, bool* saturated) {
  const int address = m->actuator_ctrladr[actuator];
  const mjtNum command = d->ctrl[address];
  if (!std::isfinite(command)) return 0;  // MuJoCo warns (mjWARN_BADCTRL) and takes 0
  if (!m->actuator_ctrllimited[address] || (m->opt.disableflags & mjDSBL_CLAMPCTRL)) {
    return command;
  }
  const mjtNum* range = m->actuator_ctrlrange + 2 * address;
  const mjtNum kept = std::clamp(command, range[0], range[1]);
  *saturated |= kept != command;
  return kept;
}

// How much more thrust the ground under the rotor gives: Cheeseman and Bennett (1955),
// 1/(1 - (R/4z)^2), or 1 + C (R/4z)^2; z along the wake, at least R/2.
mjtNum GroundFactor(const Thruster& t, mjtNum height, mjtNum axis_z) {
  if (axis_z <= 0) return 1;
  const mjtNum radius = 0.5 * t.curve.diameter;
  const mjtNum along = std::max((height - t.ground) / axis_z, 0.5 * radius);
  const mjtNum ratio = radius / (4 * along), square = ratio * ratio;
  return t.ground_effect < 0 ? 1 / (1 - square) : 1 + t.ground_effect * square;
}

// The fluids that the disc reaches into.
int DiscFlows(const mjModel* m, const mjData* d, const Thruster& t, const mjtNum axis_w[3],
              Flow flows[2]) {
  const mjtNum* center = d->site_xpos + 3 * t.site;
  mjtNum wet = 1;
  if (t.medium.in_charge() && t.medium.has_surface) {
    const mjtNum depth = SurfaceHeight(t.medium, d, center) - center[2];
    wet = t.works == Works::kConstant ? (depth < 0 ? 0 : 1)
                                      : DiscShare(depth, 0.5 * t.curve.diameter, axis_w[2]);
  }
  return FlowsAt(t.medium, m, d, t.body, center, wet, flows);
}

// What the thruster does in this fluid, of what its curve says.
mjtNum FluidFactor(const Thruster& t, const Flow& flow) {
  switch (t.works) {
    case Works::kLocal:
      return flow.density / t.curve.density;
    case Works::kWater:
      return flow.lower ? 1 : 0;
    case Works::kAir:
      return flow.lower ? 0 : 1;
    default:
      return 1;
  }
}

// Drag -|w| (k v_across + k_z v_along) and rolling moment -w s c v_across of a rigid rotor in
// edgewise flow (Martin and Salaun 2010; Furrer et al. 2016, RotorS).
void AddDrag(const Thruster& t, const mjtNum axis_w[3], const mjtNum v[3], mjtNum inflow,
             mjtNum scale, RotorLoad* load) {
  for (int i = 0; i < 3; ++i) {
    const mjtNum along = inflow * axis_w[i], across = v[i] - along;
    load->drag_w[i] -= scale * std::abs(load->omega) * (t.drag[0] * across + t.drag[1] * along);
    load->moment_w[i] -= scale * load->omega * t.spin * t.rolling * across;
  }
}

// The rotor's angular momentum J s omega turns with the body.
void SetGyro(const Thruster& t, const mjtNum axis_w[3], const mjtNum spin_w[3], RotorLoad* load) {
  Cross3(load->gyro_w, axis_w, spin_w);
  Scale3(load->gyro_w, load->gyro_w, t.inertia * t.spin * load->omega);
}

Thruster* Stored(const mjData* d, int instance) {
  return reinterpret_cast<Thruster*>(d->plugin_data[instance]);
}

int Init(const mjModel* m, mjData* d, int instance) {
  d->plugin_data[instance] = 0;
  auto thruster = std::make_unique<Thruster>();
  if (!CheckReferences(m) || !ReadThruster(m, instance, thruster.get())) return -1;
  d->plugin_data[instance] = reinterpret_cast<uintptr_t>(thruster.release());
  return 0;
}

void Destroy(mjData* d, int instance) {
  delete Stored(d, instance);
  d->plugin_data[instance] = 0;
}

void ActivationRate(const mjModel* m, mjData* d, int instance) {
  const Thruster& t = *Stored(d, instance);
  if (!t.lagged) return;
  mjtNum* rate = d->act_dot + m->actuator_actadr[t.thrust];
  rate[0] = 0;
  rate[1] = IsOff(m, t.thrust) ? 0 : 1;
}

void ApplyActuators(const mjModel* m, mjData* d, const Thruster& t) {
  mjtNum none, *thrust = d->actuator_force + m->actuator_outadr[t.thrust];
  mjtNum* torque = t.torque >= 0 ? d->actuator_force + m->actuator_outadr[t.torque] : &none;
  *thrust = *torque = 0;
  if (IsOff(m, t.thrust)) return;
  if (!t.thrust_needs_flow() && t.ground_effect == 0) {  // command and lag say it all
    bool saturated = false;
    const RotorState& state = PresentState(m, d, t, ReadCommand(m, d, t.thrust, &saturated));
    *thrust = state.thrust;
    *torque = -t.spin * (state.torque + t.inertia * state.rate);
    return;
  }
  const RotorLoad load = EvaluateThruster(m, d, t, Loads::kActuators);
  *thrust = load.thrust;
  *torque = -t.spin * (load.torque + t.inertia * load.rate);
}

// What EvaluateThruster says of the passive load, to the bit, where the wind of the options is all
// that flows.
void ApplyPassiveInWind(const mjModel* m, mjData* d, const Thruster& t) {
  RotorLoad load;
  load.omega = PresentState(m, d, t, ReadCommand(m, d, t.thrust, &load.saturated)).omega;
  const mjtNum* site = d->site_xpos + 3 * t.site;
  mjtNum axis_w[3], v[3], spin_w[3];
  Rotate(axis_w, d->site_xmat + 9 * t.site, t.axis);
  PointVelocity(m, d, t.body, site, v, spin_w);
  if (t.inertia > 0) SetGyro(t, axis_w, spin_w, &load);
  SubtractFrom3(v, m->opt.wind);
  AddDrag(t, axis_w, v, Dot3(v, axis_w), 1, &load);
  AddPassiveForce(m, d, t.body, site, {load.drag_w, load.moment_w, load.gyro_w});
}

void ApplyPassive(const mjModel* m, mjData* d, const Thruster& t) {
  if (!t.passive() || IsOff(m, t.thrust) || IsAsleep(m, d, t.body)) return;
  if (!t.medium.in_charge() && t.works == Works::kConstant && t.has_drag()) {
    return ApplyPassiveInWind(m, d, t);
  }
  const mjtNum* site = d->site_xpos + 3 * t.site;
  const RotorLoad load = EvaluateThruster(m, d, t, Loads::kPassive);
  const PassiveWrench wrench{load.drag_w, load.moment_w, load.gyro_w};
  AddPassiveForce(m, d, t.body, site, wrench);
}

void Compute(const mjModel* given, mjData* d, int instance, int capability) {
  const mjModel* m = WholeModel(given);
  const Thruster* thruster = Stored(d, instance);
  if (!thruster) return;
  if (capability & mjPLUGIN_ACTUATOR) ApplyActuators(m, d, *thruster);
  if (capability & mjPLUGIN_PASSIVE) ApplyPassive(m, d, *thruster);
}

void Advance(const mjModel* m, mjData* d, int instance) {
  const Thruster& t = *Stored(d, instance);
  if (!t.lagged) return;
  bool saturated = false;
  const mjtNum target = CommandedSpeed(t, ReadCommand(m, d, t.thrust, &saturated), &saturated);
  mjtNum* act = d->act + m->actuator_actadr[t.thrust];
  act[0] = Follow(t.lag, act[0], target, act[1]).omega;
  act[1] = 0;
}

}  // namespace

RotorLoad EvaluateThruster(const mjModel* m, const mjData* d, const Thruster& t, Loads loads) {
  RotorLoad out;
  const bool drags = loads != Loads::kActuators, thrusts = loads != Loads::kPassive;
  const bool needs_flow = (thrusts && t.thrust_needs_flow()) || (drags && t.has_drag());
  const bool turns = drags && t.inertia > 0;
  const mjtNum command = ReadCommand(m, d, t.thrust, &out.saturated);
  const RotorState& state = PresentState(m, d, t, command);
  out.saturated |= state.saturated;
  out.target = state.target;
  out.omega = state.omega;
  out.rate = state.rate;
  const mjtNum at_rest = state.thrust, torque = state.torque;
  mjtNum axis_w[3], velocity[3], spin_w[3], ground = 1;
  const bool near_ground = thrusts && t.ground_effect != 0 && out.omega > 0;
  if (!needs_flow && !turns && !near_ground) {
    out.thrust = at_rest;
    out.torque = torque;
    return out;
  }
  Rotate(axis_w, d->site_xmat + 9 * t.site, t.axis);
  if (near_ground) ground = GroundFactor(t, d->site_xpos[3 * t.site + 2], axis_w[2]);
  if (needs_flow || turns) {
    PointVelocity(m, d, t.body, d->site_xpos + 3 * t.site, velocity, spin_w);
  }
  if (turns) SetGyro(t, axis_w, spin_w, &out);
  if (!needs_flow) {
    out.thrust = ground * at_rest;
    out.torque = torque;
    return out;
  }
  Flow flows[2];
  const int count = DiscFlows(m, d, t, axis_w, flows);
  for (int i = 0; i < count; ++i) {
    mjtNum v[3];
    Subtract3(v, velocity, flows[i].velocity);
    const mjtNum inflow = Dot3(v, axis_w), scale = flows[i].weight * FluidFactor(t, flows[i]);
    out.inflow += flows[i].weight * inflow;
    if (thrusts) {
      out.thrust += scale * (ground * at_rest + InflowThrust(t.curve, out.omega, inflow));
      out.torque += scale * (torque + InflowTorque(t.curve, out.omega, inflow));
    }
    if (thrusts && t.loss.law != InflowLaw::kNone) {
      const LoadChange change = InflowChange(t.loss, out.omega, at_rest, inflow);
      out.thrust += scale * change.thrust;
      if (torque != 0) out.torque += scale * change.torque;
    }
    if (drags) AddDrag(t, axis_w, v, inflow, scale, &out);
  }
  return out;
}

const Thruster* FindThruster(const mjModel* m, const mjData* d, int actuator) {
  const int instance = m->actuator_plugin[actuator];
  return instance >= 0 && IsThruster(m, instance) ? Stored(d, instance) : nullptr;
}

bool HasRotorDrag(const mjModel* m, const mjData* d, int body) {
  for (int i = 0; i < m->nplugin; ++i) {
    const Thruster* t = IsThruster(m, i) ? Stored(d, i) : nullptr;
    if (t && t->body == body && t->has_drag()) return true;
  }
  return false;
}

void AddRotorTerms(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                   Wrench terms[kTermCount]) {
  for (int i = 0; i < m->nplugin; ++i) {
    const Thruster* t = IsThruster(m, i) ? Stored(d, i) : nullptr;
    if (!t || t->body != body || !t->passive() || IsOff(m, t->thrust)) continue;
    const RotorLoad load = EvaluateThruster(m, d, *t);
    mjtNum arm[3];
    Subtract3(arm, d->site_xpos + 3 * t->site, point_w);
    AddTo3(terms[kDrag].force, load.drag_w);
    AddTo3(terms[kDrag].torque, load.moment_w);
    AddCross(terms[kDrag].torque, arm, load.drag_w);
  }
}

void RegisterThruster() {
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = kThrusterPlugin;
  plugin.attributes = kThrusterAttributes;
  plugin.nattribute = kThrusterAttributeCount;
  plugin.capabilityflags = mjPLUGIN_ACTUATOR | mjPLUGIN_PASSIVE;
  plugin.nstate = [](const mjModel*, int) { return 0; };
  plugin.init = Init;
  plugin.destroy = Destroy;
  plugin.reset = [](const mjModel*, mjtNum*, void*, int) {};
  plugin.compute = Compute;
  plugin.actuator_act_dot = ActivationRate;
  plugin.advance = Advance;
  mjp_registerPlugin(&plugin);
}

}  // namespace fluid_sim
