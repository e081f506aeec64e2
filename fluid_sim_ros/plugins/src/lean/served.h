// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The model whose steps are taken in this thread through a changed copy of its head, and what
// MuJoCo's callbacks add to an evaluation of that copy.

#ifndef FLUID_SIM_LEAN_SERVED_H_
#define FLUID_SIM_LEAN_SERVED_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

class StockFluid;

struct Service {
  const mjModel* head = nullptr;   // that MuJoCo is given
  const mjModel* model = nullptr;  // whose copy it is
  bool moments = false;            // transmission.h
  StockFluid* fluid = nullptr;
};

// While one lives, evaluations of its head in this thread are served.
class Served {
 public:
  explicit Served(const Service& service);
  ~Served();
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;
};

// What this thread serves; no model where it serves none.
const Service& PresentService();

// The model that a head is a copy of; any other model is itself. Plugins are given heads.
inline const mjModel* WholeModel(const mjModel* m) {
  const Service& service = PresentService();
  return m == service.head ? service.model : m;
}

// Have MuJoCo call ours before plugins add their forces, and before actuators act. False where a
// user's callback is there.
bool InstallPassive();
bool InstallControl();

// These callbacks are none, or ours.
bool NoForeignCallback();

}  // namespace fluid_sim

#endif  // FLUID_SIM_LEAN_SERVED_H_
