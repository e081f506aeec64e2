// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// MuJoCo's own fluid forces and their slopes, along each body's own chain of degrees of freedom.
//
// MuJoCo makes Jacobians over all degrees of freedom for each ellipsoid and box, and coefficients
// anew at each evaluation; the slopes, which implicitfast takes, can be half of a step. The steps
// here are of a copy of mjModel's head in which there is no fluid; MuJoCo's passive callback then
// adds what it would have added, to the bit, and the slopes are written before it integrates.

#ifndef FLUID_SIM_LEAN_STOCK_FLUID_H_
#define FLUID_SIM_LEAN_STOCK_FLUID_H_

#include <mujoco/mujoco.h>

#include <variant>
#include <vector>

#include "lean/fluid_ellipsoid.h"

namespace fluid_sim {

class StockFluid {
 public:
  // Whether these forces can be served: there are any, no gravity compensation is added after
  // them, and no chain is longer than what is worked on.
  void Learn(const mjModel* m);

  // Likewise as the options are now. With it the callback is there.
  bool Ready(const mjModel* m) const;

  // Whether the slopes can be: with implicitfast, where actuators have none, or no state either.
  bool ReadySlopes(const mjModel* m) const;

  // Let the head look so that MuJoCo's stages have nothing to do.
  void Disguise(mjModel* head) const { head->opt.density = head->opt.viscosity = 0; }

  // What the passive stage adds for the fluid, to what it has made of the rest. Places the geoms.
  void AddForces(const mjModel* m, mjData* d);

  // One step of implicitfast after mj_forward and mj_checkAcc of the head. With `whole` the slopes
  // are complete; else without the half that is not integrated.
  void Integrate(const mjModel* m, mjModel* head, mjData* d, bool whole) const;

 private:
  struct Part {
    int body, geom;    // -1: none
    int first, count;  // of its chain
    bool lone;         // all that moves its tree is one free joint
    std::variant<FluidEllipsoid, FluidBox> shape;
    mjtNum velocity[6];  // of the last evaluation
  };
  void AddPart(const mjModel* m, int body, int geom, std::variant<FluidEllipsoid, FluidBox> shape);
  void AddSlopes(const mjModel* m, mjData* d, const Part& part, bool whole) const;

  bool served_ = false, forces_only_ = false, plain_actuators_ = false;
  std::vector<Part> parts_;
  std::vector<int> chain_;   // degrees of freedom, rising
  std::vector<int> places_;  // of each chain's later columns in its rows of D
  std::vector<int> later_;   // where those of a part begin
};

}  // namespace fluid_sim

#endif  // FLUID_SIM_LEAN_STOCK_FLUID_H_
