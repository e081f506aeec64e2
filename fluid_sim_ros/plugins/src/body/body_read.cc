// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Reads the attributes of fluid_sim.body (units, signs and defaults: doc/plugins.md).

#include "body/body_read.h"

#include <cmath>
#include <cstdio>

#include "body/body_checks.h"
#include "body/kappa.h"
#include "body/stock_terms.h"
#include "shared/numbers.h"
#include "shared/spatial.h"
#include "shared/terms.h"

namespace fluid_sim {
namespace {

// A 6x6 matrix from its diagonal (6), its upper triangle row by row (21) or all of it (36).
bool ReadMatrix6(const Config& config, const char* key, std::initializer_list<int> counts,
                 const char* allowed, bool* given, mjtNum out[36]) {
  std::vector<mjtNum> numbers;
  if (!config.Numbers(key, counts, allowed, &numbers)) return false;
  *given = !numbers.empty();
  if (numbers.size() == 36) mju_copy(out, numbers.data(), 36);
  size_t next = 0;
  for (int i = 0; i < 6 && *given && numbers.size() != 36; ++i) {
    for (int j = i; j < (numbers.size() == 6 ? i + 1 : 6); ++j) {
      out[6 * i + j] = out[6 * j + i] = numbers[next++];
    }
  }
  return true;
}

// Diagonal added mass at a geom, about the body's reference point in body axes.
void AddGeomMatrix(const mjModel* m, int geom, const mjtNum mass[3], const mjtNum inertia[3],
                   const mjtNum point[3], mjtNum target[36]) {
  mjtNum diagonal[36] = {0}, turned[36], shifted[36], rotation[9], offset[3];
  for (int i = 0; i < 3; ++i) {
    diagonal[7 * i] = mass[i];
    diagonal[7 * (3 + i)] = inertia[i];
  }
  mju_quat2Mat(rotation, m->geom_quat + 4 * geom);
  mju_sub3(offset, point, m->geom_pos + 3 * geom);
  RotateMatrix6(turned, diagonal, rotation);
  ShiftMatrix6(shifted, turned, offset);
  AddScaled36(target, shifted, m->geom_fluid[mjNFLUID * geom]);
}

bool ReadAddedMass(const mjModel* m, const Config& config, BodyFluid* out) {
  const std::vector<int> geoms = FluidGeoms(m, out->id);
  if (config.Text("added_mass") == "auto") {
    if (geoms.empty()) {
      return config.Refuse("added_mass",
                           "auto needs a geom with fluidshape=\"ellipsoid\" on this body; or "
                           "6, 21 or 36 numbers");
    }
    out->added_mass = out->per_density = true;
    for (int geom : geoms) {
      mjtNum mass[3], inertia[3];
      EllipsoidAddedMass(GeomEllipsoid(m, geom).semiaxes, mass, inertia);
      AddGeomMatrix(m, geom, mass, inertia, out->point, out->a);
    }
    for (mjtNum number : out->a) {
      if (std::isfinite(number)) continue;
      return config.Refuse("added_mass",
                           "6, 21 or 36 numbers: the axes of this body's ellipsoids are too "
                           "unlike, too large or too small for auto");
    }
  } else if (!ReadMatrix6(config, "added_mass", {6, 21, 36},
                          "auto, or 6, 21 or 36 numbers [kg], [kg m], [kg m^2]", &out->added_mass,
                          out->a) ||
             (out->added_mass && !CheckSemidefinite(config, "added_mass", out->a, true))) {
    return false;
  }
  if (!out->added_mass || out->drag != Drag::kBuiltin) return true;
  for (int geom : geoms) {
    const mjtNum* fluid = m->geom_fluid + mjNFLUID * geom;
    AddGeomMatrix(m, geom, fluid + 6, fluid + 9, out->point, out->builtin);
    out->has_builtin = true;
  }
  return true;
}

bool ReadCrossTerms(const Config& config, Damping* damping) {
  constexpr char kAllowed[] =
      "groups of `row absolute linear coefficient`, indices 1..6: force_row -= coefficient "
      "|nu_absolute| nu_linear";
  std::vector<mjtNum> numbers;
  for (const std::string& word : Split(config.Text("cross_damping"))) {
    mjtNum number;
    if (!ParseNumber(word, &number)) return config.Refuse("cross_damping", kAllowed);
    numbers.push_back(number);
  }
  if (numbers.size() % 4) return config.Refuse("cross_damping", kAllowed);
  for (size_t i = 0; i < numbers.size(); i += 4) {
    for (size_t k = i; k < i + 3; ++k) {
      if (numbers[k] != std::floor(numbers[k]) || numbers[k] < 1 || numbers[k] > 6) {
        return config.Refuse("cross_damping", kAllowed);
      }
    }
    damping->cross.push_back({static_cast<int>(numbers[i]) - 1,
                              static_cast<int>(numbers[i + 1]) - 1,
                              static_cast<int>(numbers[i + 2]) - 1, numbers[i + 3]});
  }
  return true;
}

// Whether two terms are of one product in one row.
bool SamePair(const CrossTerm& a, const CrossTerm& b) {
  const bool same = a.absolute == b.absolute && a.linear == b.linear;
  const bool swapped = a.absolute == b.linear && a.linear == b.absolute;
  return a.row == b.row && (same || swapped);
}

// Published cross terms are totals: what the added mass gives of them is not to be there twice.
bool ReadTotals(const mjModel* m, const Config& config, const Medium& medium, BodyFluid* out) {
  const int total = config.Word("cross_damping_total", {"false", "true"});
  if (total <= 0) return total == 0;
  std::vector<CrossTerm>& terms = out->damping.cross;
  if (terms.empty()) return config.Fail("cross_damping_total needs cross_damping");
  for (size_t i = 0; i < terms.size(); ++i) {
    bool once = terms[i].absolute != terms[i].linear;
    for (size_t k = 0; k < i; ++k) once &= !SamePair(terms[i], terms[k]);
    if (once) continue;
    return config.Refuse("cross_damping",
                         "with cross_damping_total, pairs of two different velocities, each pair "
                         "once in a row");
  }
  mjtNum a[36] = {0};
  AddScaled36(a, out->a, out->per_density ? LowerDensity(medium, m) : 1);
  TakeOffConvection(a, &terms);
  return true;
}

// The moments that fade with speed need their part of the matrix, and nothing that mirrors it.
bool ReadFade(const Config& config, Damping* damping) {
  constexpr char kAllowed[] = "2 numbers >= 0 [m/s], of roll and of pitch; 0: it does not fade";
  std::vector<mjtNum> fade;
  if (!config.Numbers("moment_fade", {2}, kAllowed, &fade)) return false;
  if (fade.empty()) return true;
  for (int i = 0; i < 2; ++i) {
    if (!(fade[i] >= 0)) return config.Refuse("moment_fade", kAllowed);
    damping->fade[i] = fade[i];
    if (!fade[i]) continue;
    damping->fades = true;
    const mjtNum* d = damping->linear;
    if (!d[6 * (3 + i)] && !d[6 * (3 + i) + 1]) {
      return config.Fail("moment_fade needs linear_damping with a moment by surge or sway");
    }
    if (d[3 + i] || d[6 + 3 + i]) {
      return config.Fail(
          "moment_fade: linear_damping has a force by the same rate of turn, which would not fade; "
          "allowed: 0 there");
    }
  }
  return true;
}

bool ReadDamping(const Config& config, Damping* damping) {
  bool linear, quadratic;
  if (!ReadMatrix6(config, "linear_damping", {6, 36}, "6 or 36 numbers [N s/m], [N s], [N m s]",
                   &linear, damping->linear) ||
      !ReadMatrix6(config, "quadratic_damping", {6, 36},
                   "6 or 36 numbers [N s^2/m^2], [N s^2/m], [N s^2], [N m s^2]", &quadratic,
                   damping->quadratic) ||
      (linear && !CheckSemidefinite(config, "linear_damping", damping->linear, false)) ||
      (quadratic && !CheckDiagonal(config, "quadratic_damping", damping->quadratic)) ||
      !ReadCrossTerms(config, damping) || !ReadFade(config, damping)) {
    return false;
  }
  damping->any = linear || quadratic || !damping->cross.empty();
  return true;
}

}  // namespace

const char* const kBodyAttributes[] = {
    "added_mass",    "reference_point",     "linear_damping", "quadratic_damping",
    "cross_damping", "cross_damping_total", "moment_fade",    "drag",
    "drag_area",     "drag_reynolds",       "drag_angular",   "rotational_damping",
    "volume",        "center_of_buoyancy",  "geoms",          "history"};
const int kBodyAttributeCount = sizeof(kBodyAttributes) / sizeof(kBodyAttributes[0]);

bool ReadBody(const mjModel* m, int instance, int body, const Medium& medium, bool has_foil,
              BodyFluid* out) {
  const Config config(m, instance, BodyTitle(m, body));
  out->id = body;
  std::vector<mjtNum> point;
  if (!config.Numbers("reference_point", {3}, "3 numbers [m], body axes", &point)) return false;
  if (!point.empty()) mju_copy3(out->point, point.data());
  if (!ReadDamping(config, &out->damping) || !ReadDrag(m, config, medium, has_foil, out) ||
      !ReadAddedMass(m, config, out) || !ReadTotals(m, config, medium, out) ||
      !ReadBuoyancy(m, config, out)) {
    return false;
  }
  if (!point.empty() && !out->added_mass && !out->damping.any) {
    return config.Fail("reference_point needs added_mass or damping");
  }
  out->free_dof = FreeTreeDof(m, body);
  if (!ReadHistory(m, config, medium, instance, out)) return false;
  out->diagonal_a = IsDiagonal6(out->a);
  Damping& damping = out->damping;
  damping.diagonal =
      damping.cross.empty() && IsDiagonal6(damping.linear) && IsDiagonal6(damping.quadratic);
  return CheckBody(m, config, medium, *out);
}

}  // namespace fluid_sim
