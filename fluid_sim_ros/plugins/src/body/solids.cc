// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Solids of MuJoCo's geoms (see displacement.h), built once when the model is loaded.

#include <algorithm>
#include <cmath>

#include "body/displacement.h"
#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

constexpr int kSides = 48;  // of the prism that stands for a round shape where the surface cuts it
constexpr int kRings = 12;  // per half sphere of a capsule

void PushTriangle(const mjtNum a[3], const mjtNum b[3], const mjtNum c[3], Solid* solid) {
  for (const mjtNum* corner : {a, b, c}) {
    solid->triangles.insert(solid->triangles.end(), corner, corner + 3);
  }
}

void AddBox(const mjtNum half[3], Solid* solid) {
  for (int axis = 0; axis < 3; ++axis) {
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    for (int sign = -1; sign <= 1; sign += 2) {
      mjtNum corner[4][3];
      const int turn[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
      for (int c = 0; c < 4; ++c) {
        corner[c][axis] = sign * half[axis];
        corner[c][j] = turn[c][0] * half[j] * sign;  // the sign turns the lower face around
        corner[c][k] = turn[c][1] * half[k];
      }
      PushTriangle(corner[0], corner[1], corner[2], solid);
      PushTriangle(corner[0], corner[2], corner[3], solid);
    }
  }
}

// Surface of revolution about z through (radius, height) pairs from bottom to top, both on the
// axis at the ends.
void AddRevolution(const std::vector<std::pair<mjtNum, mjtNum>>& outline, Solid* solid) {
  const auto point = [&](size_t ring, int side, mjtNum out[3]) {
    const mjtNum angle = 2 * kPi * side / kSides;
    out[0] = outline[ring].first * std::cos(angle);
    out[1] = outline[ring].first * std::sin(angle);
    out[2] = outline[ring].second;
  };
  for (size_t ring = 0; ring + 1 < outline.size(); ++ring) {
    for (int side = 0; side < kSides; ++side) {
      mjtNum a[3], b[3], c[3], d[3];
      point(ring, side, a);
      point(ring, side + 1, b);
      point(ring + 1, side + 1, c);
      point(ring + 1, side, d);
      if (outline[ring].first > 0) PushTriangle(a, b, c, solid);
      if (outline[ring + 1].first > 0) PushTriangle(a, c, d, solid);
    }
  }
}

void AddCylinder(mjtNum radius, mjtNum half, Solid* solid) {
  AddRevolution({{0, -half}, {radius, -half}, {radius, half}, {0, half}}, solid);
}

void AddCapsule(mjtNum radius, mjtNum half, Solid* solid) {
  std::vector<std::pair<mjtNum, mjtNum>> outline;
  for (int i = 0; i <= 2 * kRings + 1; ++i) {
    const int ring = i <= kRings ? i : i - 1;  // the equator twice: bottom and top of the tube
    const mjtNum angle = kPi / 2 * (static_cast<mjtNum>(ring) / kRings - 1);
    const bool end = i == 0 || i == 2 * kRings + 1;
    outline.push_back({end ? 0 : radius * std::cos(angle),
                       radius * std::sin(angle) + (i <= kRings ? -half : half)});
  }
  AddRevolution(outline, solid);
}

bool AddMesh(const mjModel* m, int mesh, Solid* solid, std::string* reason) {
  const float* vertices = m->mesh_vert + 3 * m->mesh_vertadr[mesh];
  mjtNum outward[3] = {0, 0, 0}, surface = 0;
  for (int face = 0; face < m->mesh_facenum[mesh]; ++face) {
    const int* index = m->mesh_face + 3 * (m->mesh_faceadr[mesh] + face);
    mjtNum corner[3][3], ab[3], ac[3], normal[3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) corner[i][k] = vertices[3 * index[i] + k];
    }
    mju_sub3(ab, corner[1], corner[0]);
    mju_sub3(ac, corner[2], corner[0]);
    mju_cross(normal, ab, ac);
    mju_addTo3(outward, normal);
    surface += mju_norm3(normal);
    PushTriangle(corner[0], corner[1], corner[2], solid);
  }
  if (mju_norm3(outward) > 1e-5 * surface) {  // vertices are single precision
    *reason = "is a mesh with an open surface";
    return false;
  }
  return true;
}

