// The fluid-force terms of a single body part, as pure functions of its local velocity.
//
// Twins of fluid_sim_ros/physics/ (inertia box and ellipsoid model). Everything is in the part's
// own frame: velocity relative to the medium in, force and torque about the part's centre out.

#ifndef FLUID_SIM_FLUID_TERMS_H_
#define FLUID_SIM_FLUID_TERMS_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// Order of the published terms; the Python tuple TERMS in plugins/native.py is the same.
enum Term {
  kDrag = 0,
  kViscous,
  kAddedMass,
  kMagnus,
  kKutta,
  kBuoyancy,
  kDamping,
  kFoil,
  kTermCount
};

struct Wrench {
  mjtNum force[3] = {0, 0, 0};   // [N]
  mjtNum torque[3] = {0, 0, 0};  // [N m]
};

struct MediumConstants {
  mjtNum density;    // [kg/m^3]
  mjtNum viscosity;  // dynamic [Pa s]
};

// Coefficients of the ellipsoid model in the order of MJCF's fluidcoef.
struct EllipsoidCoefficients {
  mjtNum blunt, slender, angular, kutta, magnus;
};

// Projected area of the seed's lemma [m^2] and the cosine between velocity and section normal.
struct Projection {
  mjtNum area;
  mjtNum cosine;
  mjtNum normal[3];
};

Projection ProjectEllipsoid(const mjtNum semiaxes[3], const mjtNum v[3]);

// Inertia-box model: full edge lengths of the equivalent box of body `body` [m].
void EquivalentInertiaBox(const mjModel* m, int body, mjtNum edges[3]);
Wrench InertiaBoxDrag(const mjtNum edges[3], const MediumConstants& medium, const mjtNum w[3],
                      const mjtNum v[3]);
Wrench InertiaBoxViscous(const mjtNum edges[3], const MediumConstants& medium, const mjtNum w[3],
                         const mjtNum v[3]);

// Ellipsoid model (w, v: angular and linear velocity in the ellipsoid's frame).
Wrench EllipsoidDrag(const mjtNum semiaxes[3], const EllipsoidCoefficients& c,
                     const MediumConstants& medium, const mjtNum w[3], const mjtNum v[3]);
Wrench EllipsoidViscous(const mjtNum semiaxes[3], const MediumConstants& medium, const mjtNum w[3],
                        const mjtNum v[3]);
Wrench EllipsoidMagnus(const mjtNum semiaxes[3], mjtNum coefficient, const MediumConstants& medium,
                       const mjtNum w[3], const mjtNum v[3]);
Wrench EllipsoidKutta(const mjtNum semiaxes[3], mjtNum coefficient, const MediumConstants& medium,
                      const mjtNum v[3]);

// Convective added-mass wrench for a diagonal added-mass matrix (Lamb 1932, ch. 5): does no work.
Wrench AddedMassConvective(const mjtNum mass[3], const mjtNum inertia[3], const mjtNum w[3],
                           const mjtNum v[3]);

// Semi-axes of the ellipsoid that stands for a geom, as MuJoCo's own fluid model takes them [m].
void GeomSemiaxes(const mjModel* m, int geom, mjtNum semiaxes[3]);

}  // namespace fluid_sim

#endif  // FLUID_SIM_FLUID_TERMS_H_
