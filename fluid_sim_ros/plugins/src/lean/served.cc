// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "lean/served.h"

#include "lean/stock_fluid.h"
#include "lean/transmission.h"

namespace fluid_sim {
namespace {

// Read at every evaluation.
__attribute__((tls_model("initial-exec"))) thread_local Service present;

void BeforePlugins(const mjModel* m, mjData* d) {
  if (m == present.head && present.fluid) present.fluid->AddForces(present.model, d);
}

void BeforeControl(const mjModel* m, mjData* d) {
  if (m == present.head && present.moments) WriteMoments(present.model, d);
}

}  // namespace

Served::Served(const Service& service) { present = service; }

Served::~Served() { present = Service(); }

const Service& PresentService() { return present; }

bool InstallPassive() {
  if (!mjcb_passive) mjcb_passive = BeforePlugins;
  return mjcb_passive == BeforePlugins;
}

bool InstallControl() {
  if (!mjcb_control) mjcb_control = BeforeControl;
  return mjcb_control == BeforeControl;
}

bool NoForeignCallback() {
  return (!mjcb_passive || mjcb_passive == BeforePlugins) &&
         (!mjcb_control || mjcb_control == BeforeControl);
}

}  // namespace fluid_sim
