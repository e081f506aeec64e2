#include "medium.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace fluid_sim {
namespace {

constexpr mjtNum kInfinity = std::numeric_limits<mjtNum>::infinity();

// Nothing moves but one velocity everywhere, opt.wind.
bool MovesLikeOptions(const Medium& medium, const mjModel* m) {
  return medium.current.profile.uniform() && medium.wind.profile.uniform() &&
         !medium.current_grid.any() && !medium.wind_grid.any() &&
         mju_dist3(medium.current.initial, m->opt.wind) == 0 && mju_norm3(medium.wind.initial) == 0;
}

// Stock MuJoCo acts on some body of the model (and would ignore the medium).
bool StockFluidActs(const mjModel* m) {
  if (m->opt.density <= 0 && m->opt.viscosity <= 0) return false;
  for (int body = 1; body < m->nbody; ++body) {
    if (m->body_mass[body] >= mjMINVAL) return true;
  }
  return false;
}

// The flow of the lower (only) or the upper fluid at a point and the data's time.
FlowSample SampleAt(const Medium& medium, const mjModel* m, const mjData* d, bool lower,
                    const mjtNum point_w[3]) {
  const mjtNum* state = d->plugin_state + m->plugin_stateadr[medium.instance];
  FlowSample flow;
  if (lower) {
    AddStream(medium.current, state + kCurrentState, d->time, point_w[2], &flow);
    AddGrid(medium.current_grid, m, d->time, point_w, &flow);
    AddWaves(medium.waves, d->time, point_w, &flow);
  }
  if (!lower || !medium.has_surface) {  // one fluid: what is called current and wind add up
    AddStream(medium.wind, state + kWindState, d->time, point_w[2], &flow);
    AddGrid(medium.wind_grid, m, d->time, point_w, &flow);
  }
  return flow;
}

Flow FluidAt(const Medium& medium, const mjModel* m, const mjData* d, bool lower, mjtNum weight,
             const mjtNum point_w[3]) {
  const int layer = lower ? 0 : 1;
  const FlowSample sample = SampleAt(medium, m, d, lower, point_w);
  Flow out;
  out.lower = lower;
  out.weight = weight;
  out.density = medium.density[layer];
  out.viscosity = medium.viscosity[layer];
  mju_copy3(out.velocity, sample.velocity);
  MaterialDerivative(sample, out.acceleration);
  mju_copy3(out.spin, sample.spin);
  return out;
}

}  // namespace

const char* const kMediumAttributes[] = {
    "surface",        "density",         "viscosity",       "density_above", "viscosity_above",
    "current",        "current_slew",    "current_profile", "current_datum", "wind",
    "wind_slew",      "wind_profile",    "wind_datum",      "waves",         "wave_direction",
    "wave_spreading", "wave_components", "wave_repeat",     "wave_cutoff",   "wave_seed",
    "water_depth",    "current_grid",    "wind_grid"};
const int kMediumAttributeCount = sizeof(kMediumAttributes) / sizeof(kMediumAttributes[0]);

bool ReadMedium(const mjModel* m, Medium* medium) {
  for (int i = 0; i < m->nplugin; ++i) {
    if (std::strcmp(PluginName(m, i), "fluid_sim.medium") != 0) continue;
    const Config config(m, i, "model");
    if (medium->instance >= 0) return config.Fail("two instances; allowed: one per model");
    medium->instance = i;
    medium->density[0] = m->opt.density;
    medium->viscosity[0] = m->opt.viscosity;
    mju_copy3(medium->current.initial, m->opt.wind);
    const char* density = "a number >= 0 [kg/m^3]";
    const char* viscosity = "a number >= 0, dynamic [Pa s]";
    medium->has_surface = config.Has("surface") && config.Text("surface") != "none";
    if (medium->has_surface &&
        !config.Number("surface", -kInfinity, kInfinity, "none or a height in world z [m]",
                       &medium->surface)) {
      return false;
    }
    if (!config.Number("density", 0, kInfinity, density, &medium->density[0]) ||
        !config.Number("viscosity", 0, kInfinity, viscosity, &medium->viscosity[0]) ||
        !config.Number("density_above", 0, kInfinity, density, &medium->density[1]) ||
        !config.Number("viscosity_above", 0, kInfinity, viscosity, &medium->viscosity[1])) {
      return false;
    }
    if (!medium->has_surface && (config.Has("density_above") || config.Has("viscosity_above"))) {
      return config.Fail("density_above or viscosity_above without surface; give surface [m]");
    }
    medium->wind.slew = 10;
    medium->current.datum = medium->wind.datum = medium->surface;
    if (!ReadStream(config, "current", &medium->current) ||
        !ReadStream(config, "wind", &medium->wind) ||
        !ReadGrid(config, m, "current_grid", &medium->current_grid) ||
        !ReadGrid(config, m, "wind_grid", &medium->wind_grid) ||
        !ReadWaves(config, m, medium->has_surface, medium->surface, &medium->waves)) {
      return false;
    }
    if (medium->current.profile.from_ground() && !config.Has("current_datum")) {
      return config.Fail("current_profile counts from the bed; give current_datum [m]");
    }
    if (StockFluidActs(m)) {
      if (medium->has_surface || medium->density[0] != m->opt.density ||
          medium->viscosity[0] != m->opt.viscosity) {
        return config.Fail(
            "differs from opt.density or opt.viscosity while MuJoCo's own fluid forces are on; "
            "set opt density=\"0\" viscosity=\"0\" and drag=\"ellipsoid\" on the bodies");
      }
      medium->equal = MovesLikeOptions(*medium, m);
      medium->corrects_stock = !medium->equal;
    }
  }
  return true;
}

mjtNum LowerDensity(const Medium& medium, const mjModel* m) {
  return medium.in_charge() ? medium.density[0] : m->opt.density;
}

mjtNum LowerViscosity(const Medium& medium, const mjModel* m) {
  return medium.in_charge() ? medium.viscosity[0] : m->opt.viscosity;
}

mjtNum SurfaceHeight(const Medium& medium, const mjData* d, const mjtNum point_w[3]) {
  if (!medium.waves.any()) return medium.surface;
  return WaveHeight(medium.waves, d->time, point_w);
}

int FlowsAt(const Medium& medium, const mjModel* m, const mjData* d, int body,
            const mjtNum point_w[3], mjtNum wet, Flow out[2]) {
  if (!medium.in_charge()) {
    out[0] = {true, 1, m->opt.density, m->opt.viscosity, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    mju_copy3(out[0].velocity, m->opt.wind);
    return 1;
  }
  if (!medium.has_surface) {
    out[0] = FluidAt(medium, m, d, true, 1, point_w);
    return 1;
  }
  // a cut body's point may lie in the other fluid: take the flow at the surface then
  int count = 0;
  mjtNum point[3];
  mju_copy3(point, point_w);
  if (wet > 0) {
    if (point_w[2] > medium.surface - medium.waves.reach) {
      point[2] = std::min(point_w[2], SurfaceHeight(medium, d, point_w));
    }
    out[count++] = FluidAt(medium, m, d, true, wet, point);
  }
  if (wet < 1) {
    point[2] = std::max(point_w[2], medium.surface);
    out[count++] = FluidAt(medium, m, d, false, 1 - wet, point);
  }
  return count;
}

void ResetMediumState(const Medium& medium, mjtNum* state) {
  ResetStream(medium.current, state + kCurrentState);
  ResetStream(medium.wind, state + kWindState);
}

}  // namespace fluid_sim
