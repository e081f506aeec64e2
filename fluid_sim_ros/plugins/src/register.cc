// Registers every fluid_sim.* plugin when the library is loaded (MuJoCo plugin mechanism).

#include <mujoco/mujoco.h>

#include "assembly.h"
#include "noop.h"
#include "thruster.h"

mjPLUGIN_LIB_INIT(fluid_sim) {
  fluid_sim::RegisterNoop();
  fluid_sim::RegisterAssembly();
  fluid_sim::RegisterThruster();
}
