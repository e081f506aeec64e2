// fluid_sim.medium: the fluids around the bodies, at most one per model.
//
// Two fluids with a level surface between them (water under air), or one fluid everywhere. Current
// and wind move horizontally or vertically as U(t) s(height); U follows a target at a limited
// rate, in closed form, so that its time derivative is exact and the state is a pure function of
// time between two changes of the target.

#ifndef FLUID_SIM_MEDIUM_H_
#define FLUID_SIM_MEDIUM_H_

#include <mujoco/mujoco.h>

#include "profile.h"

namespace fluid_sim {

// One fluid as a body meets it.
struct Flow {
  bool lower;              // the fluid below the surface (or the only one)
  mjtNum weight;           // share of the body in this fluid [-]
  mjtNum density;          // [kg/m^3]
  mjtNum viscosity;        // dynamic [Pa s]
  mjtNum velocity[3];      // undisturbed, world [m/s]
  mjtNum acceleration[3];  // Du/Dt = du/dt + (u.grad)u, world [m/s^2]
};

// A run-time velocity in plugin_state: it leaves `start` at `start_time` towards `target`.
enum MediumState { kTarget = 0, kStart = 3, kStartTime = 6, kDriveState = 7, kMediumState = 14 };

struct Stream {
  mjtNum initial[3] = {0, 0, 0};  // [m/s]
  mjtNum slew = 1;                // [m/s^2]; 0: no limit, a change is a step
  mjtNum datum = 0;               // world z from which the profile counts its height [m]
  Profile profile;
};

struct Medium {
  int instance = -1;   // plugin instance, or -1: the model has none, opt.* holds
  bool equal = false;  // states the same as opt.*, which then stays in charge
  bool has_surface = false;
  mjtNum surface = 0;            // height of the free surface, world z [m]
  mjtNum density[2] = {0, 0};    // below, above [kg/m^3]
  mjtNum viscosity[2] = {0, 0};  // below, above [Pa s]
  Stream current, wind;

  bool in_charge() const { return instance >= 0 && !equal; }
};

extern const char* const kMediumAttributes[];
extern const int kMediumAttributeCount;

// Read the model's fluid_sim.medium, if any; false after one line about what is wrong.
bool ReadMedium(const mjModel* m, Medium* medium);

// Density and viscosity of the lower (only) fluid.
mjtNum LowerDensity(const Medium& medium, const mjModel* m);
mjtNum LowerViscosity(const Medium& medium, const mjModel* m);

// The fluids with a share in a body whose share `wet` lies below the surface, flow taken at the
// world point; returns how many of out[2] are filled (1 or 2).
int FlowsAt(const Medium& medium, const mjModel* m, const mjData* d, const mjtNum point_w[3],
            mjtNum wet, Flow out[2]);

// Run-time velocity of a stream at the data's time and its derivative [m/s], [m/s^2].
void StreamVelocity(const Stream& stream, const mjtNum* state, mjtNum time, mjtNum velocity[3],
                    mjtNum derivative[3]);

// Let a stream move from its present velocity to `target`.
void SetTarget(const Stream& stream, mjtNum* state, mjtNum time, const mjtNum target[3]);

// State of the two streams at the start: the configured velocities, reached long ago.
void ResetMediumState(const Medium& medium, mjtNum* state);

}  // namespace fluid_sim

#endif  // FLUID_SIM_MEDIUM_H_
