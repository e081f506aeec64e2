// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "medium/grid.h"

#include <algorithm>
#include <cmath>

namespace fluid_sim {
namespace {

constexpr char kAxisNames[] = "txyz";
constexpr int kCorners = 1 << kGridAxes;
constexpr mjtNum kRounding = 1e-9;  // of an axis' length: a sum of timesteps ends on it

// Where a coordinate lies on an axis: between the points `low` and low + 1, or held at one.
struct Place {
  int low = 0;
  mjtNum share = 0;  // of the way to the next point
  mjtNum slope = 0;  // d(share)/d(coordinate); 0 where the value is held
};

Place Locate(const mjtNum* axis, int size, mjtNum x) {
  Place place;
  if (size < 2 || !(x >= axis[0])) return place;  // NaN too
  if (x >= axis[size - 1]) {
    place.low = size - 1;
    return place;
  }
  place.low = static_cast<int>(std::upper_bound(axis, axis + size, x) - axis) - 1;
  place.slope = 1 / (axis[place.low + 1] - axis[place.low]);
  place.share = (x - axis[place.low]) * place.slope;
  return place;
}

int FindNumeric(const mjModel* m, const std::string& name) {
  return mj_name2id(m, mjOBJ_NUMERIC, name.c_str());
}

}  // namespace

bool ReadGrid(const Config& config, const mjModel* m, const char* key, Grid* grid) {
  if (!config.Has(key)) return true;
  const int id = FindNumeric(m, config.Text(key));
  if (id < 0) return config.Refuse(key, "the name of a <custom><numeric> of the model");
  const int start = m->numeric_adr[id], count = m->numeric_size[id];
  const mjtNum* numbers = m->numeric_data + start;
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(numbers[i])) return config.Refuse(key, "finite numbers");
  }
  mjtNum needed = kGridAxes, points = 3;
  bool whole = count > kGridAxes;
  for (int i = 0; whole && i < kGridAxes; ++i) {
    whole = numbers[i] >= 1 && numbers[i] <= count && numbers[i] == std::floor(numbers[i]);
    needed += numbers[i];
    points *= numbers[i];
  }
  if (!whole || needed + points != count) {
    return config.Refuse(key,
                         "4 sizes (of t, x, y, z), the axes, and 3 velocities per point; it has " +
                             std::to_string(count) + " numbers");
  }
  int address = start + kGridAxes;
  for (int i = 0; i < kGridAxes; ++i) {
    grid->size[i] = static_cast<int>(numbers[i]);
    grid->axis[i] = address;
    const mjtNum* axis = m->numeric_data + address;
    for (int j = 1; j < grid->size[i]; ++j) {
      if (axis[j] <= axis[j - 1]) {
        return config.Refuse(key, std::string("axis ") + kAxisNames[i] + " rising strictly");
      }
    }
    address += grid->size[i];
  }
  grid->data = address;
  return true;
}

void AddGrid(const Grid& grid, const mjModel* m, mjtNum time, const mjtNum point_w[3],
             FlowSample* flow) {
  if (!grid.any()) return;
  const mjtNum at[kGridAxes] = {time, point_w[0], point_w[1], point_w[2]};
  Place place[kGridAxes];
  for (int i = 0; i < kGridAxes; ++i) {
    place[i] = Locate(m->numeric_data + grid.axis[i], grid.size[i], at[i]);
  }
  for (int corner = 0; corner < kCorners; ++corner) {
    mjtNum weight = 1, slope[kGridAxes] = {1, 1, 1, 1};
    int point = 0;
    bool used = true;
    for (int i = 0; i < kGridAxes && used; ++i) {
      const bool high = corner & (1 << i);
      used = !high || place[i].slope > 0;
      const mjtNum part = high ? place[i].share : 1 - place[i].share;
      weight *= part;
      for (int j = 0; j < kGridAxes; ++j) {
        slope[j] *= j != i ? part : high ? place[i].slope : -place[i].slope;
      }
      point = point * grid.size[i] + place[i].low + high;
    }
    if (!used) continue;
    const mjtNum* velocity = m->numeric_data + grid.data + 3 * point;
    for (int i = 0; i < 3; ++i) {
      flow->velocity[i] += weight * velocity[i];
      flow->rate[i] += slope[0] * velocity[i];
      for (int j = 0; j < 3; ++j) flow->gradient[3 * i + j] += slope[1 + j] * velocity[i];
    }
  }
}

void BeyondGrid(const Grid& grid, const mjModel* m, mjtNum time, const mjtNum point_w[3],
                mjtNum beyond[kGridAxes]) {
  const mjtNum at[kGridAxes] = {time, point_w[0], point_w[1], point_w[2]};
  for (int i = 0; i < kGridAxes; ++i) {
    const mjtNum *first = m->numeric_data + grid.axis[i], *last = first + grid.size[i] - 1;
    const mjtNum over = at[i] - std::clamp(at[i], *first, *last);
    beyond[i] = std::abs(over) <= kRounding * (*last - *first) || grid.size[i] < 2 ? 0 : over;
  }
}

}  // namespace fluid_sim
