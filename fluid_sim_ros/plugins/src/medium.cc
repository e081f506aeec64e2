#include "medium.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace fluid_sim {
namespace {

constexpr mjtNum kInfinity = std::numeric_limits<mjtNum>::infinity();

// Keys NAME, NAME_slew, NAME_profile, NAME_datum.
bool ReadStream(const Config& config, const std::string& name, Stream* stream) {
  const std::string slew = name + "_slew", profile = name + "_profile", datum = name + "_datum";
  std::vector<mjtNum> numbers;
  if (!config.Numbers(name.c_str(), {3}, "3 numbers [m/s]", &numbers)) return false;
  if (!numbers.empty()) mju_copy3(stream->initial, numbers.data());
  return config.Number(slew.c_str(), 0, kInfinity, "a number >= 0 [m/s^2] (0: no limit)",
                       &stream->slew) &&
         config.Number(datum.c_str(), -kInfinity, kInfinity, "a height in world z [m]",
                       &stream->datum) &&
         stream->profile.Parse(config, profile.c_str());
}

bool EqualsOptions(const Medium& medium, const mjModel* m) {
  return !medium.has_surface && medium.density[0] == m->opt.density &&
         medium.viscosity[0] == m->opt.viscosity && medium.current.profile.uniform() &&
         medium.wind.profile.uniform() && mju_dist3(medium.current.initial, m->opt.wind) == 0 &&
         mju_norm3(medium.wind.initial) == 0;
}

// Stock MuJoCo acts on some body of the model (and would ignore the medium).
bool StockFluidActs(const mjModel* m) {
  if (m->opt.density <= 0 && m->opt.viscosity <= 0) return false;
  for (int body = 1; body < m->nbody; ++body) {
    if (m->body_mass[body] >= mjMINVAL) return true;
  }
  return false;
}

// Velocity and material acceleration f U' + u_z f' U of u = U(t) f(z - datum).
void AddStream(const Stream& stream, const mjtNum* state, mjtNum time, mjtNum z, Flow* flow) {
  mjtNum velocity[3], derivative[3];
  StreamVelocity(stream, state, time, velocity, derivative);
  const ProfileValue profile = stream.profile.At(z - stream.datum);
  const mjtNum vertical = velocity[2] * profile.factor;  // u_z
  for (int i = 0; i < 3; ++i) {
    flow->velocity[i] += velocity[i] * profile.factor;
    flow->acceleration[i] +=
        derivative[i] * profile.factor + vertical * profile.slope * velocity[i];
  }
}

Flow StillFluid(bool lower, mjtNum weight, mjtNum density, mjtNum viscosity) {
  return {lower, weight, density, viscosity, {0, 0, 0}, {0, 0, 0}};
}

}  // namespace

const char* const kMediumAttributes[] = {
    "surface",   "density",      "viscosity",       "density_above", "viscosity_above",
    "current",   "current_slew", "current_profile", "current_datum", "wind",
    "wind_slew", "wind_profile", "wind_datum"};
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
        !ReadStream(config, "wind", &medium->wind)) {
      return false;
    }
    if (medium->current.profile.from_ground() && !config.Has("current_datum")) {
      return config.Fail("current_profile counts from the bed; give current_datum [m]");
    }
    if (StockFluidActs(m)) {
      medium->equal = EqualsOptions(*medium, m);
      if (!medium->equal) {
        return config.Fail(
            "differs from opt.density, opt.viscosity or opt.wind while MuJoCo's own fluid forces "
            "are on; set opt density=\"0\" viscosity=\"0\" and drag=\"ellipsoid\" on the bodies");
      }
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

int FlowsAt(const Medium& medium, const mjModel* m, const mjData* d, const mjtNum point_w[3],
            mjtNum wet, Flow out[2]) {
  if (!medium.in_charge()) {
    out[0] = StillFluid(true, 1, m->opt.density, m->opt.viscosity);
    mju_copy3(out[0].velocity, m->opt.wind);
    return 1;
  }
  const mjtNum* current = d->plugin_state + m->plugin_stateadr[medium.instance];
  const mjtNum* wind = current + kDriveState;
  if (!medium.has_surface) {  // one fluid: what is called current and wind add up
    out[0] = StillFluid(true, 1, medium.density[0], medium.viscosity[0]);
    AddStream(medium.current, current, d->time, point_w[2], out);
    AddStream(medium.wind, wind, d->time, point_w[2], out);
    return 1;
  }
  // a cut body's point may lie in the other fluid: take the flow at the surface then
  int count = 0;
  if (wet > 0) {
    out[count] = StillFluid(true, wet, medium.density[0], medium.viscosity[0]);
    AddStream(medium.current, current, d->time, std::min(point_w[2], medium.surface),
              out + count++);
  }
  if (wet < 1) {
    out[count] = StillFluid(false, 1 - wet, medium.density[1], medium.viscosity[1]);
    AddStream(medium.wind, wind, d->time, std::max(point_w[2], medium.surface), out + count++);
  }
  return count;
}

void StreamVelocity(const Stream& stream, const mjtNum* state, mjtNum time, mjtNum velocity[3],
                    mjtNum derivative[3]) {
  mjtNum way[3];
  mju_sub3(way, state + kTarget, state + kStart);
  const mjtNum distance = mju_norm3(way);
  const mjtNum elapsed = std::max<mjtNum>(time - state[kStartTime], 0);
  mju_zero3(derivative);
  if (distance <= 0 || stream.slew <= 0 || elapsed * stream.slew >= distance) {
    mju_copy3(velocity, state + kTarget);
    return;
  }
  mju_scl3(derivative, way, stream.slew / distance);
  mju_copy3(velocity, state + kStart);
  mju_addToScl3(velocity, derivative, elapsed);
}

void SetTarget(const Stream& stream, mjtNum* state, mjtNum time, const mjtNum target[3]) {
  if (mju_dist3(state + kTarget, target) == 0) return;  // set again: keep going the same way
  mjtNum velocity[3], derivative[3];
  StreamVelocity(stream, state, time, velocity, derivative);
  mju_copy3(state + kStart, velocity);
  mju_copy3(state + kTarget, target);
  state[kStartTime] = time;
}

void ResetMediumState(const Medium& medium, mjtNum* state) {
  mju_zero(state, kMediumState);
  const Stream* streams[] = {&medium.current, &medium.wind};
  for (int i = 0; i < 2; ++i) {
    mju_copy3(state + i * kDriveState + kTarget, streams[i]->initial);
    mju_copy3(state + i * kDriveState + kStart, streams[i]->initial);
  }
}

}  // namespace fluid_sim
