// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// fluid_sim.foil: lift and drag of wings, fins and whole aircraft from the local flow.
//
// A foil is at a site (instance key `site`, several names allowed) or on each body that carries
// the instance. Foils are evaluated after all bodies of the assembly, by instance and site.

#ifndef FLUID_SIM_FOIL_FOIL_H_
#define FLUID_SIM_FOIL_FOIL_H_

#include <mujoco/mujoco.h>

#include <vector>

#include "foil/foil_model.h"
#include "medium/medium.h"
#include "shared/terms.h"

namespace fluid_sim {

// Angle of a control surface [rad]: gain times a hinge's angle, an actuator's activation or
// control; 0 without a source.
struct Deflection {
  int joint = -1, actuator = -1;
  mjtNum gain = 1;
};

struct Foil {
  int body = -1, site = -1;  // site -1: the body's own frame (aircraft: at its centre of mass)
  bool aircraft = false;
  Wing wing;
  Aircraft set;
  Deflection deflection[3];  // wing: the first; aircraft: aileron, elevator, rudder
};

extern const char* const kFoilAttributes[];
extern const int kFoilAttributeCount;

// Append the foils of every fluid_sim.foil instance in order; false after one line.
bool ReadFoils(const mjModel* m, const Medium& medium, std::vector<Foil>* foils);

// Force and torque about `point_w`, world axes.
Wrench EvaluateFoil(const mjModel* m, const mjData* d, const Medium& medium, const Foil& foil,
                    const mjtNum point_w[3]);

// Add the force of a foil to qfrc_fluid and qfrc_passive.
void ApplyFoil(const mjModel* m, mjData* d, const Medium& medium, const Foil& foil);

}  // namespace fluid_sim

#endif  // FLUID_SIM_FOIL_FOIL_H_
