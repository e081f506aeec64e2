// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "thruster/t200.h"

#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// Blue Robotics, "T200 Public Performance Data, 10-20 V", September 2019: full thrust at 1900 and
// 1100 us and the edges of the dead zone.
struct Supply {
  mjtNum voltage, forward, reverse, dead_low, dead_high;  // [V], [N], [N], [us], [us]
};

constexpr Supply kSupplies[] = {{10, 28.7, 22.6, 1460, 1540}, {12, 36.4, 28.6, 1464, 1536},
                                {14, 44.4, 34.5, 1468, 1532}, {16, 51.4, 39.9, 1472, 1528},
                                {18, 59.0, 45.0, 1472, 1528}, {20, 65.9, 49.4, 1476, 1528}};

// Share of the full thrust at eighths of the way from the dead zone to full command: the 14 V
// sheet (186 rows), read at these points. The same shape is taken at every voltage.
constexpr int kParts = 8;
constexpr mjtNum kForward[kParts + 1] = {0, 0.068, 0.161, 0.268, 0.389, 0.527, 0.691, 0.857, 1};
constexpr mjtNum kReverse[kParts + 1] = {0, 0.071, 0.168, 0.274, 0.398, 0.540, 0.696, 0.861, 1};
constexpr mjtNum kFullReverse = 1100, kFullForward = 1900;  // [us]

mjtNum Mix(mjtNum a, mjtNum b, mjtNum share) { return (1 - share) * a + share * b; }

}  // namespace

// 51.4 N at 3533 rpm and 39.9 N at 3465 rpm: the rows of full command at 16 V.
const mjtNum kT200Speed[2] = {51.4 / Square(3533 * kPi / 30), 39.9 / Square(3465 * kPi / 30)};

std::vector<Knot> T200Table(mjtNum voltage) {
  const Supply* high = kSupplies + 1;
  while (high->voltage < voltage) ++high;
  const Supply* low = high - 1;
  const mjtNum share = (voltage - low->voltage) / (high->voltage - low->voltage);
  const mjtNum forward = Mix(low->forward, high->forward, share);
  const mjtNum reverse = Mix(low->reverse, high->reverse, share);
  const mjtNum dead_low = Mix(low->dead_low, high->dead_low, share);
  const mjtNum dead_high = Mix(low->dead_high, high->dead_high, share);
  std::vector<Knot> table;
  for (int i = kParts; i >= 0; --i) {
    const mjtNum way = static_cast<mjtNum>(i) / kParts;
    table.push_back({Mix(dead_low, kFullReverse, way), -reverse * kReverse[i]});
  }
  for (int i = 0; i <= kParts; ++i) {
    const mjtNum way = static_cast<mjtNum>(i) / kParts;
    table.push_back({Mix(dead_high, kFullForward, way), forward * kForward[i]});
  }
  return table;
}

}  // namespace fluid_sim
