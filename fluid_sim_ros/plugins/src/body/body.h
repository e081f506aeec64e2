// fluid_sim.body: constants of one body, read once when the model is loaded.

#ifndef FLUID_SIM_BODY_BODY_H_
#define FLUID_SIM_BODY_BODY_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "body/damping.h"
#include "body/displacement.h"
#include "body/ellipsoid.h"
#include "medium/medium.h"
#include "shared/config.h"

namespace fluid_sim {

enum class Drag { kBuiltin, kEllipsoid, kNone };

// One geom of the body with fluidshape="ellipsoid".
struct DragEllipsoid {
  mjtNum position[3], rotation[9];  // in body axes
  EllipsoidShape shape;
  mjtNum scale;  // MuJoCo's interaction coefficient
};

// "Body axes" are those of the body frame (not of its inertia); points are from its origin.
struct BodyFluid {
  int id = -1;                  // MuJoCo body
  int free_dof = -1;            // first dof when the body alone makes up a free tree, or -1
  mjtNum point[3] = {0, 0, 0};  // reference point O of added mass and damping [m]

  bool added_mass = false;
  bool per_density = false;  // `a` is per unit density (auto) or absolute (numbers)
  mjtNum a[36] = {0};        // A about O for a body wholly in the lower fluid
  mjtNum builtin[36] = {0};  // of MuJoCo's own convective term, per unit density, about O
  bool has_builtin = false;

  Damping damping;

  Drag drag = Drag::kBuiltin;
  DragOptions options;
  mjtNum spin_damping[3] = {0, 0, 0};  // linear rotational damping per unit density [m^5/s]
  std::vector<DragEllipsoid> ellipsoids;

  bool buoyant = false;
  mjtNum volume = 0;                   // displaced when whole [m^3]
  mjtNum center_shift[3] = {0, 0, 0};  // stated centre of buoyancy minus the solids' [m]
  mjtNum solid_volume = 0;             // of the solids below [m^3]
  mjtNum solid_moment[3] = {0, 0, 0};  // their volume times centre [m^4]
  mjtNum solid_radius = 0;             // of a ball about their centre that holds them [m]
  std::vector<Solid> solids;           // used where a surface may cut the body
};

// Read and check the attributes of `instance` for `body`; false after one line of explanation.
bool ReadBody(const mjModel* m, int instance, int body, const Medium& medium, BodyFluid* out);

extern const char* const kBodyAttributes[];
extern const int kBodyAttributeCount;

}  // namespace fluid_sim

#endif  // FLUID_SIM_BODY_BODY_H_
