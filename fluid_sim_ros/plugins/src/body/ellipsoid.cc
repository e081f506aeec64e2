// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/ellipsoid.h"

#include <algorithm>
#include <cmath>

#include "shared/numbers.h"

namespace fluid_sim {
namespace {

// Diameter of the sphere that the Stokes drag and the Reynolds number take [m].
mjtNum MeanDiameter(const mjtNum r[3]) { return 2.0 / 3.0 * (r[0] + r[1] + r[2]); }

// Re that the blunt coefficient goes by; 0 where it is constant, infinite without viscosity.
mjtNum ReynoldsNumber(const EllipsoidShape& shape, const DragOptions& options,
                      const FluidConstants& fluid, mjtNum speed) {
  if (!options.brown_lawler) return 0;
  if (fluid.viscosity <= 0) return fluid.density * speed > 0 ? kInfinity : 0;
  return fluid.density * speed * MeanDiameter(shape.semiaxes) / fluid.viscosity;
}

Wrench Against(mjtNum linear, mjtNum angular, const mjtNum w[3], const mjtNum v[3]) {
  Wrench out;
  mju_scl3(out.force, v, -linear);
  mju_scl3(out.torque, w, -angular);
  return out;
}

}  // namespace

Wrench Resistance::Drag(const mjtNum w[3], const mjtNum v[3]) const {
  return Against(linear, angular, w, v);
}

Wrench Resistance::Viscous(const mjtNum w[3], const mjtNum v[3]) const {
  return Against(viscous_linear, viscous_angular, w, v);
}

Projection ProjectEllipsoid(const mjtNum r[3], const mjtNum v[3]) {
  Projection out;
  mjtNum fourth_order = 0, second_order = 0;
  for (int i = 0; i < 3; ++i) {
    const mjtNum section = Square(r[(i + 1) % 3] * r[(i + 2) % 3]);
    fourth_order += Square(section * v[i]);
    second_order += section * Square(v[i]);
    out.normal[i] = section * v[i];
  }
  if (fourth_order <= 0) {  // at rest: every force that uses the projection is zero
    return {0, 0, {0, 0, 0}};
  }
  out.area = kPi * std::sqrt(fourth_order / second_order);
  out.cosine = second_order / (std::sqrt(fourth_order) * mju_norm3(v));
  mju_scl3(out.normal, out.normal, 1 / std::sqrt(fourth_order));
  return out;
}

mjtNum TrueProjectedArea(const mjtNum r[3], const mjtNum v[3]) {
  const mjtNum speed = mju_norm3(v);
  if (speed <= 0) return 0;
  const mjtNum x = r[1] * r[2] * v[0], y = r[2] * r[0] * v[1], z = r[0] * r[1] * v[2];
  return kPi * std::sqrt(x * x + y * y + z * z) / speed;
}

mjtNum BrownLawlerBlunt(mjtNum reynolds) {
  if (reynolds <= 0) return 0;  // times |v|, the limit is zero
  if (std::isinf(reynolds)) return 0.5 * 0.407;
  return 0.5 * (3.6 * std::pow(reynolds, -0.319) + 0.407 * reynolds / (reynolds + 8710));
}

Resistance EllipsoidResistance(const EllipsoidShape& shape, const DragOptions& options,
                               const FluidConstants& fluid, const mjtNum w[3], const mjtNum v[3]) {
  const mjtNum* r = shape.semiaxes;
  const EllipsoidCoefficients& c = shape.coefficients;
  const mjtNum longest = std::max({r[0], r[1], r[2]}), shortest = std::min({r[0], r[1], r[2]});
  const mjtNum middle = r[0] + r[1] + r[2] - longest - shortest;
  const mjtNum speed = mju_norm3(v);
  const mjtNum area = options.true_area ? TrueProjectedArea(r, v) : ProjectEllipsoid(r, v).area;
  const mjtNum area_max = kPi * longest * middle;
  const mjtNum reynolds = ReynoldsNumber(shape, options, fluid, speed);
  const mjtNum blunt = options.brown_lawler ? BrownLawlerBlunt(reynolds) : c.blunt;

  const mjtNum unit = 8.0 / 15.0 * kPi, inertia_max = unit * middle * Fourth(longest);
  const mjtNum slender = options.swept_only ? 0 : c.slender;
  mjtNum moment[3];
  for (int i = 0; i < 3; ++i) {
    const mjtNum swept = unit * r[i] * Fourth(std::max(r[(i + 1) % 3], r[(i + 2) % 3]));
    moment[i] = w[i] * (c.angular * swept + slender * (inertia_max - swept));
  }
  const mjtNum diameter = MeanDiameter(r);
  return {fluid.density * speed * (blunt * area + c.slender * (area_max - area)),
          fluid.density * mju_norm3(moment), 3 * kPi * diameter * fluid.viscosity,
          kPi * diameter * diameter * diameter * fluid.viscosity, reynolds};
}

Wrench EllipsoidMagnus(const EllipsoidShape& shape, const FluidConstants& fluid, const mjtNum w[3],
                       const mjtNum v[3]) {
  Wrench out;
  mju_cross(out.force, w, v);
  mju_scl3(out.force, out.force,
           shape.coefficients.magnus * fluid.density * EllipsoidVolume(shape.semiaxes));
  return out;
}

Wrench EllipsoidKutta(const EllipsoidShape& shape, const FluidConstants& fluid, const mjtNum v[3]) {
  const Projection projection = ProjectEllipsoid(shape.semiaxes, v);
  Wrench out;
  mjtNum circulation[3];
  mju_cross(circulation, projection.normal, v);
  mju_scl3(circulation, circulation,
           shape.coefficients.kutta * fluid.density * projection.area * projection.cosine);
  mju_cross(out.force, circulation, v);
  return out;
}

Wrench AddedMassConvective(const mjtNum mass[3], const mjtNum inertia[3], const mjtNum w[3],
                           const mjtNum v[3]) {
  mjtNum linear[3], angular[3], part[3];
  for (int i = 0; i < 3; ++i) {
    linear[i] = mass[i] * v[i];
    angular[i] = inertia[i] * w[i];
  }
  Wrench out;
  mju_cross(out.force, linear, w);
  mju_cross(out.torque, linear, v);
  mju_cross(part, angular, w);
  mju_addTo3(out.torque, part);
  return out;
}

EllipsoidShape GeomEllipsoid(const mjModel* m, int geom) {
  // geom_fluid: interaction scale, then the coefficients, then the added mass
  const mjtNum *size = m->geom_size + 3 * geom, *fluid = m->geom_fluid + mjNFLUID * geom;
  EllipsoidShape out{{size[0], size[1], size[2]},
                     {fluid[1], fluid[2], fluid[3], fluid[4], fluid[5]}};
  mjtNum* r = out.semiaxes;
  switch (m->geom_type[geom]) {
    case mjGEOM_SPHERE:
      r[1] = r[2] = size[0];
      break;
    case mjGEOM_CAPSULE:
      r[1] = size[0];
      r[2] = size[1] + size[0];
      break;
    case mjGEOM_CYLINDER:
      r[1] = size[0];
      r[2] = size[1];
      break;
    default:
      break;
  }
  return out;
}

}  // namespace fluid_sim
