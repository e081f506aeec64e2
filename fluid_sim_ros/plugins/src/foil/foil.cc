// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "foil/foil.h"

#include <algorithm>
#include <cmath>

#include "shared/point_motion.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

struct Pose {
  const mjtNum* point_w;
  const mjtNum* rotation;  // foil axes to world
};

Pose FoilPose(const mjData* d, const Foil& foil) {
  if (foil.site >= 0) return {d->site_xpos + 3 * foil.site, d->site_xmat + 9 * foil.site};
  return {(foil.aircraft ? d->xipos : d->xpos) + 3 * foil.body, d->xmat + 9 * foil.body};
}

mjtNum Angle(const mjModel* m, const mjData* d, const Deflection& deflection) {
  if (deflection.joint >= 0) return deflection.gain * d->qpos[m->jnt_qposadr[deflection.joint]];
  const int actuator = deflection.actuator;
  if (actuator < 0) return 0;
  const int last = m->actuator_actadr[actuator] + m->actuator_actnum[actuator] - 1;
  if (m->actuator_actnum[actuator] > 0) return deflection.gain * d->act[last];
  const int address = m->actuator_ctrladr[actuator];
  mjtNum control = d->ctrl[address];
  if (!std::isfinite(control)) return 0;  // as MuJoCo does, with a warning
  if (m->actuator_ctrllimited[address] && !(m->opt.disableflags & mjDSBL_CLAMPCTRL)) {
    const mjtNum* range = m->actuator_ctrlrange + 2 * address;
    control = std::clamp(control, range[0], range[1]);
  }
  return deflection.gain * control;
}

// Share of a flat rectangle (half chord, half span) around a point that lies below the surface.
mjtNum WetShare(const Medium& medium, const mjData* d, const mjtNum* rotation,
                const mjtNum center_w[3], mjtNum half_chord, mjtNum half_span) {
  if (!medium.in_charge() || !medium.has_surface) return 1;
  const mjtNum reach =
      std::abs(half_chord * rotation[6]) + std::abs(half_span * rotation[7]) + mjMINVAL;
  return std::clamp<mjtNum>(0.5 + 0.5 * (SurfaceHeight(medium, d, center_w) - center_w[2]) / reach,
                            0, 1);
}

void AddWing(const mjModel* m, const mjData* d, const Medium& medium, const Foil& foil,
             const Pose& pose, Wrench* local) {
  const Wing& wing = foil.wing;
  const mjtNum width = wing.span / wing.panels, deflection = Angle(m, d, foil.deflection[0]);
  mjtNum velocity_w[3], omega_w[3], velocity[3], omega[3];
  PointVelocity(m, d, foil.body, pose.point_w, velocity_w, omega_w);
  RotateBack(velocity, pose.rotation, velocity_w);
  RotateBack(omega, pose.rotation, omega_w);
  for (int i = 0; i < wing.panels; ++i) {
    const mjtNum y = (i + 0.5) * width - 0.5 * wing.span;
    const mjtNum middle[3] = {0, y, 0}, sensed[3] = {-wing.velocity_point * wing.chord, y, 0};
    mjtNum center_w[3], speed[3];
    Rotate(center_w, pose.rotation, middle);
    mju_addTo3(center_w, pose.point_w);
    mju_copy3(speed, velocity);
    AddCross(speed, omega, sensed);
    const mjtNum wet = WetShare(medium, d, pose.rotation, center_w, 0.5 * wing.chord, 0.5 * width);
    Flow flows[2];
    const int count = FlowsAt(medium, m, d, foil.body, center_w, wet, flows);
    for (int k = 0; k < count; ++k) {
      mjtNum v[3], center;
      RotateBack(v, pose.rotation, flows[k].velocity);
      mju_sub3(v, speed, v);
      const Wrench panel = PanelLoad(wing, flows[k].weight * wing.area / wing.panels,
                                     flows[k].density, v, deflection, &center);
      const mjtNum arm[3] = {-center * wing.chord, y, 0};
      mju_addTo3(local->force, panel.force);
      mju_addTo3(local->torque, panel.torque);
      AddCross(local->torque, arm, panel.force);
    }
  }
}

void AddAircraft(const mjModel* m, const mjData* d, const Medium& medium, const Foil& foil,
                 const Pose& pose, Wrench* local) {
  const mjtNum deflection[3] = {Angle(m, d, foil.deflection[0]), Angle(m, d, foil.deflection[1]),
                                Angle(m, d, foil.deflection[2])};
  mjtNum velocity_w[3], omega_w[3];
  PointVelocity(m, d, foil.body, pose.point_w, velocity_w, omega_w);
  const mjtNum wet =
      WetShare(medium, d, pose.rotation, pose.point_w, 0.5 * foil.set.chord, 0.5 * foil.set.span);
  Flow flows[2];
  const int count = FlowsAt(medium, m, d, foil.body, pose.point_w, wet, flows);
  for (int k = 0; k < count; ++k) {
    mjtNum relative_w[3], v[3], omega[3];
    mju_sub3(relative_w, velocity_w, flows[k].velocity);
    RotateBack(v, pose.rotation, relative_w);
    mju_sub3(relative_w, omega_w, flows[k].spin);
    RotateBack(omega, pose.rotation, relative_w);
    const Wrench load = AircraftLoad(foil.set, flows[k].density, v, omega, deflection);
    mju_addToScl3(local->force, load.force, flows[k].weight);
    mju_addToScl3(local->torque, load.torque, flows[k].weight);
  }
}

}  // namespace

Wrench EvaluateFoil(const mjModel* m, const mjData* d, const Medium& medium, const Foil& foil,
                    const mjtNum point_w[3]) {
  const Pose pose = FoilPose(d, foil);
  Wrench local, out;
  (foil.aircraft ? AddAircraft : AddWing)(m, d, medium, foil, pose, &local);
  mjtNum arm[3];
  mju_sub3(arm, pose.point_w, point_w);
  Rotate(out.force, pose.rotation, local.force);
  Rotate(out.torque, pose.rotation, local.torque);
  AddCross(out.torque, arm, out.force);
  return out;
}

void ApplyFoil(const mjModel* m, mjData* d, const Medium& medium, const Foil& foil) {
  if (IsAsleep(m, d, foil.body)) return;
  const mjtNum* origin = d->xpos + 3 * foil.body;
  const Wrench load = EvaluateFoil(m, d, medium, foil, origin);
  AddGeneralizedForce(m, d, foil.body, origin, load.force, load.torque, d->qfrc_fluid);
  AddGeneralizedForce(m, d, foil.body, origin, load.force, load.torque, d->qfrc_passive);
}

}  // namespace fluid_sim
