// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/body_forces.h"

#include <algorithm>

#include "body/damping.h"
#include "body/ellipsoid.h"
#include "body/immersion.h"
#include "body/inertia_box.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// Multiplier of the body's A in a fluid.
mjtNum AddedMassScale(const BodyFluid& body, const Flow& flow, mjtNum lower_density) {
  if (body.per_density) return flow.density;
  if (lower_density > 0) return flow.density / lower_density;
  return flow.lower ? 1 : 0;
}

// out = A x
void MultiplyAddedMass(mjtNum out[6], const BodyFluid& body, const mjtNum x[6]) {
  if (!body.diagonal_a) return MultiplyMatrix6(out, body.a, x);
  for (int i = 0; i < 6; ++i) out[i] = body.a[7 * i] * x[i];
}

// target += scale A
void AddAddedMassMatrix(mjtNum target[36], const BodyFluid& body, mjtNum scale) {
  if (!body.diagonal_a) return AddScaled36(target, body.a, scale);
  for (int i = 0; i < 6; ++i) target[7 * i] += scale * body.a[7 * i];
}

// A [w x v - R'Jdot_p q' + R'Du/Dt ; -R'Jdot_r q'] + convection, for nu relative to the flow.
// The part A q'' of the acceleration goes into the inertia matrix.
void AddAddedMass(const mjModel* m, const BodyFluid& body, const Flow& flow, const Motion& motion,
                  const mjtNum nu[6], const mjtNum flow_accel_b[3], mjtNum lower_density,
                  BodyForces* out) {
  const mjtNum scale = flow.weight * AddedMassScale(body, flow, lower_density);
  mjtNum rate[6], push[6], momentum[6];
  Cross3(rate, nu + 3, nu);
  for (int i = 0; i < 3; ++i) {
    rate[i] += flow_accel_b[i] - motion.bias[i];
    rate[3 + i] = -motion.bias[3 + i];
  }
  MultiplyAddedMass(push, body, rate);
  MultiplyAddedMass(momentum, body, nu);
  for (int i = 0; i < 6; ++i) {
    out->term[kAddedMass][i] += push[i] * scale;
    momentum[i] *= scale;
  }
  AddAddedMassMatrix(out->inertia, body, scale);
  out->fluid_energy += 0.5 * mju_dot(momentum, nu, 6);
  if (body.has_builtin && (m->opt.density > 0 || m->opt.viscosity > 0)) {
    mjtNum stock[6];  // MuJoCo applies the convection of its own A already
    MultiplyMatrix6(stock, body.builtin, nu);
    mju_addToScl(momentum, stock, -m->opt.density, 6);
  }
  AddConvection(momentum, nu, out->term[kAddedMass]);
}

// Slamming, -(dA/dt)+ nu: the momentum that the growing added mass takes from the body. There is
// no such force when A shrinks, so the energy of body and fluid never rises (von Karman 1929).
void AddSlamming(const BodyFluid& body, const Flow& flow, const mjtNum nu[6], mjtNum rate,
                 bool secant, BodyForces* out) {
  mjtNum momentum[6];
  MultiplyAddedMass(momentum, body, nu);
  mju_addToScl(out->term[kAddedMass], momentum, -rate, 6);
  if (secant) AddAddedMassMatrix(out->secant, body, rate);
}

// Power that leaves with the surface: on entry slamming takes twice what the flow gains, on exit
// the flow that is left behind keeps its energy. nu'A nu/2 at the rate of A either way.
mjtNum SurfaceLoss(const BodyFluid& body, const mjtNum nu[6], mjtNum rate) {
  mjtNum momentum[6];
  MultiplyAddedMass(momentum, body, nu);
  return 0.5 * rate * mju_dot(momentum, nu, 6);
}

// rho V (Du/Dt - g) at the centre of the displaced volume: Archimedes and the pressure gradient
// of the accelerating flow.
void AddBuoyancy(const mjModel* m, const BodyFluid& body, const Flow& flow,
                 const Immersion& immersion, const Motion& motion, const mjtNum flow_accel_b[3],
                 BodyForces* out) {
  const mjtNum scale = body.volume / body.solid_volume;
  const mjtNum volume = flow.weight * body.volume;
  mjtNum moment[3], force[3] = {0, 0, 0}, gravity[3];
  Copy3(moment, immersion.moment);
  if (!flow.lower) Subtract3(moment, body.solid_moment, immersion.moment);
  Scale3(moment, moment, scale);
  AddScaled3(moment, body.center_shift, volume);
  AddScaled3(moment, body.point, -volume);  // volume times centre, from O
  if (!(m->opt.disableflags & mjDSBL_GRAVITY)) {
    RotateBack(gravity, motion.rotation, m->opt.gravity);
    Scale3(force, gravity, -flow.density);
  }
  AddScaled3(force, flow_accel_b, flow.density);
  AddScaled3(out->term[kBuoyancy], force, volume);
  AddCross(out->term[kBuoyancy] + 3, moment, force);
}

