// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "lean/fluid_ellipsoid.h"

#include <algorithm>
#include <cmath>

#include "body/ellipsoid.h"
#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

mjtNum Norm3(const mjtNum x[3]) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }
mjtNum AtLeast(mjtNum x) { return std::max<mjtNum>(mjMINVAL, x); }
mjtNum Inverse(mjtNum x) { return x > mjMINVAL ? 1.0 / x : 0; }

// slopes[row..row+3][column..column+3] += part
void AddBlock(mjtNum slopes[36], const mjtNum part[9], int row, int column) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) slopes[6 * (row + i) + column + j] += part[3 * i + j];
  }
}

// Of a x b by a, and by b.
void CrossSlopes(const mjtNum a[3], const mjtNum b[3], mjtNum by_a[9], mjtNum by_b[9]) {
  const mjtNum first[9] = {0, b[2], -b[1], -b[2], 0, b[0], b[1], -b[0], 0};
  const mjtNum second[9] = {0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0};
  std::copy(first, first + 9, by_a);
  std::copy(second, second + 9, by_b);
}

}  // namespace

FluidEllipsoid::FluidEllipsoid(const mjModel* m, int geom) {
  const mjtNum* fluid = m->geom_fluid + mjNFLUID * geom;
  const mjtNum density = m->opt.density, viscosity = m->opt.viscosity, angular = fluid[3];
  const EllipsoidShape shape = GeomEllipsoid(m, geom);
  const mjtNum* r = shape.semiaxes;
  scale_ = fluid[0];
  density_ = density;
  blunt_ = fluid[1];
  slender_ = fluid[2];
  kutta_ = fluid[4] * density;
  magnus_ = fluid[5] * density * (4.0 / 3.0 * kPi * r[0] * r[1] * r[2]);
  const mjtNum longest = std::max(std::max(r[0], r[1]), r[2]);
  const mjtNum shortest = std::min(std::min(r[0], r[1]), r[2]);
  const mjtNum middle = r[0] + r[1] + r[2] - longest - shortest, unit = Inverse(longest);
  circle_ = kPi * longest * longest;
  longest_squared_ = longest * longest;
  area_max_ = kPi * longest * middle;
  const mjtNum inertia = 8.0 / 15.0 * kPi * middle * Fourth(longest);
  const mjtNum slope_inertia = 8.0 / 15.0 * kPi * middle * Square(longest) * Square(longest);
  for (int i = 0; i < 3; ++i) {
    const mjtNum next = r[(i + 1) % 3], last = r[(i + 2) % 3];
    mass_[i] = density * fluid[6 + i];
    inertia_[i] = density * fluid[9 + i];
    square_[i] = Square(next * unit * (last * unit));
    const mjtNum swept = 8.0 / 15.0 * kPi * r[i] * Fourth(std::max(next, last));
    moment_[i] = angular * swept + slender_ * (inertia - swept);
    slope_moment_[i] = angular * swept + slender_ * (slope_inertia - swept);
  }
  const mjtNum diameter = 2.0 / 3.0 * (r[0] + r[1] + r[2]);
  viscous_linear_ = viscosity * (3.0 * kPi * diameter);
  viscous_angular_ = viscosity * (kPi * diameter * diameter * diameter);
  slope_linear_ = viscosity * 3.0 * kPi * diameter;
  slope_angular_ = viscous_angular_;
  slope_kutta_ = kPi * fluid[4] * density;
}

void FluidEllipsoid::Force(const mjtNum velocity[6], mjtNum force[6]) const {
  const mjtNum *w = velocity, *v = velocity + 3;
  mjtNum linear[3], angular[3], added[3], part[3];
  for (int i = 0; i < 3; ++i) {
    linear[i] = mass_[i] * v[i];
    angular[i] = inertia_[i] * w[i];
  }
  Cross3(added, linear, w);
  Cross3(force, linear, v);
  Cross3(part, angular, w);
  AddTo3(force, part);

  // along the way u: of a x^2 + b y^2 + c z^2 = 1
  mjtNum magnus[3], u[3], share[3], normal[3], circulation[3], kutta[3], moment[3];
  Cross3(magnus, w, v);
  const mjtNum speed = Norm3(v);
  Scale3(u, v, Inverse(speed));
  const mjtNum second =
      square_[0] * u[0] * u[0] + square_[1] * u[1] * u[1] + square_[2] * u[2] * u[2];
  Scale3(share, square_, Inverse(second));
  const mjtNum fourth = Square(share[0]) * u[0] * u[0] + Square(share[1]) * u[1] * u[1] +
                        Square(share[2]) * u[2] * u[2];
  const mjtNum area = circle_ * std::sqrt(second * fourth);
  for (int i = 0; i < 3; ++i) normal[i] = share[i] * u[i];
  Cross3(circulation, normal, v);
  Scale3(circulation, circulation, kutta_ * Inverse(fourth) * area);
  Cross3(kutta, circulation, v);
  for (int i = 0; i < 3; ++i) moment[i] = w[i] * moment_[i];
  const mjtNum drag =
      viscous_linear_ + density_ * speed * (area * blunt_ + slender_ * (area_max_ - area));
  const mjtNum spin_drag = viscous_angular_ + density_ * Norm3(moment);
  for (int i = 0; i < 3; ++i) {
    force[i] -= spin_drag * w[i];
    force[3 + i] = added[i] + (magnus[i] * magnus_ + kutta[i] - drag * v[i]);
  }
  for (int i = 0; i < 6; ++i) force[i] *= scale_;
}

