// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Whole frames of MAVLink 2; https://mavlink.io/en/guide/serialization.html

#ifndef FLUID_SIM_EXCHANGE_FRAME_H_
#define FLUID_SIM_EXCHANGE_FRAME_H_

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace fluid_sim {

constexpr uint8_t kMagic = 0xFD;
constexpr int kHead = 10, kChecksum = 2;

// Checksum of `size` bytes and of `extra`, the byte that stands for a message's definition.
uint16_t Checksum(const uint8_t* bytes, int size, uint8_t extra);

// Write head and checksum around the payload of `size` bytes that stands at frame + kHead, without
// its trailing zeros. Returns the size of the frame.
int CloseFrame(uint8_t* frame, int size, uint32_t message, uint8_t extra, uint8_t sequence,
               uint8_t system, uint8_t component);

// Copy a value to the little-endian bytes at `*at`, which moves on. (MuJoCo's processors are
// little-endian.)
template <typename T>
void Put(uint8_t** at, T value) {
  std::memcpy(*at, &value, sizeof value);
  *at += sizeof value;
}

template <typename T>
T Get(const uint8_t** at) {
  T value;
  std::memcpy(&value, *at, sizeof value);
  *at += sizeof value;
  return value;
}

}  // namespace fluid_sim

#endif  // FLUID_SIM_EXCHANGE_FRAME_H_
