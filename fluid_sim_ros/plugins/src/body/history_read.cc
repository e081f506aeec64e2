// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Reads whether a body has a history force (units and defaults: doc/plugins.md).

#include <algorithm>
#include <cmath>

#include "body/body_read.h"
#include "shared/numbers.h"

namespace fluid_sim {
namespace {

constexpr mjtNum kLongest = 1.5;   // of the longest to the shortest axis of what counts as a sphere
constexpr mjtNum kSlowest = 1e-5;  // rate of the first exponential, in 1/T
constexpr mjtNum kRatio = 3;       // of neighbouring rates

// Mei and Adrian (1992), J. Fluid Mech. 237:323: c = 2, c2 = .105. Dorgan and Loth (2007), Int. J.
// Multiphase Flow 33:833: c = 2.5, c2 = .2 (from memory).
constexpr mjtNum kMei[2] = {2, 0.105}, kDorgan[2] = {2.5, 0.2};

bool Shared(const mjModel* m, int instance) {
  int count = 0;
  for (int body = 1; body < m->nbody; ++body) count += m->body_plugin[body] == instance;
  return count > 1;
}

}  // namespace

bool ReadHistory(const mjModel* m, const Config& config, const Medium& medium, int instance,
                 BodyFluid* out) {
  const int kernel = config.Word("history", {"none", "basset", "mei_adrian", "dorgan_loth"});
  if (kernel < 0) return false;
  History& history = out->history;
  history.kernel = static_cast<HistoryKernel>(kernel);
  if (!history.on()) return true;
  if (out->drag != Drag::kEllipsoid || out->ellipsoids.size() != 1) {
    return config.Fail(
        "history needs drag=\"ellipsoid\" and one geom with fluidshape=\"ellipsoid\"");
  }
  const mjtNum* r = out->ellipsoids[0].shape.semiaxes;
  if (std::max({r[0], r[1], r[2]}) > kLongest * std::min({r[0], r[1], r[2]})) {
    return config.Fail(
        "history is that of a sphere: it needs an ellipsoid whose longest axis is at most 1.5 "
        "times "
        "its shortest");
  }
  if (out->free_dof < 0) {
    return config.Fail(
        "history needs a body with a freejoint, without other joints or bodies on it");
  }
  if (Shared(m, instance)) {
    return config.Fail(
        "history needs a plugin instance of the body's own; several bodies share it");
  }
  const mjtNum density = LowerDensity(medium, m), viscosity = LowerViscosity(medium, m);
  if (!(density > 0 && viscosity > 0)) {
    return config.Fail("history needs a density and a viscosity above 0 of the (lower) fluid");
  }
  history.instance = instance;
  history.radius = (r[0] + r[1] + r[2]) / 3;
  mju_copy3(history.center, out->ellipsoids[0].position);
  const mjtNum time = history.radius * history.radius * density / (kPi * viscosity);
  for (int k = 0; k < kHistoryModes; ++k) history.rate[k] = kSlowest * std::pow(kRatio, k) / time;
  if (history.kernel != HistoryKernel::kBasset) {
    const mjtNum* constants = history.kernel == HistoryKernel::kMeiAdrian ? kMei : kDorgan;
    history.share = HistoryShares(constants[0]);
    history.c2 = constants[1];
  }
  return true;
}

}  // namespace fluid_sim
