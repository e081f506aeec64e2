// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/stock_terms.h"

#include "body/ellipsoid.h"
#include "body/inertia_box.h"

namespace fluid_sim {
namespace {

// Velocity of an object relative to the wind, in its own frame: angular w, linear v.
void RelativeVelocity(const mjModel* m, const mjData* d, int type, int id, const StockWind& wind,
                      const mjtNum* rotation, mjtNum w[3], mjtNum v[3]) {
  mjtNum spatial[6], wind_local[3], spin_local[3];
  mj_objectVelocity(m, d, type, id, spatial, 1);
  mju_mulMatTVec3(wind_local, rotation, wind.velocity);
  mju_mulMatTVec3(spin_local, rotation, wind.spin);
  mju_sub3(w, spatial, spin_local);
  mju_sub3(v, spatial + 3, wind_local);
}

void AddInertiaBox(const mjModel* m, const mjData* d, int body, const StockWind& wind,
                   const mjtNum point_w[3], Wrench terms[kTermCount]) {
  const mjtNum* rotation = d->ximat + 9 * body;
  const mjtNum* origin = d->xipos + 3 * body;
  const FluidConstants fluid{m->opt.density, m->opt.viscosity};
  mjtNum edges[3], w[3], v[3];
  EquivalentInertiaBox(m, body, edges);
  RelativeVelocity(m, d, mjOBJ_BODY, body, wind, rotation, w, v);
  const BoxResistance resistance = InertiaBoxResistance(edges, fluid, w, v);
  AddLocalWrench(resistance.Drag(w, v), rotation, origin, point_w, 1, terms + kDrag);
  AddLocalWrench(resistance.Viscous(w, v), rotation, origin, point_w, 1, terms + kViscous);
}

void AddEllipsoid(const mjModel* m, const mjData* d, int geom, const StockWind& wind,
                  const mjtNum point_w[3], Wrench terms[kTermCount]) {
  // geom_fluid: interaction scale, blunt, slender, angular, kutta, magnus, virtual mass, inertia
  const mjtNum* numbers = m->geom_fluid + mjNFLUID * geom;
  const mjtNum scale = numbers[0];
  if (scale == 0) return;
  const EllipsoidShape shape = GeomEllipsoid(m, geom);
  const FluidConstants fluid{m->opt.density, m->opt.viscosity};
  const mjtNum* rotation = d->geom_xmat + 9 * geom;
  const mjtNum* origin = d->geom_xpos + 3 * geom;
  mjtNum w[3], v[3], turning[3], mass[3], inertia[3];
  RelativeVelocity(m, d, mjOBJ_GEOM, geom, wind, rotation, w, v);
  mju_mulMatTVec3(turning, rotation, wind.spin);
  mju_addTo3(turning, w);  // the added mass is that of a flow that does not turn
  mju_scl3(mass, numbers + 6, fluid.density);
  mju_scl3(inertia, numbers + 9, fluid.density);
  const Resistance resistance = EllipsoidResistance(shape, DragOptions{}, fluid, w, v);
  const Wrench parts[] = {
      resistance.Drag(w, v),
      resistance.Viscous(w, v),
      AddedMassConvective(mass, inertia, turning, v),
      EllipsoidMagnus(shape, fluid, w, v),
      EllipsoidKutta(shape, fluid, v),
  };
  const Term order[] = {kDrag, kViscous, kAddedMass, kMagnus, kKutta};
  for (int i = 0; i < 5; ++i) {
    AddLocalWrench(parts[i], rotation, origin, point_w, scale, terms + order[i]);
  }
}

}  // namespace

bool StockActs(const mjModel* m, int body) {
  const int passive = mjDSBL_SPRING | mjDSBL_DAMPER;
  return (m->opt.density > 0 || m->opt.viscosity > 0) && m->body_mass[body] >= mjMINVAL &&
         (m->opt.disableflags & passive) != passive;
}

bool HasEllipsoidGeom(const mjModel* m, int body) {
  for (int i = 0; i < m->body_geomnum[body]; ++i) {
    if (m->geom_fluid[mjNFLUID * (m->body_geomadr[body] + i)] > 0) return true;
  }
  return false;
}

void AddLocalWrench(const Wrench& local, const mjtNum* rotation, const mjtNum origin_w[3],
                    const mjtNum point_w[3], mjtNum scale, Wrench* target_w) {
  mjtNum force[3], torque[3], arm[3], moment[3];
  mju_mulMatVec3(force, rotation, local.force);
  mju_mulMatVec3(torque, rotation, local.torque);
  mju_sub3(arm, origin_w, point_w);
  mju_cross(moment, arm, force);
  mju_addTo3(torque, moment);
  mju_addToScl3(target_w->force, force, scale);
  mju_addToScl3(target_w->torque, torque, scale);
}

void AddStockTerms(const mjModel* m, const mjData* d, int body, const StockWind& wind,
                   const mjtNum point_w[3], Wrench terms[kTermCount]) {
  if (!StockActs(m, body)) return;
  if (!HasEllipsoidGeom(m, body)) {
    AddInertiaBox(m, d, body, wind, point_w, terms);
    return;
  }
  for (int i = 0; i < m->body_geomnum[body]; ++i) {
    AddEllipsoid(m, d, m->body_geomadr[body] + i, wind, point_w, terms);
  }
}

}  // namespace fluid_sim
