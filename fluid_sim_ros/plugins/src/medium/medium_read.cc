// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "medium/medium.h"
#include "shared/numbers.h"

namespace fluid_sim {
namespace {

// Nothing moves but one velocity everywhere, opt.wind.
bool MovesLikeOptions(const Medium& medium, const mjModel* m) {
  return medium.current.mean_only() && medium.current.profile.uniform() &&
         medium.wind.mean_only() && medium.wind.profile.uniform() && !medium.turbulence.kind &&
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

// Number of the vehicle (a tree of the world that can move) of each body, or -1; and how many.
int Vehicles(const mjModel* m, std::vector<int>* vehicle) {
  int count = 0;
  vehicle->assign(m->nbody, -1);
  for (int body = 1; body < m->nbody; ++body) {
    const int parent = m->body_parentid[body];
    if (parent > 0) {
      (*vehicle)[body] = (*vehicle)[parent];
    } else if (m->body_jntnum[body] > 0) {
      (*vehicle)[body] = count++;
    }
  }
  return count;
}

// Turbulence, rotational gusts, the seed, and where the state holds what.
bool ReadRandom(const Config& config, const mjModel* m, Medium* medium) {
  Turbulence* turbulence = &medium->turbulence;
  const int rotation = config.Word("rotational_gust", {"none", "curl"});
  if (rotation < 0 || !ReadTurbulence(config, m->opt.timestep, medium->wind.initial, turbulence) ||
      !config.Number("seed", 0, kMostSeed, "a whole number >= 0, up to 2^53", &medium->seed)) {
    return false;
  }
  if (medium->seed != std::floor(medium->seed)) {
    return config.Refuse("seed", "a whole number >= 0, up to 2^53");
  }
  medium->curl = rotation == 1;
  if (medium->curl && turbulence->span > 0) {
    return config.Fail(
        "rotational_gust = 'curl' and turbulence_span: either of them, as both "
        "are the rotation of the flow");
  }
  if (turbulence->follows && m->opt.timestep > turbulence->noise.tick) {
    return config.Fail("turbulence_follow needs a timestep of at most turbulence_tick");
  }
  Vehicles(m, &medium->vehicle);
  medium->origin.assign(m->nbody, -1);
  for (int body = 1; body < m->nbody; ++body) {
    if (m->body_rootid[body] == body && medium->vehicle[body] >= 0) {
      const char* name = mj_id2name(m, mjOBJ_BODY, body);
      medium->stream.push_back(NoiseStream(name, medium->vehicle[body]));
    }
    const int joint = m->body_jntadr[m->body_rootid[body]];
    if (joint >= 0 && m->jnt_type[joint] == mjJNT_FREE) {
      medium->origin[body] = m->jnt_qposadr[joint];
    }
  }
  medium->current_noise = kNoiseState;
  medium->wind_noise = medium->current_noise + StreamNoiseSize(config, "current");
  medium->turbulence_state = medium->wind_noise + StreamNoiseSize(config, "wind");
  medium->turbulence_size = TurbulenceStateSize(config);
  return true;
}

// A surface is level in world z: under any other gravity water would not lie there. Without gravity
// nothing tells how it lies, and it is taken as it is stated.
bool CheckGravity(const mjModel* m, const Config& config) {
  const mjtNum* g = m->opt.gravity;
  if (g[0] == 0 && g[1] == 0 && g[2] <= 0) return true;
  return config.Refuse("surface",
                       "none while gravity does not point along -z, for the surface is level in "
                       "world z; set opt gravity to 0 0 -g");
}

}  // namespace

// clang-format off
const char* const kMediumAttributes[] = {
    "surface", "density", "viscosity", "density_above", "viscosity_above", "current",
    "current_slew", "current_profile", "current_datum", "wind", "wind_slew", "wind_profile",
    "wind_datum", "waves", "wave_direction", "wave_spreading", "wave_components", "wave_repeat",
    "wave_cutoff", "wave_seed", "water_depth", "current_grid", "wind_grid", "current_signal",
    "current_series", "current_gauss_markov", "current_tick", "wind_signal", "wind_series",
    "wind_gauss_markov", "wind_tick", "turbulence", "turbulence_wind_6m", "turbulence_exceedance",
    "turbulence_sigma", "turbulence_height", "turbulence_length", "turbulence_airspeed",
    "turbulence_direction", "turbulence_span", "turbulence_ground", "turbulence_follow",
    "turbulence_tick", "rotational_gust", "seed"};
// clang-format on
const int kMediumAttributeCount = sizeof(kMediumAttributes) / sizeof(kMediumAttributes[0]);

bool ReadMedium(const mjModel* m, Medium* medium) {
  for (int i = 0; i < m->nplugin; ++i) {
    if (!IsPlugin(m, i, kMediumPlugin)) continue;
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
    if (medium->has_surface && !CheckGravity(m, config)) return false;
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
    if (!ReadStream(config, "current", m->opt.timestep, &medium->current) ||
        !ReadStream(config, "wind", m->opt.timestep, &medium->wind) ||
        !ReadGrid(config, m, "current_grid", &medium->current_grid) ||
        !ReadGrid(config, m, "wind_grid", &medium->wind_grid) ||
        !ReadWaves(config, m, medium->has_surface, medium->surface, &medium->waves)) {
      return false;
    }
    if (!ReadRandom(config, m, medium)) return false;
    if (medium->current.profile.from_ground() && !config.Has("current_datum")) {
      return config.Fail("current_profile counts from the bed; give current_datum [m]");
    }
    medium->plain = medium->current.mean_only() && medium->wind.mean_only() &&
                    !medium->current_grid.any() && !medium->wind_grid.any() &&
                    !medium->waves.any() && !medium->turbulence.kind;
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

int MediumStateSize(const mjModel* m, int instance) {
  const Config config(m, instance, "model");
  std::vector<int> vehicle;
  return kNoiseState + StreamNoiseSize(config, "current") + StreamNoiseSize(config, "wind") +
         Vehicles(m, &vehicle) * TurbulenceStateSize(config);
}

}  // namespace fluid_sim
