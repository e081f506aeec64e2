// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "medium/noise.h"

#include <cmath>

#include "shared/numbers.h"

namespace fluid_sim {
namespace {

// Multipliers and key increments of Philox4x64 (Salmon et al. 2011, Random123).
constexpr std::uint64_t kMultiplier[2] = {0xD2E7470EE14C6C93ULL, 0xCA5A826395121157ULL};
constexpr std::uint64_t kIncrement[2] = {0x9E3779B97F4A7C15ULL, 0xBB67AE8584CAA73BULL};
constexpr int kRounds = 10;

struct Block {
  std::uint64_t word[4];
};

Block Philox(std::uint64_t counter, std::uint64_t key0, std::uint64_t key1) {
  Block x{{counter, 0, 0, 0}};
  for (int round = 0; round < kRounds; ++round) {
    const unsigned __int128 a = static_cast<unsigned __int128>(kMultiplier[0]) * x.word[0];
    const unsigned __int128 b = static_cast<unsigned __int128>(kMultiplier[1]) * x.word[2];
    x = {{static_cast<std::uint64_t>(b >> 64) ^ x.word[1] ^ key0, static_cast<std::uint64_t>(b),
          static_cast<std::uint64_t>(a >> 64) ^ x.word[3] ^ key1, static_cast<std::uint64_t>(a)}};
    key0 += kIncrement[0];
    key1 += kIncrement[1];
  }
  return x;
}

// In (0, 1]: the upper 53 bits.
mjtNum Uniform(std::uint64_t word) { return ((word >> 11) + 1) * 0x1p-53; }

}  // namespace

void Gaussians(std::uint64_t seed, std::uint64_t stream, std::uint64_t tick, int count,
               mjtNum* out) {
  const std::uint64_t blocks = (count + 3) / 4;
  for (int i = 0; i < count; i += 4) {
    const Block block = Philox(tick * blocks + i / 4, seed, stream);
    for (int pair = 0; pair < 2 && i + 2 * pair < count; ++pair) {
      const mjtNum radius = std::sqrt(-2 * std::log(Uniform(block.word[2 * pair])));
      const mjtNum angle = 2 * kPi * Uniform(block.word[2 * pair + 1]);
      out[i + 2 * pair] = radius * std::cos(angle);
      if (i + 2 * pair + 1 < count) out[i + 2 * pair + 1] = radius * std::sin(angle);
    }
  }
}

}  // namespace fluid_sim
