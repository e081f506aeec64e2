// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "exchange/frame.h"

#include "api/api.h"

namespace fluid_sim {
namespace {

// CRC-16/MCRF4XX, one byte on.
uint16_t Next(uint16_t crc, uint8_t byte) {
  uint8_t t = static_cast<uint8_t>(byte ^ (crc & 0xFF));
  t = static_cast<uint8_t>(t ^ (t << 4));
  return static_cast<uint16_t>((crc >> 8) ^ (t << 8) ^ (t << 3) ^ (t >> 4));
}

}  // namespace

uint16_t Checksum(const uint8_t* bytes, int size, uint8_t extra) {
  uint16_t crc = 0xFFFF;
  for (int i = 0; i < size; ++i) crc = Next(crc, bytes[i]);
  return Next(crc, extra);
}

int CloseFrame(uint8_t* frame, int size, uint32_t message, uint8_t extra, uint8_t sequence,
               uint8_t system, uint8_t component) {
  while (size > 1 && frame[kHead + size - 1] == 0) --size;
  uint8_t* at = frame;
  Put<uint8_t>(&at, kMagic);
  Put<uint8_t>(&at, static_cast<uint8_t>(size));
  Put<uint16_t>(&at, 0);  // incompatible and compatible flags
  Put<uint8_t>(&at, sequence);
  Put<uint8_t>(&at, system);
  Put<uint8_t>(&at, component);
  Put<uint8_t>(&at, static_cast<uint8_t>(message));
  Put<uint16_t>(&at, static_cast<uint16_t>(message >> 8));
  at += size;
  Put<uint16_t>(&at, Checksum(frame + 1, kHead - 1 + size, extra));
  return kHead + size + kChecksum;
}

}  // namespace fluid_sim

FSR_API int fsr_checksum(const uint8_t* bytes, int size, int extra) {
  return fluid_sim::Checksum(bytes, size, static_cast<uint8_t>(extra));
}
