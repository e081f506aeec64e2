// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// The other end of a socket: how it is waited for, as mavlink/sockets.py does, and what that costs.

#ifndef FLUID_SIM_EXCHANGE_PEER_H_
#define FLUID_SIM_EXCHANGE_PEER_H_

#include <cstdint>

namespace fluid_sim {

// Parts of an exchange whose processor time may be kept.
enum Part { kObserving, kWriting, kSending, kWaiting, kReceiving, kDriving, kParts };

struct Peer {
  int64_t socket;        // its file descriptor; it never blocks
  int64_t alone;         // this process may use one processor only
  int64_t quick;         // it has answered within 200 us the last time
  int64_t clocked;       // bit i: part i is clocked, which takes half a microsecond
  double spent[kParts];  // processor time of the calling thread in those so far [s]
};

// Adds what a block takes to a part of the peer's exchange.
class Clocked {
 public:
  Clocked(Peer* peer, Part part);
  ~Clocked();
  Clocked(const Clocked&) = delete;
  Clocked& operator=(const Clocked&) = delete;

 private:
  double* spent_;  // null: this part is not clocked
  double begin_ = 0.0;
};

// Return whether there is something to read within `seconds`; false, too, where a signal ends the
// wait, so that its handler can run.
bool Readable(Peer* peer, double seconds);

// What a call has found.
enum Found : int {
  kSilent,    // nothing has come
  kAnswered,  // the usual answer, which was taken
  kOther,     // something else, which the caller looks at
  kGone,      // the connection has ended
  kHeld,      // not all could be sent
  kBefore,    // something has come before the state was sent, which it is not yet
};

// What a call does.
enum Phase : int64_t { kAsk = 1, kHear = 2, kObserved = 4 };

}  // namespace fluid_sim

#endif  // FLUID_SIM_EXCHANGE_PEER_H_
