// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
#include "exchange/peer.h"

#include <poll.h>

#include <cmath>
#include <ctime>

namespace fluid_sim {
namespace {

// A peer that answers within this time is waited for without sleeping [s]; see mavlink/sockets.py.
constexpr double kQuick = 200e-6;
constexpr double kNano = 1e-9;

double Now(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + kNano * static_cast<double>(now.tv_nsec);
}

bool Poll(const Peer& peer, double seconds) {
  pollfd watched{static_cast<int>(peer.socket), POLLIN, 0};
  const double whole = std::floor(seconds);
  const timespec timeout{static_cast<time_t>(whole), static_cast<long>((seconds - whole) / kNano)};
  return ppoll(&watched, 1, &timeout, nullptr) > 0;
}

}  // namespace

Clocked::Clocked(Peer* peer, Part part)
    : spent_(peer->clocked >> part & 1 ? peer->spent + part : nullptr) {
  if (spent_) begin_ = Now(CLOCK_THREAD_CPUTIME_ID);
}

Clocked::~Clocked() {
  if (spent_) *spent_ += Now(CLOCK_THREAD_CPUTIME_ID) - begin_;
}

bool Readable(Peer* peer, double seconds) {
  const Clocked clocked(peer, kWaiting);
  if (seconds <= kQuick) return Poll(*peer, std::fmax(0.0, seconds));
  const double begin = Now(CLOCK_MONOTONIC);
  while (peer->quick && Now(CLOCK_MONOTONIC) - begin < kQuick) {
    if (Poll(*peer, 0.0)) return true;
  }
  const bool found = Poll(*peer, seconds);
  peer->quick = found && !peer->alone && Now(CLOCK_MONOTONIC) - begin < kQuick;
  return found;
}

}  // namespace fluid_sim
