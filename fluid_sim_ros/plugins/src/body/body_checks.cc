// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/body_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "body/stock_terms.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

constexpr mjtNum kTolerance = 1e-9;  // of the largest entry: what rounding of typed numbers leaves

std::string Format(mjtNum value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

// First dof above (or of) the body, or -1 for a body that cannot move.
int LastDof(const mjModel* m, int body) {
  while (body > 0 && m->body_dofnum[body] == 0) body = m->body_parentid[body];
  return body > 0 ? m->body_dofadr[body] + m->body_dofnum[body] - 1 : -1;
}

// A body that moves `body` and whose inertia MuJoCo stores as a diagonal, or -1.
int SimpleBody(const mjModel* m, int body) {
  for (int dof = LastDof(m, body); dof >= 0; dof = m->dof_parentid[dof]) {
    if (m->body_simple[m->dof_bodyid[dof]]) return m->dof_bodyid[dof];
  }
  return -1;
}

bool CheckInertiaStorage(const mjModel* m, const Config& config, const BodyFluid& body) {
  const bool drags = body.plugin_drag() && body.implicit;
  const int simple = SimpleBody(m, body.id);
  if (simple < 0 || (!body.added_mass && !body.damping.any && !drags)) return true;
  return config.Fail("MuJoCo keeps only the diagonal of this body's inertia; set simple=" +
                     std::string("\"false\" on ") + BodyTitle(m, simple));
}

bool CheckDoubleCounting(const mjModel* m, const Config& config, const BodyFluid& body) {
  if (body.buoyant && m->body_gravcomp[body.id] != 0) {
    return config.Fail("volume and gravcomp = " + Format(m->body_gravcomp[body.id]) +
                       " both lift this body; set gravcomp=\"0\"");
  }
  if (!StockActs(m, body.id)) return true;
  const std::string cure =
      "; set opt density=\"0\" viscosity=\"0\" and give the fluid by fluid_sim.medium";
  if (config.Has("drag") && body.drag != Drag::kBuiltin) {
    return config.Refuse("drag",
                         "builtin while opt.density or opt.viscosity > 0, for MuJoCo's "
                         "own drag acts on this body too" +
                             cure);
  }
  if (body.damping.any && !config.Has("drag")) {
    return config.Fail(
        "damping and MuJoCo's own drag (opt.density or opt.viscosity > 0) both "
        "brake this body" +
        cure + ", or say drag=\"builtin\" to have both");
  }
  return true;
}

bool CheckDensity(const mjModel* m, const Config& config, const Medium& medium,
                  const BodyFluid& body) {
  const bool needed = body.per_density || body.buoyant || body.plugin_drag();
  const mjtNum above = medium.has_surface ? medium.density[1] : 0;
  if (!needed || LowerDensity(medium, m) > 0 || above > 0) return true;
  // a drag with viscosity only is fine
  if (!body.per_density && !body.buoyant && LowerViscosity(medium, m) > 0) return true;
  return config.Fail(
      "the fluid has no density; give it by fluid_sim.medium (or opt.density "
      "where MuJoCo's own drag is wanted)");
}

// MuJoCo's own drag, asked for beside a fluid that it does not know of, would be no drag at all.
bool CheckBuiltin(const mjModel* m, const Config& config, const Medium& medium,
                  const BodyFluid& body) {
  if (body.drag != Drag::kBuiltin || !config.Has("drag")) return true;
  const FluidConstants fluid = StrongestFluid(medium, m);
  if (StockActs(m, body.id) || (fluid.density <= 0 && fluid.viscosity <= 0)) return true;
  return config.Refuse("drag",
                       "ellipsoid, inertia_box or none, for MuJoCo's own drag does not know of "
                       "fluid_sim.medium; or opt.density > 0");
}

bool CheckShare(const Config& config, const Medium& medium, const BodyFluid& body) {
  if (!medium.has_surface || !body.solids.empty()) return true;
  return config.Fail(
      "the medium has a surface, but no geom says how deep this body is in it; "
      "give geoms or volume");
}

}  // namespace

