// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Volume that a body displaces below a plane: exact for ellipsoids and closed polyhedra.

#ifndef FLUID_SIM_BODY_DISPLACEMENT_H_
#define FLUID_SIM_BODY_DISPLACEMENT_H_

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

namespace fluid_sim {

// Part of a body below the plane n.x = d (submerged n.x <= d), everything in body axes.
struct WetPart {
  mjtNum volume = 0;                  // [m^3]
  mjtNum moment[3] = {0, 0, 0};       // volume times its centre [m^4]
  mjtNum area = 0;                    // cut by the plane [m^2]
  mjtNum area_moment[3] = {0, 0, 0};  // area times its centre [m^3]
};

// One geom as a solid: an ellipsoid, or a closed surface of triangles (outward, counterclockwise).
struct Solid {
  mjtNum position[3], rotation[9];  // of an ellipsoid, in body axes
  mjtNum semiaxes[3] = {0, 0, 0};   // of an ellipsoid [m]; unused for triangles
  std::vector<mjtNum> triangles;    // 9 numbers each, body axes [m]; empty for an ellipsoid
  mjtNum volume = 0;                // whole [m^3]
  mjtNum center[3] = {0, 0, 0};     // of the whole volume, body axes [m]
  mjtNum radius = 0;                // of a ball about `center` that holds the solid [m]
};

// Solid of a geom. Sphere, ellipsoid, box, mesh: exact. Capsule, cylinder: exact volume, a prism
// of kSides sides where the surface cuts them. False with a reason for other types.
bool GeomSolid(const mjModel* m, int geom, Solid* solid, std::string* reason);

// A ball that stands for a body without usable geoms.
Solid BallSolid(mjtNum volume, const mjtNum center[3]);

// Raise low and high [m], body axes, until the box between them holds the solid.
void GrowBox(const Solid& solid, mjtNum low[3], mjtNum high[3]);

// Add the part of the solid below the plane.
void AddWetPart(const Solid& solid, const mjtNum normal[3], mjtNum offset, WetPart* part);

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_DISPLACEMENT_H_
