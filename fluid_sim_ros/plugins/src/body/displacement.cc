// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/displacement.h"

#include <algorithm>
#include <cmath>

#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// pi r1 r2 r3 (2/3 + p - p^3/3): ellipsoid below the plane at the share p of its half height.
// Centre -3 (1-p^2)^2 / (4 (2 + 3p - p^3)) S n', section area pi r1 r2 r3 (1-p^2)/|S n| around
// p S n' (the map x = S y turns the unit ball's cap into the ellipsoid's).
void AddEllipsoid(const Solid& solid, const mjtNum normal[3], mjtNum offset, WetPart* part) {
  mjtNum local[3], stretched[3], axis[3];
  mju_mulMatTVec3(local, solid.rotation, normal);
  for (int i = 0; i < 3; ++i) stretched[i] = solid.semiaxes[i] * local[i];
  const mjtNum height = mju_norm3(stretched);
  const mjtNum p = std::clamp<mjtNum>((offset - mju_dot3(normal, solid.position)) / height, -1, 1);
  if (p <= -1) return;
  for (int i = 0; i < 3; ++i) axis[i] = solid.semiaxes[i] * stretched[i] / height;
  mjtNum axis_b[3];
  mju_mulMatVec3(axis_b, solid.rotation, axis);
  const mjtNum unit = kPi * solid.semiaxes[0] * solid.semiaxes[1] * solid.semiaxes[2];
  const mjtNum volume = unit * (2.0 / 3.0 + p - p * p * p / 3);
  // volume times centre without the quotient, which is 0/0 at p = -1
  const mjtNum moment = -0.25 * unit * (1 - p * p) * (1 - p * p);
  const mjtNum area = unit * (1 - p * p) / height;
  part->volume += volume;
  mju_addToScl3(part->moment, solid.position, volume);
  mju_addToScl3(part->moment, axis_b, moment);
  part->area += area;
  mju_addToScl3(part->area_moment, solid.position, area);
  mju_addToScl3(part->area_moment, axis_b, area * p);
}

// Signed tetrahedron (apex, a, b, c).
void AddTetrahedron(const mjtNum apex[3], const mjtNum a[3], const mjtNum b[3], const mjtNum c[3],
                    WetPart* part) {
  mjtNum ea[3], eb[3], ec[3], cross[3];
  mju_sub3(ea, a, apex);
  mju_sub3(eb, b, apex);
  mju_sub3(ec, c, apex);
  mju_cross(cross, eb, ec);
  const mjtNum volume = mju_dot3(ea, cross) / 6;
  part->volume += volume;
  for (int i = 0; i < 3; ++i) {
    part->moment[i] += volume * 0.25 * (apex[i] + a[i] + b[i] + c[i]);
  }
}

// Part of the section plane between the apex (on the plane) and a cut edge.
void AddSection(const mjtNum apex[3], const mjtNum normal[3], const mjtNum from[3],
                const mjtNum to[3], WetPart* part) {
  mjtNum a[3], b[3], cross[3];
  mju_sub3(a, from, apex);
  mju_sub3(b, to, apex);
  mju_cross(cross, a, b);
  const mjtNum area = 0.5 * mju_dot3(cross, normal);
  part->area += area;
  for (int i = 0; i < 3; ++i) part->area_moment[i] += area * (apex[i] + from[i] + to[i]) / 3;
}

// The triangle's part below the plane, as a fan, and the edge that the plane cuts.
void AddClippedTriangle(const mjtNum* triangle, const mjtNum apex[3], const mjtNum normal[3],
                        mjtNum offset, WetPart* part) {
  mjtNum height[3], polygon[4][3], leave[3], enter[3];
  for (int i = 0; i < 3; ++i) height[i] = mju_dot3(normal, triangle + 3 * i) - offset;
  if (height[0] > 0 && height[1] > 0 && height[2] > 0) return;
  int count = 0;
  bool cut = false;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const mjtNum *a = triangle + 3 * i, *b = triangle + 3 * j;
    if (height[i] <= 0) mju_copy3(polygon[count++], a);
    if ((height[i] <= 0) == (height[j] <= 0)) continue;
    const mjtNum share = height[i] / (height[i] - height[j]);
    mjtNum* point = polygon[count++];
    for (int k = 0; k < 3; ++k) point[k] = a[k] + share * (b[k] - a[k]);
    mju_copy3(height[i] <= 0 ? leave : enter, point);
    cut = true;
  }
  for (int i = 1; i + 1 < count; ++i) {
    AddTetrahedron(apex, polygon[0], polygon[i], polygon[i + 1], part);
  }
  // the lid runs against the clipped triangle's own edge
  if (cut) AddSection(apex, normal, enter, leave, part);
}

// The apex of all tetrahedra lies on the plane, so the lid that closes the cut adds nothing.
void AddPolyhedron(const Solid& solid, const mjtNum normal[3], mjtNum offset, WetPart* part) {
  mjtNum apex[3];
  mju_copy3(apex, solid.center);
  mju_addToScl3(apex, normal, offset - mju_dot3(normal, solid.center));
  for (size_t i = 0; i < solid.triangles.size(); i += 9) {
    AddClippedTriangle(solid.triangles.data() + i, apex, normal, offset, part);
  }
}

}  // namespace

void AddWetPart(const Solid& solid, const mjtNum normal[3], mjtNum offset, WetPart* part) {
  const mjtNum depth = offset - mju_dot3(normal, solid.center);
  if (depth <= -solid.radius) return;
  if (depth >= solid.radius) {
    part->volume += solid.volume;
    mju_addToScl3(part->moment, solid.center, solid.volume);
  } else if (solid.triangles.empty()) {
    AddEllipsoid(solid, normal, offset, part);
  } else {
    AddPolyhedron(solid, normal, offset, part);
  }
}

}  // namespace fluid_sim
