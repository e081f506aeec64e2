// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// fluid_sim.body: constants of one body, read once when the model is loaded.

#ifndef FLUID_SIM_BODY_BODY_H_
#define FLUID_SIM_BODY_BODY_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "body/damping.h"
#include "body/displacement.h"
#include "body/ellipsoid.h"
#include "body/history.h"
#include "medium/medium.h"
#include "shared/config.h"

namespace fluid_sim {

// Who brakes a body: MuJoCo itself, the plugin by the body's ellipsoid geoms or by its inertia box,
// or nobody. In the order of the words of `drag`.
enum class Drag { kBuiltin, kEllipsoid, kInertiaBox, kNone };

// One geom of the body with fluidshape="ellipsoid".
struct DragEllipsoid {
  mjtNum position[3], rotation[9];  // in body axes
  EllipsoidShape shape;
  mjtNum scale;  // MuJoCo's interaction coefficient
};

// Of a body's rigid inertia: the model's numbers and the matrix that they make.
struct RigidInertia {
  mjtNum mass = -1;  // none yet
  mjtNum diagonal[3], center[3], quat[4];
  mjtNum matrix[36];
};

// "Body axes" are those of the body frame (not of its inertia); points are from its origin.
struct BodyFluid {
  int id = -1;                  // MuJoCo body
  mutable RigidInertia rigid;   // kept from one evaluation to the next
  int free_dof = -1;            // first dof when the body alone makes up a free tree, or -1
  mjtNum point[3] = {0, 0, 0};  // reference point O of added mass and damping [m]

  bool added_mass = false;
  bool per_density = false;  // `a` is per unit density (auto) or absolute (numbers)
  mjtNum a[36] = {0};        // A about O for a body wholly in the lower fluid
  bool diagonal_a = false;
  mjtNum builtin[36] = {0};  // of MuJoCo's own convective term, per unit density, about O
  bool has_builtin = false;

  Damping damping;

  Drag drag = Drag::kBuiltin;
  // The drag may enter the inertia matrix (the secant of the first-order integrators). Not where
  // MuJoCo stores the diagonal only and the drag is there by default: it is explicit then, as
  // MuJoCo's own is.
  bool implicit = true;
  DragOptions options;
  mjtNum spin_damping[3] = {0, 0, 0};  // linear rotational damping per unit density [m^5/s]
  std::vector<DragEllipsoid> ellipsoids;
  History history;

  bool buoyant = false;
  mjtNum volume = 0;                   // displaced when whole [m^3]
  mjtNum center_shift[3] = {0, 0, 0};  // stated centre of buoyancy minus the solids' [m]
  mjtNum solid_volume = 0;             // of the solids below [m^3]
  mjtNum solid_moment[3] = {0, 0, 0};  // their volume times centre [m^4]
  mjtNum solid_radius = 0;             // of a ball about their centre that holds them [m]
  std::vector<Solid> solids;           // used where a surface may cut the body
  mjtNum box_center[3] = {0, 0, 0};    // of the box, along the body axes, that holds them [m]
  mjtNum box_half[3] = {0, 0, 0};      // half its edges [m]

  bool plugin_drag() const { return drag == Drag::kEllipsoid || drag == Drag::kInertiaBox; }
};

// Read and check the attributes of `instance` for `body`; false after one line of explanation.
// Instance -1 stands for one without any key. `has_foil`: a fluid_sim.foil acts on the body.
bool ReadBody(const mjModel* m, int instance, int body, const Medium& medium, bool has_foil,
              BodyFluid* out);

// The body's geoms ask for a drag (fluidshape="ellipsoid") that nothing but the medium can give: it
// is to have one, with or without a plugin of its own.
bool AsksForDrag(const mjModel* m, int body, const Medium& medium);

extern const char* const kBodyAttributes[];
extern const int kBodyAttributeCount;

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_BODY_H_