// Volume and centre of the triangles; stretches x and y so that a round shape keeps its volume.
void Finish(mjtNum exact_volume, Solid* solid) {
  WetPart whole;
  const auto measure = [&] {
    whole = WetPart();
    for (size_t i = 0; i < solid->triangles.size(); i += 9) {
      const mjtNum* t = solid->triangles.data() + i;
      mjtNum cross[3];
      mju_cross(cross, t + 3, t + 6);
      const mjtNum volume = mju_dot3(t, cross) / 6;
      whole.volume += volume;
      for (int k = 0; k < 3; ++k) whole.moment[k] += volume * 0.25 * (t[k] + t[3 + k] + t[6 + k]);
    }
  };
  measure();
  if (exact_volume > 0) {
    const mjtNum stretch = std::sqrt(exact_volume / whole.volume);
    for (size_t i = 0; i < solid->triangles.size(); ++i) {
      if (i % 3 != 2) solid->triangles[i] *= stretch;
    }
    measure();
  }
  solid->volume = whole.volume;
  if (whole.volume > 0) mju_scl3(solid->center, whole.moment, 1 / whole.volume);
}

void MoveToBody(Solid* solid) {
  mjtNum moved[3];
  for (size_t i = 0; i < solid->triangles.size(); i += 3) {
    mju_mulMatVec3(moved, solid->rotation, solid->triangles.data() + i);
    mju_add3(solid->triangles.data() + i, moved, solid->position);
  }
  mju_mulMatVec3(moved, solid->rotation, solid->center);
  mju_add3(solid->center, moved, solid->position);
  solid->radius = 0;
  for (size_t i = 0; i < solid->triangles.size(); i += 3) {
    solid->radius = std::max(solid->radius, mju_dist3(solid->triangles.data() + i, solid->center));
  }
}

void SetEllipsoid(const mjtNum semiaxes[3], Solid* solid) {
  mju_copy3(solid->semiaxes, semiaxes);
  mju_copy3(solid->center, solid->position);
  solid->volume = EllipsoidVolume(semiaxes);
  solid->radius = std::max({semiaxes[0], semiaxes[1], semiaxes[2]});
}

}  // namespace

bool GeomSolid(const mjModel* m, int geom, Solid* solid, std::string* reason) {
  const mjtNum* size = m->geom_size + 3 * geom;
  mju_copy3(solid->position, m->geom_pos + 3 * geom);
  mju_quat2Mat(solid->rotation, m->geom_quat + 4 * geom);
  const mjtNum radius = size[0], half = size[1];
  mjtNum exact = 0;
  switch (m->geom_type[geom]) {
    case mjGEOM_SPHERE: {
      const mjtNum ball[3] = {radius, radius, radius};
      SetEllipsoid(ball, solid);
      return true;
    }
    case mjGEOM_ELLIPSOID:
      SetEllipsoid(size, solid);
      return true;
    case mjGEOM_BOX:
      AddBox(size, solid);
      break;
    case mjGEOM_CYLINDER:
      AddCylinder(radius, half, solid);
      exact = 2 * kPi * radius * radius * half;
      break;
    case mjGEOM_CAPSULE:
      AddCapsule(radius, half, solid);
      exact = 2 * kPi * radius * radius * half + 4.0 / 3.0 * kPi * radius * radius * radius;
      break;
    case mjGEOM_MESH:
      if (!AddMesh(m, m->geom_dataid[geom], solid, reason)) return false;
      break;
    default:
      *reason = "is neither a sphere, ellipsoid, capsule, cylinder, box nor mesh";
      return false;
  }
  Finish(exact, solid);
  MoveToBody(solid);
  if (solid->volume > 0) return true;
  *reason = "has no volume";
  return false;
}

void GrowBox(const Solid& solid, mjtNum low[3], mjtNum high[3]) {
  const auto include = [&](int axis, mjtNum from, mjtNum to) {
    low[axis] = std::min(low[axis], from);
    high[axis] = std::max(high[axis], to);
  };
  for (size_t i = 0; i < solid.triangles.size(); ++i) {
    include(i % 3, solid.triangles[i], solid.triangles[i]);
  }
  for (int i = 0; i < 3 && solid.triangles.empty(); ++i) {
    mjtNum reach[3];  // of the ellipsoid along body axis i
    for (int k = 0; k < 3; ++k) reach[k] = solid.rotation[3 * i + k] * solid.semiaxes[k];
    const mjtNum half = mju_norm3(reach);
    include(i, solid.position[i] - half, solid.position[i] + half);
  }
}

Solid BallSolid(mjtNum volume, const mjtNum center[3]) {
  Solid solid;
  const mjtNum unit[4] = {1, 0, 0, 0}, radius = std::cbrt(volume / (4.0 / 3.0 * kPi));
  const mjtNum ball[3] = {radius, radius, radius};
  mju_copy3(solid.position, center);
  mju_quat2Mat(solid.rotation, unit);
  SetEllipsoid(ball, &solid);
  return solid;
}

}  // namespace fluid_sim