// Wrench at a part of the body, in the part's axes, to the body's about O; `arm` leads from O.
void AddAtPart(const mjtNum rotation[9], const mjtNum arm[3], const Wrench& local, mjtNum scale,
               mjtNum target[6]) {
  mjtNum force[3], torque[3];
  Rotate(force, rotation, local.force);
  Rotate(torque, rotation, local.torque);
  AddCross(torque, arm, force);
  AddScaled3(target, force, scale);
  AddScaled3(target + 3, torque, scale);
}

void AddEllipsoidForces(const BodyFluid& body, const DragEllipsoid& part, const Flow& flow,
                        const mjtNum nu[6], bool secant, BodyForces* out) {
  const FluidConstants fluid{flow.density, flow.viscosity};
  const mjtNum scale = part.scale * flow.weight;
  mjtNum arm[3], velocity[3], v[3], w[3];
  Subtract3(arm, part.position, body.point);
  Copy3(velocity, nu);
  AddCross(velocity, nu + 3, arm);
  RotateBack(v, part.rotation, velocity);
  RotateBack(w, part.rotation, nu + 3);
  const Resistance k = EllipsoidResistance(part.shape, body.options, fluid, w, v);
  const EllipsoidCoefficients& c = part.shape.coefficients;
  out->reynolds = std::max(out->reynolds, k.reynolds);
  AddAtPart(part.rotation, arm, k.Drag(w, v), scale, out->term[kDrag]);
  AddAtPart(part.rotation, arm, k.Viscous(w, v), scale, out->term[kViscous]);
  if (c.magnus != 0) {
    AddAtPart(part.rotation, arm, EllipsoidMagnus(part.shape, fluid, w, v), scale,
              out->term[kMagnus]);
  }
  if (c.kutta != 0) {
    AddAtPart(part.rotation, arm, EllipsoidKutta(part.shape, fluid, v), scale, out->term[kKutta]);
  }
  if (secant) {
    AddIsotropic6(out->secant, scale * (k.linear + k.viscous_linear),
                  scale * (k.angular + k.viscous_angular), arm);
  }
}

// At the centre of mass, in the axes of the inertia.
void AddInertiaBoxForces(const mjModel* m, const BodyFluid& body, const Flow& flow,
                         const mjtNum nu[6], bool secant, BodyForces* out) {
  const FluidConstants fluid{flow.density, flow.viscosity};
  mjtNum edges[3], rotation[9], arm[3], velocity[3], v[3], w[3];
  EquivalentInertiaBox(m, body.id, edges);
  mju_quat2Mat(rotation, m->body_iquat + 4 * body.id);
  Subtract3(arm, m->body_ipos + 3 * body.id, body.point);
  Copy3(velocity, nu);
  AddCross(velocity, nu + 3, arm);
  RotateBack(v, rotation, velocity);
  RotateBack(w, rotation, nu + 3);
  const BoxResistance k = InertiaBoxResistance(edges, fluid, w, v);
  AddAtPart(rotation, arm, k.Drag(w, v), flow.weight, out->term[kDrag]);
  AddAtPart(rotation, arm, k.Viscous(w, v), flow.weight, out->term[kViscous]);
  if (!secant) return;
  mjtNum diagonal[36] = {0}, turned[36], shifted[36];
  const mjtNum back[3] = {-arm[0], -arm[1], -arm[2]};
  for (int i = 0; i < 3; ++i) {
    diagonal[7 * i] = k.linear[i] + k.viscous_linear;
    diagonal[7 * (3 + i)] = k.angular[i] + k.viscous_angular;
  }
  RotateMatrix6(turned, diagonal, rotation);
  ShiftMatrix6(shifted, turned, back);
  AddScaled36(out->secant, shifted, flow.weight);
}

void AddSpinDamping(const BodyFluid& body, const Flow& flow, const mjtNum nu[6], bool secant,
                    BodyForces* out) {
  for (int i = 0; i < 3; ++i) {
    const mjtNum k = flow.weight * flow.density * body.spin_damping[i];
    out->term[kDrag][3 + i] -= k * nu[3 + i];
    if (secant) out->secant[7 * (3 + i)] += k;
  }
}

// Shares of the linear and quadratic coefficients, which hold for the lower fluid.
void AddVehicleDamping(const mjModel* m, const Medium& medium, const BodyFluid& body,
                       const Flow& flow, const mjtNum nu[6], bool secant, BodyForces* out) {
  const mjtNum density = LowerDensity(medium, m), viscosity = LowerViscosity(medium, m);
  const mjtNum all_or_none = flow.lower ? 1 : 0;
  const mjtNum quadratic = density > 0 ? flow.density / density : all_or_none;
  const mjtNum linear = viscosity > 0 ? flow.viscosity / viscosity : quadratic;
  AddDamping(body.damping, nu, flow.weight * linear, flow.weight * quadratic, out->term[kDamping],
             secant ? out->secant : nullptr);
}

}  // namespace

