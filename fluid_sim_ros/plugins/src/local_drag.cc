#include "local_drag.h"

#include <algorithm>
#include <cmath>

#include "spatial.h"

namespace fluid_sim {
namespace {

mjtNum Square(mjtNum x) { return x * x; }
mjtNum Fourth(mjtNum x) { return Square(Square(x)); }

mjtNum BluntCoefficient(const DragEllipsoid& part, const DragOptions& options,
                        const MediumConstants& medium, mjtNum speed) {
  if (!options.brown_lawler) return part.coefficients.blunt;
  const mjtNum* r = part.semiaxes;
  const mjtNum diameter = 2.0 / 3.0 * (r[0] + r[1] + r[2]);  // as the Stokes term has it
  if (medium.viscosity <= 0) return 0.5 * 0.407;             // Re without bound
  return BrownLawlerBlunt(medium.density * speed * diameter / medium.viscosity);
}

}  // namespace

mjtNum TrueProjectedArea(const mjtNum r[3], const mjtNum v[3]) {
  const mjtNum speed = mju_norm3(v);
  if (speed <= 0) return 0;
  const mjtNum x = r[1] * r[2] * v[0], y = r[2] * r[0] * v[1], z = r[0] * r[1] * v[2];
  return kPi * std::sqrt(x * x + y * y + z * z) / speed;
}

mjtNum BrownLawlerBlunt(mjtNum reynolds) {
  if (reynolds <= 0) return 0;  // times |v|, the limit is zero
  return 0.5 * (3.6 * std::pow(reynolds, -0.319) + 0.407 * reynolds / (reynolds + 8710));
}

Resistance EllipsoidResistance(const DragEllipsoid& part, const DragOptions& options,
                               const MediumConstants& medium, const mjtNum w[3],
                               const mjtNum v[3]) {
  const mjtNum* r = part.semiaxes;
  const EllipsoidCoefficients& c = part.coefficients;
  const mjtNum longest = std::max({r[0], r[1], r[2]}), shortest = std::min({r[0], r[1], r[2]});
  const mjtNum middle = r[0] + r[1] + r[2] - longest - shortest;
  const mjtNum speed = mju_norm3(v);
  const mjtNum area = options.true_area ? TrueProjectedArea(r, v) : ProjectEllipsoid(r, v).area;
  const mjtNum area_max = kPi * longest * middle;
  const mjtNum blunt = BluntCoefficient(part, options, medium, speed);

  const mjtNum unit = 8.0 / 15.0 * kPi, inertia_max = unit * middle * Fourth(longest);
  mjtNum moment[3];
  for (int i = 0; i < 3; ++i) {
    const mjtNum swept = unit * r[i] * Fourth(std::max(r[(i + 1) % 3], r[(i + 2) % 3]));
    moment[i] = w[i] * (c.angular * swept + c.slender * (inertia_max - swept));
  }
  const mjtNum diameter = 2.0 / 3.0 * (r[0] + r[1] + r[2]);
  return {medium.density * speed * (blunt * area + c.slender * (area_max - area)),
          medium.density * mju_norm3(moment), 3 * kPi * diameter * medium.viscosity,
          kPi * diameter * diameter * diameter * medium.viscosity};
}

}  // namespace fluid_sim
