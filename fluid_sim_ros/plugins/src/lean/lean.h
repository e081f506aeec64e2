// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Steps of a model without the work that cannot change its state.
//
// Savings, all exact to the bit:
// - Contacts (and with them all constraints, where the model has no others) are off in a step
//   while no two geoms can touch at any of its evaluations (clearance.h).
// - Geoms that only are looked at, cameras and lights are moved in the last step of a call alone.
// - Moments of actuators at sites are made along their own trees alone (transmission.h).
// - So are MuJoCo's own fluid forces and their slopes (stock_fluid.h).
// The step itself is MuJoCo's, of a copy of mjModel's head that shares all arrays with the model.

#ifndef FLUID_SIM_LEAN_LEAN_H_
#define FLUID_SIM_LEAN_LEAN_H_

#include <mujoco/mujoco.h>

#include <memory>
#include <vector>

#include "lean/clearance.h"
#include "lean/served.h"
#include "lean/stock_fluid.h"
#include "lean/transmission.h"

namespace fluid_sim {

// Why the steps of a model are MuJoCo's, whole.
enum class Whole {
  kNo,         // they are not
  kPlugins,    // of others, which may read anything
  kCallbacks,  // likewise
  kOptions,    // sleep, inverse dynamics, no reset of a bad state, or an integrator of other stages
  kFlexes,
};

class Lean {
 public:
  explicit Lean(const mjModel* m) { Learn(m); }

  // Before the first step of a call: what was changed in the model since the last one holds.
  void Begin(const mjModel* m);

  // One step, as mj_step(m, d) takes it; `last` of a call.
  void Step(const mjModel* m, mjData* d, bool last);

  Whole whole() const { return whole_; }
  Contacts contacts() const { return clearance_->contacts(); }
  bool constraints() const { return constraints_; }  // other than contacts
  int moved_geoms() const { return moved_geoms_; }   // at every evaluation
  bool fluid() const { return fluid_ready_; }        // by chain (stock_fluid.h)
  bool off() const { return off_; }                  // contacts, in the last step
  bool disguised() const { return disguised_; }      // moments by tree (transmission.h)

 private:
  void Learn(const mjModel* m);
  void TakeStep(const mjModel* m, mjData* d, bool last);
  bool StepRungeKutta(const mjModel* m, mjData* d);
  void StepImplicit(const mjModel* m, mjData* d, bool last);
  void StepAfterReset(const mjModel* m, mjData* d);
  void Keep(const mjModel* m, const mjData* d);
  void Restore(const mjModel* m, mjData* d) const;

  mjModel head_;  // of the model, its arrays shared
  const void* buffer_;
  std::vector<mjtNum> facts_;  // what the rest was learnt from
  std::unique_ptr<Clearance> clearance_;
  Transmission transmission_;
  StockFluid fluid_;
  std::vector<mjtNum> kept_;  // state before a step
  mjWarningStat kept_warnings_[mjNWARNING];
  Whole whole_ = Whole::kNo;
  bool disguised_ = false, fluid_ready_ = false;  // the head's actuators and fluid, in this call
  bool own_plugins_ = false, constraints_ = true, off_ = false;
  int moved_geoms_ = 0;
  int wait_ = 0;  // steps with contacts, before the next look
};

}  // namespace fluid_sim

#endif  // FLUID_SIM_LEAN_LEAN_H_
