// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Reads the displaced volume of a body (units and defaults: doc/plugins.md).

#include <algorithm>
#include <string>

#include "body/body_read.h"
#include "shared/numbers.h"

namespace fluid_sim {
namespace {

// Geoms that displace fluid: those named, else those with fluidshape, else those that collide.
bool DisplacingGeoms(const mjModel* m, const Config& config, int body, std::vector<int>* geoms) {
  for (const std::string& name : Split(config.Text("geoms"))) {
    const int geom = mj_name2id(m, mjOBJ_GEOM, name.c_str());
    if (geom < 0 || m->geom_bodyid[geom] != body) {
      return config.Refuse("geoms", "names of geoms of this body ('" + name + "' is none)");
    }
    geoms->push_back(geom);
  }
  if (geoms->empty()) *geoms = FluidGeoms(m, body);
  for (int i = 0; i < m->body_geomnum[body] && !config.Has("geoms"); ++i) {
    const int geom = m->body_geomadr[body] + i;
    const bool collides = m->geom_contype[geom] || m->geom_conaffinity[geom];
    if (collides && FluidGeoms(m, body).empty()) geoms->push_back(geom);
  }
  return true;
}

bool ReadSolids(const mjModel* m, const Config& config, BodyFluid* out) {
  std::vector<int> geoms;
  if (!DisplacingGeoms(m, config, out->id, &geoms)) return false;
  const bool needed = config.Has("geoms") || config.Text("volume") == "auto";
  for (int geom : geoms) {
    Solid solid;
    std::string reason;
    if (GeomSolid(m, geom, &solid, &reason)) {
      out->solids.push_back(solid);
    } else if (needed) {
      const char* name = mj_id2name(m, mjOBJ_GEOM, geom);
      return config.Fail("geom '" + std::string(name ? name : "") + "' " + reason +
                         "; name others by geoms, or give volume [m^3]");
    }
  }
  return true;
}

void SetBox(BodyFluid* out) {
  if (out->solids.empty()) return;
  mjtNum low[3] = {kInfinity, kInfinity, kInfinity}, high[3] = {-kInfinity, -kInfinity, -kInfinity};
  for (const Solid& solid : out->solids) GrowBox(solid, low, high);
  for (int i = 0; i < 3; ++i) {
    out->box_center[i] = 0.5 * (low[i] + high[i]);
    out->box_half[i] = 0.5 * (high[i] - low[i]);
  }
}

}  // namespace

bool ReadBuoyancy(const mjModel* m, const Config& config, BodyFluid* out) {
  std::vector<mjtNum> center;
  if (!config.Numbers("center_of_buoyancy", {3}, "3 numbers [m], body axes", &center) ||
      !ReadSolids(m, config, out)) {
    return false;
  }
  out->buoyant = config.Has("volume");
  const bool automatic = config.Text("volume") == "auto";
  if (!out->buoyant && !center.empty()) return config.Fail("center_of_buoyancy needs volume");
  if (automatic && out->solids.empty()) {
    return config.Refuse("volume",
                         "auto needs a sphere, ellipsoid, capsule, cylinder, box or "
                         "mesh geom on this body; or a number > 0 [m^3]");
  }
  if (out->buoyant && !automatic &&
      !config.Number("volume", kTiny, kInfinity, "auto or a number > 0 [m^3]", &out->volume)) {
    return false;
  }
  if (out->solids.empty() && out->buoyant) {
    const mjtNum* at = center.empty() ? m->body_ipos + 3 * out->id : center.data();
    out->solids.push_back(BallSolid(out->volume, at));
  }
  for (const Solid& solid : out->solids) {
    out->solid_volume += solid.volume;
    mju_addToScl3(out->solid_moment, solid.center, solid.volume);
  }
  for (const Solid& solid : out->solids) {
    mjtNum middle[3];
    mju_scl3(middle, out->solid_moment, 1 / out->solid_volume);
    out->solid_radius = std::max(out->solid_radius, mju_dist3(solid.center, middle) + solid.radius);
  }
  SetBox(out);
  if (automatic) out->volume = out->solid_volume;
  if (center.empty()) return true;
  mju_addScl3(out->center_shift, center.data(), out->solid_moment, -1 / out->solid_volume);
  return true;
}

}  // namespace fluid_sim