void FluidEllipsoid::AddMagnus(const mjtNum velocity[6], mjtNum slopes[36]) const {
  mjtNum w[3], v[3], by_w[9], by_v[9];
  Scale3(w, velocity, magnus_);
  Scale3(v, velocity + 3, magnus_);
  CrossSlopes(w, v, by_w, by_v);
  AddBlock(slopes, by_w, 3, 0);
  AddBlock(slopes, by_v, 3, 3);
}

FluidEllipsoid::Way FluidEllipsoid::WayOf(const mjtNum v[3]) const {
  Way way;
  way.speed = Norm3(v);
  Scale3(way.u, v, Inverse(way.speed));
  for (int i = 0; i < 3; ++i) way.uu[i] = Square(way.u[i]);
  const mjtNum second = Dot3(square_, way.uu);
  way.root = std::sqrt(second);
  Scale3(way.share, square_, Inverse(second));
  for (int i = 0; i < 3; ++i) way.shares[i] = Square(way.share[i]);
  way.fourth = Dot3(way.shares, way.uu);
  way.root_fourth = std::sqrt(way.fourth);
  return way;
}

void FluidEllipsoid::AddKutta(const Way& way, mjtNum slopes[36]) const {
  const auto [a, b, c] = way.share;
  const auto [xx, yy, zz] = way.uu;
  const mjtNum lift[3] = {yy * (a - b) + zz * (a - c), xx * (b - a) + zz * (b - c),
                          xx * (c - a) + yy * (c - b)};
  const mjtNum inverse = Inverse(way.fourth);
  mjtNum factor = 0, inner[3], out[9];
  if (way.fourth > mjMINVAL) {
    factor = slope_kutta_ * (way.root * longest_squared_) * way.speed / way.root_fourth;
  }
  for (int i = 0; i < 3; ++i) inner[i] = way.shares[i] * inverse - way.share[i] + 1;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const mjtNum difference = (way.share[j] - way.share[i]) * 2;
      out[3 * i + j] = (difference + inner[j] * lift[i]) * (way.u[i] * way.u[j]);
    }
  }
  for (int i = 0; i < 3; ++i) out[4 * i] -= lift[i];
  for (int i = 0; i < 9; ++i) out[i] *= factor;
  AddBlock(slopes, out, 3, 3);
}

void FluidEllipsoid::AddDrag(const Way& way, mjtNum slopes[36]) const {
  const auto [a, b, c] = way.share;
  const auto [x, y, z] = way.u;
  const auto [xx, yy, zz] = way.uu;
  const mjtNum scale = kPi * (longest_squared_ * way.root), area = scale * way.root_fourth;
  const mjtNum area_slope = way.fourth > mjMINVAL ? scale / way.root_fourth : 0;
  const mjtNum drag = density_ * (area * blunt_ + slender_ * (area_max_ - area));
  const mjtNum by_area = density_ * way.speed * (blunt_ - slender_) * area_slope;
  const mjtNum area_slopes[3] = {by_area * a * x * (b * yy * (a - b) + c * zz * (a - c)),
                                 by_area * b * y * (a * xx * (b - a) + c * zz * (b - c)),
                                 by_area * c * z * (a * xx * (c - a) + b * yy * (c - b))};
  const mjtNum inner = xx + yy + zz, factor = -drag * way.speed;
  mjtNum out[9] = {xx, x * y, x * z, x * y, yy, y * z, x * z, y * z, zz};
  for (int i = 0; i < 3; ++i) out[4 * i] += inner;
  for (int i = 0; i < 9; ++i) out[i] = out[i] * factor + area_slopes[i % 3] * -way.u[i / 3];
  for (int i = 0; i < 3; ++i) out[4 * i] -= slope_linear_;
  AddBlock(slopes, out, 3, 3);
}

