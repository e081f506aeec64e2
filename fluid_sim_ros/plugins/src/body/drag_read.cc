// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Reads who brakes a body (units and defaults: doc/plugins.md).

#include <string>

#include "body/body_checks.h"
#include "body/body_read.h"
#include "body/stock_terms.h"

namespace fluid_sim {
namespace {

bool ReadSpinDamping(const Config& config, BodyFluid* out) {
  std::vector<mjtNum> spin;
  const char* allowed = "1 or 3 numbers >= 0 [m^5/s], times the density";
  if (!config.Numbers("rotational_damping", {1, 3}, allowed, &spin)) return false;
  for (size_t i = 0; i < 3 && !spin.empty(); ++i) {
    out->spin_damping[i] = spin[spin.size() == 1 ? 0 : i];
    if (out->spin_damping[i] < 0) return config.Refuse("rotational_damping", allowed);
  }
  return true;
}

// Who brakes a body that does not say so: MuJoCo where its own forces act; nobody where damping or
// a foil does it; else the plugin, by what MuJoCo would take with the medium's density in opt.
Drag DefaultDrag(const mjModel* m, const Medium& medium, bool has_foil, const BodyFluid& body) {
  const FluidConstants fluid = StrongestFluid(medium, m);
  const bool stock = m->opt.density > 0 || m->opt.viscosity > 0;
  if (stock || !medium.in_charge() || (fluid.density <= 0 && fluid.viscosity <= 0)) {
    return Drag::kBuiltin;
  }
  if (body.damping.any || has_foil || m->body_mass[body.id] < mjMINVAL) return Drag::kNone;
  return HasEllipsoidGeom(m, body.id) ? Drag::kEllipsoid : Drag::kInertiaBox;
}

void ReadEllipsoids(const mjModel* m, BodyFluid* out) {
  for (int geom : FluidGeoms(m, out->id)) {
    DragEllipsoid part;
    mju_copy3(part.position, m->geom_pos + 3 * geom);
    mju_quat2Mat(part.rotation, m->geom_quat + 4 * geom);
    part.shape = GeomEllipsoid(m, geom);
    part.scale = m->geom_fluid[mjNFLUID * geom];
    out->ellipsoids.push_back(part);
  }
}

}  // namespace

std::vector<int> FluidGeoms(const mjModel* m, int body) {
  std::vector<int> geoms;
  for (int i = 0; i < m->body_geomnum[body]; ++i) {
    const int geom = m->body_geomadr[body] + i;
    if (m->geom_fluid[mjNFLUID * geom] > 0) geoms.push_back(geom);
  }
  return geoms;
}

bool AsksForDrag(const mjModel* m, int body, const Medium& medium) {
  BodyFluid fluid;
  fluid.id = body;
  return CanMove(m, body) && DefaultDrag(m, medium, false, fluid) == Drag::kEllipsoid;
}

bool ReadDrag(const mjModel* m, const Config& config, const Medium& medium, bool has_foil,
              BodyFluid* out) {
  const int drag = config.Word("drag", {"builtin", "ellipsoid", "inertia_box", "none"});
  const int area = config.Word("drag_area", {"lemma", "true"});
  const int reynolds = config.Word("drag_reynolds", {"constant", "brown_lawler"});
  const int angular = config.Word("drag_angular", {"slender", "swept"});
  if (drag < 0 || area < 0 || reynolds < 0 || angular < 0 || !ReadSpinDamping(config, out))
    return false;
  const bool stated = config.Has("drag");
  out->drag = stated ? static_cast<Drag>(drag) : DefaultDrag(m, medium, has_foil, *out);
  out->implicit = stated || !MovesSimply(m, out->id);
  out->options = {area == 1, reynolds == 1, angular == 1};
  if (out->drag != Drag::kEllipsoid) {
    for (const char* key : {"drag_area", "drag_reynolds", "drag_angular", "rotational_damping"}) {
      if (config.Has(key)) return config.Fail(std::string(key) + " needs drag=\"ellipsoid\"");
    }
    return true;
  }
  ReadEllipsoids(m, out);
  if (!out->ellipsoids.empty()) return true;
  return config.Refuse("drag", "ellipsoid needs a geom with fluidshape=\"ellipsoid\"");
}

}  // namespace fluid_sim
