// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Checks that bodies and actuators refer to plugin instances that can be theirs.
//
// MuJoCo's attach (of <attach> and MjSpec.attach_body) keeps named instances, but drops a plugin
// that is configured inside an element; the element's index then points at whatever instance of
// the whole model has that number. A hull whose plugin is a thruster's would feel no water.

#ifndef FLUID_SIM_SHARED_REFERENCES_H_
#define FLUID_SIM_SHARED_REFERENCES_H_

#include <mujoco/mujoco.h>

namespace fluid_sim {

// False after one line about the first body or actuator whose plugin is of the wrong kind, or whose
// unnamed instance is another body's.
bool CheckReferences(const mjModel* m);

}  // namespace fluid_sim

#endif  // FLUID_SIM_SHARED_REFERENCES_H_