bool CanMove(const mjModel* m, int body) { return LastDof(m, body) >= 0; }

bool MovesSimply(const mjModel* m, int body) { return SimpleBody(m, body) >= 0; }

int FreeTreeDof(const mjModel* m, int body) {
  const int joint = m->body_jntadr[body];
  if (joint < 0 || m->jnt_type[joint] != mjJNT_FREE || m->body_simple[body]) return -1;
  for (int other = body + 1; other < m->nbody; ++other) {
    if (m->body_parentid[other] == body) return -1;  // a child's inertia would be missing
  }
  for (int tendon = 0; tendon < m->ntendon; ++tendon) {
    if (m->tendon_armature[tendon] > 0) return -1;
  }
  return m->jnt_dofadr[joint];
}

bool CheckSemidefinite(const Config& config, const char* key, const mjtNum matrix[36],
                       bool symmetric) {
  mjtNum largest = 0, values[6], vectors[36];
  for (int i = 0; i < 36; ++i) largest = std::max(largest, std::abs(matrix[i]));
  for (int i = 0; i < 36 && symmetric; ++i) {
    const mjtNum twin = matrix[6 * (i % 6) + i / 6];
    if (std::abs(matrix[i] - twin) > kTolerance * largest) {
      return config.Refuse(key, "a symmetric matrix");
    }
  }
  const mjtNum lowest = EigenSymmetric6(matrix, values, vectors);
  if (lowest >= -kTolerance * largest) return true;
  return config.Refuse(key, "positive semi-definite (lowest eigenvalue " + Format(lowest) + ")");
}

bool CheckDiagonal(const Config& config, const char* key, const mjtNum matrix[36]) {
  for (int i = 0; i < 6; ++i) {
    if (matrix[7 * i] < 0) return config.Refuse(key, "diagonal entries >= 0");
  }
  return true;
}

bool CheckBody(const mjModel* m, const Config& config, const Medium& medium,
               const BodyFluid& body) {
  if (!CanMove(m, body.id)) return config.Fail("this body cannot move; remove the plugin");
  if (!body.added_mass && !body.damping.any && !body.buoyant && !body.plugin_drag()) {
    return config.Fail(
        "nothing is switched on; give added_mass, volume, linear_damping, "
        "quadratic_damping, cross_damping or drag (ellipsoid, inertia_box)");
  }
  if (body.drag == Drag::kInertiaBox && m->body_mass[body.id] < mjMINVAL) {
    return config.Refuse("drag", "inertia_box needs a body with mass");
  }
  return CheckInertiaStorage(m, config, body) && CheckDoubleCounting(m, config, body) &&
         CheckDensity(m, config, medium, body) && CheckBuiltin(m, config, medium, body) &&
         CheckShare(config, medium, body);
}

bool CheckOptions(const mjModel* m, int instance, const std::vector<BodyFluid>& bodies) {
  const Config config(m, instance, "model");
  const int passive = mjDSBL_SPRING | mjDSBL_DAMPER;
  if ((m->opt.disableflags & passive) == passive) {
    return config.Fail(
        "flag spring and damper are both disabled, which disables every passive "
        "force and this plugin too; enable one of them");
  }
  bool inertia = false;
  for (const BodyFluid& body : bodies) inertia |= body.added_mass;
  if (inertia && m->opt.solver == mjSOL_PGS && !(m->opt.disableflags & mjDSBL_CONSTRAINT)) {
    config.Warn(
        "solver PGS builds its contact matrix before the added mass is there, so contacts "
        "are less exact; use solver=\"Newton\" or \"CG\"");
  }
  if (m->opt.enableflags & mjENBL_SLEEP) {
    config.Warn(
        "a sleeping body does not notice wind, current or buoyancy; disable flag sleep or "
        "give the fluid bodies sleep=\"never\"");
  }
  return true;
}

}  // namespace fluid_sim
