#include "fluid_terms.h"

#include <algorithm>
#include <cmath>

namespace fluid_sim {
namespace {

constexpr mjtNum kPi = 3.14159265358979323846;

mjtNum Square(mjtNum x) { return x * x; }
mjtNum Fourth(mjtNum x) { return Square(Square(x)); }

mjtNum EllipsoidVolume(const mjtNum r[3]) { return 4.0 / 3.0 * kPi * r[0] * r[1] * r[2]; }

struct SortedAxes {
  mjtNum max, mid, min;
};

SortedAxes Sort(const mjtNum r[3]) {
  const mjtNum max = std::max({r[0], r[1], r[2]});
  const mjtNum min = std::min({r[0], r[1], r[2]});
  return {max, r[0] + r[1] + r[2] - max - min, min};
}

}  // namespace

void EquivalentInertiaBox(const mjModel* m, int body, mjtNum edges[3]) {
  const mjtNum* inertia = m->body_inertia + 3 * body;
  const mjtNum scale = 6.0 / m->body_mass[body];
  for (int i = 0; i < 3; ++i) {
    const mjtNum rest = inertia[(i + 1) % 3] + inertia[(i + 2) % 3] - inertia[i];
    edges[i] = std::sqrt(std::max(mjMINVAL, rest) * scale);
  }
}

Wrench InertiaBoxDrag(const mjtNum edges[3], const MediumConstants& medium, const mjtNum w[3],
                      const mjtNum v[3]) {
  Wrench out;
  for (int i = 0; i < 3; ++i) {
    const mjtNum a = edges[(i + 1) % 3], b = edges[(i + 2) % 3];
    out.force[i] = -0.5 * medium.density * a * b * std::abs(v[i]) * v[i];
    out.torque[i] =
        -medium.density * edges[i] * (Fourth(a) + Fourth(b)) * std::abs(w[i]) * w[i] / 64;
  }
  return out;
}

Wrench InertiaBoxViscous(const mjtNum edges[3], const MediumConstants& medium, const mjtNum w[3],
                         const mjtNum v[3]) {
  const mjtNum diameter = (edges[0] + edges[1] + edges[2]) / 3;
  Wrench out;
  mju_scl3(out.force, v, -3 * kPi * diameter * medium.viscosity);
  mju_scl3(out.torque, w, -kPi * diameter * diameter * diameter * medium.viscosity);
  return out;
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

Wrench EllipsoidDrag(const mjtNum r[3], const EllipsoidCoefficients& c,
                     const MediumConstants& medium, const mjtNum w[3], const mjtNum v[3]) {
  const SortedAxes axes = Sort(r);
  const mjtNum area = ProjectEllipsoid(r, v).area;
  const mjtNum area_max = kPi * axes.max * axes.mid;
  const mjtNum linear =
      medium.density * mju_norm3(v) * (area * c.blunt + c.slender * (area_max - area));

  const mjtNum unit = 8.0 / 15.0 * kPi;
  const mjtNum inertia_max = unit * axes.mid * Fourth(axes.max);
  mjtNum moment[3];
  for (int i = 0; i < 3; ++i) {
    const mjtNum swept = unit * r[i] * Fourth(std::max(r[(i + 1) % 3], r[(i + 2) % 3]));
    moment[i] = w[i] * (c.angular * swept + c.slender * (inertia_max - swept));
  }
  Wrench out;
  mju_scl3(out.force, v, -linear);
  mju_scl3(out.torque, w, -medium.density * mju_norm3(moment));
  return out;
}

Wrench EllipsoidViscous(const mjtNum r[3], const MediumConstants& medium, const mjtNum w[3],
                        const mjtNum v[3]) {
  const mjtNum diameter = 2.0 / 3.0 * (r[0] + r[1] + r[2]);
  Wrench out;
  mju_scl3(out.force, v, -3 * kPi * diameter * medium.viscosity);
  mju_scl3(out.torque, w, -kPi * diameter * diameter * diameter * medium.viscosity);
  return out;
}

Wrench EllipsoidMagnus(const mjtNum r[3], mjtNum coefficient, const MediumConstants& medium,
                       const mjtNum w[3], const mjtNum v[3]) {
  Wrench out;
  mju_cross(out.force, w, v);
  mju_scl3(out.force, out.force, coefficient * medium.density * EllipsoidVolume(r));
  return out;
}

Wrench EllipsoidKutta(const mjtNum r[3], mjtNum coefficient, const MediumConstants& medium,
                      const mjtNum v[3]) {
  const Projection projection = ProjectEllipsoid(r, v);
  Wrench out;
  mjtNum circulation[3];
  mju_cross(circulation, projection.normal, v);
  mju_scl3(circulation, circulation,
           coefficient * medium.density * projection.area * projection.cosine);
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

void GeomSemiaxes(const mjModel* m, int geom, mjtNum semiaxes[3]) {
  const mjtNum* size = m->geom_size + 3 * geom;
  switch (m->geom_type[geom]) {
    case mjGEOM_SPHERE:
      semiaxes[0] = semiaxes[1] = semiaxes[2] = size[0];
      break;
    case mjGEOM_CAPSULE:
      semiaxes[0] = semiaxes[1] = size[0];
      semiaxes[2] = size[1] + size[0];
      break;
    case mjGEOM_CYLINDER:
      semiaxes[0] = semiaxes[1] = size[0];
      semiaxes[2] = size[1];
      break;
    default:
      mju_copy3(semiaxes, size);
  }
}

}  // namespace fluid_sim
