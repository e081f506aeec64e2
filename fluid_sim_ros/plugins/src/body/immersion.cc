// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/immersion.h"

#include <algorithm>
#include <cmath>

#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// The surface as a plane, n.x = offset from the body's origin in body axes, n upward.
struct Plane {
  mjtNum normal[3], offset;
  mjtNum upright = 1;                // n in world z
  mjtNum rise = 0;                   // of the plane over `middle` [m/s]
  mjtNum rise_slope[3] = {0, 0, 0};  // of that along body axes [1/s]
  mjtNum middle[3] = {0, 0, 0};      // body axes
};

Plane LevelPlane(const mjData* d, const Medium& medium, const BodyFluid& body,
                 const Motion& motion) {
  Plane plane;
  mju_copy3(plane.normal, motion.rotation + 6);  // R' e_z
  plane.offset = medium.surface - d->xpos[3 * body.id + 2];
  return plane;
}

// Tangent to the waves over a point that moves with the body at v: its height there changes at
// eta_t, and its slope s at s_t + (grad s) v.
Plane TangentPlane(const mjData* d, const Waves& waves, const Motion& motion, const BodyFluid& body,
                   const mjtNum middle[3], const mjtNum middle_w[3]) {
  const WaveSurface surface = WaveSurfaceAt(waves, d->time, middle_w);
  const mjtNum* slope = surface.slope;
  Plane plane;
  plane.upright = 1 / std::sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
  const mjtNum normal_w[3] = {-plane.upright * slope[0], -plane.upright * slope[1], plane.upright};
  RotateBack(plane.normal, motion.rotation, normal_w);
  const mjtNum above = waves.level + surface.height - middle_w[2];
  plane.offset = mju_dot3(plane.normal, middle) + plane.upright * above;
  mjtNum arm[3], velocity[3], drift[3];
  mju_sub3(arm, middle, body.point);
  mju_copy3(velocity, motion.velocity);
  AddCross(velocity, motion.velocity + 3, arm);
  Rotate(drift, motion.rotation, velocity);
  const mjtNum* curve = surface.curvature;
  const mjtNum turn_w[3] = {surface.slope_rate[0] + curve[0] * drift[0] + curve[1] * drift[1],
                            surface.slope_rate[1] + curve[1] * drift[0] + curve[2] * drift[1], 0};
  RotateBack(plane.rise_slope, motion.rotation, turn_w);
  plane.rise = surface.rate;
  mju_copy3(plane.middle, middle);
  return plane;
}

// d(volume)/dt = (area cut) (rise of the surface - rise of the body, at the centre of the cut).
mjtNum VolumeRate(const Plane& plane, const WetPart& part, const BodyFluid& body,
                  const Motion& motion) {
  mjtNum arm[3], velocity[3], reach[3];
  mju_addScl3(arm, part.area_moment, body.point, -part.area);
  mju_scl3(velocity, motion.velocity, part.area);
  AddCross(velocity, motion.velocity + 3, arm);
  mju_addScl3(reach, part.area_moment, plane.middle, -part.area);
  const mjtNum rise = part.area * plane.rise + mju_dot3(plane.rise_slope, reach);
  return plane.upright * rise - mju_dot3(plane.normal, velocity);
}

// Of the box that holds the body; `reach` is how far the surface may lie from its plane.
Crossing CrossingOf(const Plane& plane, mjtNum reach, const BodyFluid& body, const Motion& motion) {
  Crossing out;
  mjtNum arm[3], velocity[3], offset[3];
  mju_sub3(arm, body.box_center, body.point);
  mju_copy3(velocity, motion.velocity);
  AddCross(velocity, motion.velocity + 3, arm);
  mju_sub3(offset, body.box_center, plane.middle);
  const mjtNum rise = plane.rise + mju_dot3(plane.rise_slope, offset);
  out.speed = plane.upright * rise - mju_dot3(plane.normal, velocity);
  for (int i = 0; i < 3; ++i) out.extent += 2 * body.box_half[i] * std::abs(plane.normal[i]);
  const mjtNum apart = std::abs(plane.offset - mju_dot3(plane.normal, body.box_center));
  out.gap = apart - reach - 0.5 * out.extent;
  return out;
}

}  // namespace

Immersion Immerse(const mjData* d, const Medium& medium, const BodyFluid& body,
                  const Motion& motion) {
  Immersion out;
  mju_copy3(out.moment, body.solid_moment);
  if (!medium.in_charge() || !medium.has_surface || body.solids.empty()) return out;
  Plane plane;
  if (medium.wavy()) {
    mjtNum middle[3], middle_w[3];
    mju_scl3(middle, body.solid_moment, 1 / body.solid_volume);
    Rotate(middle_w, motion.rotation, middle);
    mju_addTo3(middle_w, d->xpos + 3 * body.id);
    const mjtNum height = middle_w[2] - medium.surface;
    const mjtNum far = medium.waves.reach + medium.waves.tilt * body.solid_radius;
    if (std::abs(height) >= far) {
      plane = LevelPlane(d, medium, body, motion);
      out.crossing = CrossingOf(plane, medium.waves.reach, body, motion);
    }
    if (height <= -far) return out;
    if (height >= far) {
      mju_zero3(out.moment);
      out.wet = 0;
      return out;
    }
    plane = TangentPlane(d, medium.waves, motion, body, middle, middle_w);
  } else {
    plane = LevelPlane(d, medium, body, motion);
  }
  out.crossing = CrossingOf(plane, 0, body, motion);
  WetPart part;
  for (const Solid& solid : body.solids) AddWetPart(solid, plane.normal, plane.offset, &part);
  mju_copy3(out.moment, part.moment);
  out.wet = std::clamp<mjtNum>(part.volume / body.solid_volume, 0, 1);
  if (part.area > 0) out.rate = VolumeRate(plane, part, body, motion) / body.solid_volume;
  return out;
}

}  // namespace fluid_sim
