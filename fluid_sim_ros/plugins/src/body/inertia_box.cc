// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/inertia_box.h"

#include <algorithm>
#include <cmath>

#include "shared/numbers.h"

namespace fluid_sim {

void EquivalentInertiaBox(const mjModel* m, int body, mjtNum edges[3]) {
  const mjtNum* inertia = m->body_inertia + 3 * body;
  const mjtNum scale = 6.0 / m->body_mass[body];
  for (int i = 0; i < 3; ++i) {
    const mjtNum rest = inertia[(i + 1) % 3] + inertia[(i + 2) % 3] - inertia[i];
    edges[i] = std::sqrt(std::max(mjMINVAL, rest) * scale);
  }
}

Wrench BoxResistance::Drag(const mjtNum w[3], const mjtNum v[3]) const {
  Wrench out;
  for (int i = 0; i < 3; ++i) {
    out.force[i] = -linear[i] * v[i];
    out.torque[i] = -angular[i] * w[i];
  }
  return out;
}

Wrench BoxResistance::Viscous(const mjtNum w[3], const mjtNum v[3]) const {
  Wrench out;
  mju_scl3(out.force, v, -viscous_linear);
  mju_scl3(out.torque, w, -viscous_angular);
  return out;
}

BoxResistance InertiaBoxResistance(const mjtNum edges[3], const FluidConstants& fluid,
                                   const mjtNum w[3], const mjtNum v[3]) {
  BoxResistance out;
  for (int i = 0; i < 3; ++i) {
    const mjtNum a = edges[(i + 1) % 3], b = edges[(i + 2) % 3];
    out.linear[i] = 0.5 * fluid.density * a * b * std::abs(v[i]);
    out.angular[i] = fluid.density * edges[i] * (Fourth(a) + Fourth(b)) * std::abs(w[i]) / 64;
  }
  const mjtNum diameter = (edges[0] + edges[1] + edges[2]) / 3;
  out.viscous_linear = 3 * kPi * diameter * fluid.viscosity;
  out.viscous_angular = kPi * diameter * diameter * diameter * fluid.viscosity;
  return out;
}

}  // namespace fluid_sim
