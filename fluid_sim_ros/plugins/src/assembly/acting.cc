// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "assembly/acting.h"

#include <algorithm>

#include "assembly/assembly.h"
#include "body/ellipsoid.h"
#include "body/stock_terms.h"
#include "thruster/thruster.h"

namespace fluid_sim {
namespace {

bool AnyNonZero(const mjtNum* numbers, int count) {
  return std::any_of(numbers, numbers + count, [](mjtNum x) { return x != 0; });
}

// Terms of one ellipsoid but the added mass; `fluid` is the densest and the most viscous one.
void AddEllipsoid(const EllipsoidShape& shape, const DragOptions& options,
                  const FluidConstants& fluid, bool acts[kTermCount]) {
  const EllipsoidCoefficients& c = shape.coefficients;
  const mjtNum* r = shape.semiaxes;
  const bool sphere = r[0] == r[1] && r[1] == r[2], dense = fluid.density > 0;
  const bool brakes = c.blunt != 0 || c.slender != 0 || c.angular != 0 || options.brown_lawler;
  acts[kDrag] |= dense && brakes;
  acts[kViscous] |= fluid.viscosity > 0;
  acts[kMagnus] |= dense && c.magnus != 0;
  acts[kKutta] |= dense && c.kutta != 0 && !sphere;
}

void AddStock(const mjModel* m, int body, bool acts[kTermCount]) {
  if (!StockActs(m, body)) return;
  const FluidConstants fluid{m->opt.density, m->opt.viscosity};
  if (!HasEllipsoidGeom(m, body)) {
    acts[kDrag] |= fluid.density > 0;
    acts[kViscous] |= fluid.viscosity > 0;
    return;
  }
  for (int i = 0; i < m->body_geomnum[body]; ++i) {
    const int geom = m->body_geomadr[body] + i;
    const mjtNum* numbers = m->geom_fluid + mjNFLUID * geom;  // scale, 5 coefficients, added mass
    if (numbers[0] == 0) continue;
    AddEllipsoid(GeomEllipsoid(m, geom), DragOptions{}, fluid, acts);
    acts[kAddedMass] |= fluid.density > 0 && AnyNonZero(numbers + 6, 6);
  }
}

void AddBody(const BodyFluid& body, const FluidConstants& fluid, bool acts[kTermCount]) {
  const bool dense = fluid.density > 0;
  acts[kAddedMass] |= body.added_mass && AnyNonZero(body.a, 36) && (dense || !body.per_density);
  acts[kBuoyancy] |= body.buoyant && dense;
  acts[kDamping] |= AnyNonZero(body.damping.linear, 36) || AnyNonZero(body.damping.quadratic, 36) ||
                    !body.damping.cross.empty();
  if (body.drag == Drag::kInertiaBox) {
    acts[kDrag] |= dense;
    acts[kViscous] |= fluid.viscosity > 0;
  }
  if (body.drag != Drag::kEllipsoid) return;
  acts[kDrag] |= dense && AnyNonZero(body.spin_damping, 3);
  for (const DragEllipsoid& part : body.ellipsoids) {
    AddEllipsoid(part.shape, body.options, fluid, acts);
  }
}

}  // namespace

void ActingTerms(const mjModel* m, const mjData* d, int body, bool acts[kTermCount]) {
  std::fill(acts, acts + kTermCount, false);
  AddStock(m, body, acts);
  acts[kDrag] |= HasRotorDrag(m, d, body);
  const Assembly* assembly = FindAssembly(m, d);
  if (!assembly) return;
  const FluidConstants fluid = StrongestFluid(assembly->medium, m);
  for (const BodyFluid& fluid_body : assembly->bodies) {
    if (fluid_body.id == body) AddBody(fluid_body, fluid, acts);
  }
  for (const Foil& foil : assembly->foils) {
    acts[kFoil] |= foil.body == body && fluid.density > 0;
  }
}

}  // namespace fluid_sim