Motion BodyMotion(const mjModel* m, const mjData* d, const BodyFluid& body) {
  Motion out;
  out.rotation = d->xmat + 9 * body.id;
  mjtNum arm_w[3];
  Rotate(arm_w, out.rotation, body.point);
  Add3(out.point_w, d->xpos + 3 * body.id, arm_w);
  if (body.free_dof >= 0) {  // at rest in qacc, O only turns: w x (w x r)
    const mjtNum *qvel = d->qvel + body.free_dof, *w = qvel + 3;
    mjtNum swing[3];
    RotateBack(out.velocity, out.rotation, qvel);
    Copy3(out.velocity + 3, w);
    Cross3(swing, w, body.point);
    AddTo3(out.velocity, swing);
    mju_zero(out.bias, 6);
    AddCross(out.bias, w, swing);
    return out;
  }
  // spatial vectors are about the tree's centre of mass, in world axes, angular part first
  const mjtNum* com = d->subtree_com + 3 * m->body_rootid[body.id];
  const mjtNum* spatial = d->cvel + 6 * body.id;
  mjtNum accel[6] = {0, 0, 0, 0, 0, 0}, arm[3], v_w[3], a_w[3];
  int moving = body.id;
  while (m->body_dofnum[moving] == 0) moving = m->body_parentid[moving];
  const int last = m->body_dofadr[moving] + m->body_dofnum[moving] - 1;
  for (int dof = last; dof >= 0; dof = m->dof_parentid[dof]) {
    AddScaled3(accel, d->cdof_dot + 6 * dof, d->qvel[dof]);
    AddScaled3(accel + 3, d->cdof_dot + 6 * dof + 3, d->qvel[dof]);
  }
  Subtract3(arm, out.point_w, com);
  Copy3(v_w, spatial + 3);
  AddCross(v_w, spatial, arm);
  Copy3(a_w, accel + 3);
  AddCross(a_w, accel, arm);
  AddCross(a_w, spatial, v_w);  // from the spatial to the point's acceleration
  RotateBack(out.velocity, out.rotation, v_w);
  RotateBack(out.velocity + 3, out.rotation, spatial);
  RotateBack(out.bias, out.rotation, a_w);
  RotateBack(out.bias + 3, out.rotation, accel);
  return out;
}

void EvaluateBody(const mjModel* m, const mjData* d, const Medium& medium, const BodyFluid& body,
                  const Motion& motion, bool secant, BodyForces* out) {
  const Immersion immersion = Immerse(d, medium, body, motion);
  out->crossing = immersion.crossing;
  const mjtNum lower_density = LowerDensity(medium, m);
  Flow flows[2];
  mjtNum growth[2] = {0, 0};  // d(multiplier of A)/dt that each fluid brings
  const int count = FlowsAt(medium, m, d, body.id, motion.point_w, immersion.wet, flows);
  for (int i = 0; i < count; ++i) {
    const mjtNum scale = body.added_mass ? AddedMassScale(body, flows[i], lower_density) : 0;
    growth[i] = (flows[i].lower ? 1 : -1) * immersion.rate * scale;
  }
  const bool slamming = growth[0] + growth[1] > 0;
  for (int i = 0; i < count; ++i) {
    const Flow& flow = flows[i];
    mjtNum nu[6], flow_b[3], flow_accel_b[3], spin_b[3];
    std::copy(motion.velocity, motion.velocity + 6, nu);
    if (flow.at_rest) {
      mju_zero3(flow_accel_b);
    } else {
      RotateBack(flow_b, motion.rotation, flow.velocity);
      RotateBack(flow_accel_b, motion.rotation, flow.acceleration);
      SubtractFrom3(nu, flow_b);
    }
    if (body.added_mass) {
      AddAddedMass(m, body, flow, motion, nu, flow_accel_b, lower_density, out);
      if (slamming) AddSlamming(body, flow, nu, growth[i], secant, out);
      if (growth[i] != 0)
        out->surface_loss += SurfaceLoss(body, nu, slamming ? growth[i] : -growth[i]);
    }
    if (body.buoyant) AddBuoyancy(m, body, flow, immersion, motion, flow_accel_b, out);
    // a rotational gust is felt by drag and damping; the added mass is that of a uniform flow
    if (!flow.at_rest) {
      RotateBack(spin_b, motion.rotation, flow.spin);
      SubtractFrom3(nu + 3, spin_b);
    }
    if (body.damping.any) AddVehicleDamping(m, medium, body, flow, nu, secant, out);
    if (body.drag == Drag::kInertiaBox) AddInertiaBoxForces(m, body, flow, nu, secant, out);
    if (body.drag != Drag::kEllipsoid) continue;
    for (const DragEllipsoid& part : body.ellipsoids) {
      AddEllipsoidForces(body, part, flow, nu, secant, out);
    }
    AddSpinDamping(body, flow, nu, secant, out);
    if (body.history.on()) AddHistory(m, d, body, flow, motion, nu, secant, out);
  }
}

}  // namespace fluid_sim
