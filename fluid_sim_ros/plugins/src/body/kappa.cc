// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "body/kappa.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shared/numbers.h"
#include "shared/spatial.h"

namespace fluid_sim {
namespace {

// D_i = (kappa_k - kappa_j)/(r_j^2 - r_k^2) [1/m^2] and E_i [-] for the axis i, as integrals over
// lambda = exp(x). The trapezoidal rule converges exponentially there: the integrand is analytic
// and decays at both ends (twin of physics/kappa.py).
void DividedDifference(const mjtNum r[3], int i, double* divided, double* moment) {
  constexpr int kNodes = 801;
  constexpr double kLogBelow = 40.0, kLogAbove = 40.0;
  const double largest = std::max({r[0], r[1], r[2]});
  double square[3], product = 1;
  for (int k = 0; k < 3; ++k) {
    square[k] = (r[k] / largest) * (r[k] / largest);
    product *= r[k] / largest;
  }
  const double log_min = std::log(std::min({square[0], square[1], square[2]}));
  const double step = (kLogBelow + kLogAbove - log_min) / (kNodes - 1);
  double sum_divided = 0, sum_moment = 0;
  for (int node = 0; node < kNodes; ++node) {
    const double lambda = std::exp(log_min - kLogBelow + step * node);
    const double a = square[i] + lambda;
    const double b = square[(i + 1) % 3] + lambda, c = square[(i + 2) % 3] + lambda;
    const double weight = step * lambda / (b * c * std::sqrt(a * b * c));
    sum_divided += weight;
    sum_moment += weight * lambda;
  }
  *divided = product * sum_divided / (largest * largest);
  *moment = product * sum_moment;
}

}  // namespace

double CarlsonRd(double x, double y, double z) {
  double sum = 0, power = 1;
  // each round brings the arguments closer by a factor of four; 1000 pass all that doubles hold
  for (int round = 0; round < 1000; ++round) {
    const double mean = 0.2 * (x + y + 3 * z);
    const double dx = (mean - x) / mean, dy = (mean - y) / mean, dz = (mean - z) / mean;
    if (std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) < 1e-3) {
      // Carlson (1995), eq. 2.21-2.22: fifth order in the deviations, 1e-18 here
      const double e2 = dx * dy - 6 * dz * dz, e3 = (3 * dx * dy - 8 * dz * dz) * dz;
      const double e4 = 3 * (dx * dy - dz * dz) * dz * dz, e5 = dx * dy * dz * dz * dz;
      const double series = 1 - 3.0 / 14 * e2 + e3 / 6 + 9.0 / 88 * e2 * e2 - 3.0 / 22 * e4 -
                            9.0 / 52 * e2 * e3 + 3.0 / 26 * e5;
      return 3 * sum + power * series / (mean * std::sqrt(mean));
    }
    const double rx = std::sqrt(x), ry = std::sqrt(y), rz = std::sqrt(z);
    const double lambda = rx * ry + ry * rz + rz * rx;
    sum += power / (rz * (z + lambda));
    power *= 0.25;
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

void EllipsoidAddedMass(const mjtNum r[3], mjtNum mass[3], mjtNum inertia[3]) {
  const double product = r[0] * r[1] * r[2], volume = 4.0 / 3.0 * kPi * product;
  double kappa[3];
  for (int i = 0; i < 3; ++i) {
    const double j = r[(i + 1) % 3], k = r[(i + 2) % 3];
    kappa[i] = 2.0 / 3.0 * product * CarlsonRd(j * j, k * k, r[i] * r[i]);
  }
  for (int i = 0; i < 3; ++i) {
    const double j = r[(i + 1) % 3], k = r[(i + 2) % 3];
    const double difference = (j - k) * (j + k);
    double divided, moment;
    DividedDifference(r, i, &divided, &moment);
    mass[i] = volume * kappa[i] / (kappa[(i + 1) % 3] + kappa[(i + 2) % 3]);
    inertia[i] = volume / 5 * difference * difference * divided / (kappa[i] + 2 * moment);
  }
}

}  // namespace fluid_sim