void FluidEllipsoid::AddSpin(const mjtNum w[3], mjtNum slopes[36]) const {
  mjtNum moment[3], squared[3], out[9];
  for (int i = 0; i < 3; ++i) moment[i] = w[i] * slope_moment_[i];
  const mjtNum density = density_ / AtLeast(Norm3(moment));
  for (int i = 0; i < 3; ++i) squared[i] = -density * w[i] * slope_moment_[i] * slope_moment_[i];
  const mjtNum diagonal =
      w[0] * squared[0] + w[1] * squared[1] + w[2] * squared[2] - slope_angular_;
  for (int i = 0; i < 9; ++i) out[i] = (i % 4 == 0 ? diagonal : 0) + squared[i % 3] * w[i / 3];
  AddBlock(slopes, out, 0, 0);
}

void FluidEllipsoid::AddAddedMass(const mjtNum velocity[6], mjtNum slopes[36]) const {
  const mjtNum *w = velocity, *v = velocity + 3;
  mjtNum linear[3], angular[3], by_momentum[9], by_velocity[9];
  for (int i = 0; i < 3; ++i) {
    linear[i] = mass_[i] * v[i];
    angular[i] = inertia_[i] * w[i];
  }
  const auto add = [&](const mjtNum momentum[3], const mjtNum factor[3], const mjtNum moving[3],
                       int row, int momentum_column, int velocity_column) {
    CrossSlopes(momentum, moving, by_momentum, by_velocity);
    AddBlock(slopes, by_velocity, row, velocity_column);
    for (int i = 0; i < 9; ++i) by_momentum[i] *= factor[i % 3];
    AddBlock(slopes, by_momentum, row, momentum_column);
  };
  add(angular, inertia_, w, 0, 0, 0);
  add(linear, mass_, v, 0, 3, 3);
  add(linear, mass_, w, 3, 3, 0);
}

void FluidEllipsoid::Slopes(const mjtNum velocity[6], bool symmetric, mjtNum slopes[36]) const {
  std::fill(slopes, slopes + 36, 0);
  AddMagnus(velocity, slopes);
  const Way way = WayOf(velocity + 3);
  AddKutta(way, slopes);
  AddDrag(way, slopes);
  AddSpin(velocity, slopes);
  AddAddedMass(velocity, slopes);
  for (int i = 0; i < 6 && symmetric; ++i) {
    for (int j = 0; j < i; ++j) {
      slopes[6 * i + j] = slopes[6 * j + i] = 0.5 * (slopes[6 * i + j] + slopes[6 * j + i]);
    }
  }
}

FluidBox::FluidBox(const mjModel* m, int body)
    : density_(m->opt.density), viscosity_(m->opt.viscosity) {
  const mjtNum *inertia = m->body_inertia + 3 * body, mass = m->body_mass[body];
  mjtNum box[3];
  box[0] = std::sqrt(AtLeast(inertia[1] + inertia[2] - inertia[0]) / mass * 6.0);
  box[1] = std::sqrt(AtLeast(inertia[0] + inertia[2] - inertia[1]) / mass * 6.0);
  box[2] = std::sqrt(AtLeast(inertia[0] + inertia[1] - inertia[2]) / mass * 6.0);
  const mjtNum diameter = (box[0] + box[1] + box[2]) / 3.0;
  viscous_angular_ = -kPi * diameter * diameter * diameter * viscosity_;
  viscous_linear_ = -3.0 * kPi * diameter * viscosity_;
  for (int i = 0; i < 3; ++i) {
    const mjtNum a = box[i == 0 ? 1 : 0], b = box[i == 2 ? 1 : 2];
    linear_[i] = 0.5 * density_ * a * b;
    slope_linear_[i] = -0.5 * density_ * a * b * 2;
    angular_[i] = density_ * box[i] * (a * a * a * a + b * b * b * b);
    slope_angular_[i] = -density_ * box[i] * (a * a * a * a + b * b * b * b) * 2;
  }
}

void FluidBox::Force(const mjtNum velocity[6], mjtNum force[6]) const {
  const mjtNum *w = velocity, *v = velocity + 3;
  std::fill(force, force + 6, 0);
  if (viscous()) {
    Scale3(force, w, viscous_angular_);
    Scale3(force + 3, v, viscous_linear_);
  }
  if (!dense()) return;
  for (int i = 0; i < 3; ++i) {
    force[3 + i] -= linear_[i] * std::abs(v[i]) * v[i];
    force[i] -= angular_[i] * std::abs(w[i]) * w[i] / 64.0;
  }
}

void FluidBox::Slopes(const mjtNum velocity[6], mjtNum viscous[6], mjtNum dense[6]) const {
  const mjtNum *w = velocity, *v = velocity + 3;
  for (int i = 0; i < 3; ++i) {
    viscous[i] = viscous_angular_;
    viscous[3 + i] = viscous_linear_;
    dense[i] = slope_angular_[i] * std::abs(w[i]) / 64.0;
    dense[3 + i] = slope_linear_[i] * std::abs(v[i]);
  }
}

}  // namespace fluid_sim
