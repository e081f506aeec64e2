// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Observes all vehicles with their accelerations; see fsr_observe.

#ifndef FLUID_SIM_EXCHANGE_OBSERVER_H_
#define FLUID_SIM_EXCHANGE_OBSERVER_H_

#include <cstdint>

#include "api/api.h"

namespace fluid_sim {

struct Observer {
  const mjModel* model;
  const mjData* data;
  mjData* scratch;
  const int* bases;
  int64_t count;
  double* rows;
};

inline void Observe(const Observer& o) {
  fsr_observe(o.model, o.data, o.scratch, o.bases, static_cast<int>(o.count), 1, o.rows);
}

}  // namespace fluid_sim

#endif  // FLUID_SIM_EXCHANGE_OBSERVER_H_
