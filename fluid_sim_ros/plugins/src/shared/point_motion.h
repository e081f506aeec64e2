// Velocity of, and wrenches at, points of bodies, in world axes.

#ifndef FLUID_SIM_SHARED_POINT_MOTION_H_
#define FLUID_SIM_SHARED_POINT_MOTION_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// Velocity of the body point at `point_w` [m/s] and of the body's rotation [rad/s].
void PointVelocity(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                   mjtNum velocity_w[3], mjtNum omega_w[3]);

// target += J'(force, torque) of a wrench at `point_w`; no stack memory.
void AddGeneralizedForce(const mjModel* m, const mjData* d, int body, const mjtNum point_w[3],
                         const mjtNum force_w[3], const mjtNum torque_w[3], mjtNum* target);

// A wrench whose torque is of the fluid, and in part not: `other` goes into all passive forces
// only.
struct PassiveWrench {
  const mjtNum *force_w, *torque_w, *other_torque_w;
};

// As AddGeneralizedForce into d->qfrc_fluid, and with the other torque into d->qfrc_passive.
void AddPassiveForce(const mjModel* m, mjData* d, int body, const mjtNum point_w[3],
                     const PassiveWrench& wrench);

// The tree of the body sleeps: its passive forces are not wanted.
bool IsAsleep(const mjModel* m, const mjData* d, int body);

}  // namespace fluid_sim

#endif  // FLUID_SIM_SHARED_POINT_MOTION_H_
