// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// One usual exchange with ArduPilot in one call: the reply goes out, and the packet of the next
// frame comes.
//
// Whatever else happens goes back to mavlink/ardupilot/bridge.py, with the datagram that has come.

#include <sys/socket.h>

#include <cstring>

#include "api/api.h"
#include "exchange/ardupilot.h"
#include "exchange/battery.h"
#include "exchange/frame.h"
#include "exchange/observer.h"
#include "exchange/outputs.h"
#include "exchange/peer.h"

namespace fluid_sim {

// A servo packet: magic, rate [Hz], count, 16 or 32 pulses [us]; see json_packets.py.
constexpr int kPacketHead = 8, kLongestPacket = kPacketHead + 2 * kMostOutputs;
constexpr int kShortMagic = 18458, kLongMagic = 29569, kShort = 16;

struct Sender {
  int64_t size;
  uint8_t address[128];  // sockaddr_storage
};

struct ArduPilotExchange {
  Observer observer;
  ArduPilotState* state;
  Driven* driven;
  Battery* battery;    // null: none
  int64_t rate;        // frames per second of the present one [Hz]
  double seconds;      // that one lasts [s]
  int64_t reply_size;  // of the last reply
  int64_t size;        // of what has come; longest + 1: it is longer than any packet
  Peer peer;
  Sender autopilot, sender;  // who is answered, and who sent what has come
  char reply[kLongestReply];
  uint8_t packet[kLongestPacket + 1];
};

namespace {

// Returns the size of the reply, or what WriteReply needs first.
int Write(ArduPilotExchange* x, int64_t phases, int64_t tick, double time_s) {
  if (!(phases & kObserved)) {
    const Clocked clocked(&x->peer, kObserving);
    Observe(x->observer);
  }
  const Clocked clocked(&x->peer, kWriting);
  if (x->battery) {
    x->state->voltage = x->battery->voltage;
    x->state->current = x->battery->current;
  }
  return WriteReply(x->state, tick, time_s, x->reply, kLongestReply);
}

bool Receive(ArduPilotExchange* x) {
  const Clocked clocked(&x->peer, kReceiving);
  socklen_t size = sizeof x->sender.address;
  const ssize_t got = recvfrom(static_cast<int>(x->peer.socket), x->packet, sizeof x->packet,
                               MSG_DONTWAIT, reinterpret_cast<sockaddr*>(x->sender.address), &size);
  if (got < 0) return false;  // nothing, or an earlier reply found nobody (ICMP)
  x->sender.size = size;
  x->size = got;
  return true;
}

bool IsOfAutopilot(const ArduPilotExchange& x) {
  return x.sender.size == x.autopilot.size &&
         !std::memcmp(x.sender.address, x.autopilot.address, x.sender.size);
}

// Take the packet that begins frame `count`, at the rate of the one before; returns whether it is.
bool Take(ArduPilotExchange* x, int64_t count) {
  const Clocked clocked(&x->peer, kDriving);
  if (x->size < kPacketHead || x->size > kLongestPacket || !IsOfAutopilot(*x)) return false;
  const uint8_t* at = x->packet;
  const int magic = Get<uint16_t>(&at);
  const int64_t rate = Get<uint16_t>(&at), number = Get<uint32_t>(&at);
  if ((magic != kShortMagic && magic != kLongMagic) || rate != x->rate || number != count) {
    return false;
  }
  const int pulses = magic == kShortMagic ? kShort : kMostOutputs;
  if (x->size != kPacketHead + 2 * pulses) return false;
  Driven* driven = x->driven;
  driven->known = pulses;
  for (int i = 0; i < pulses; ++i) driven->outputs[i] = Get<uint16_t>(&at);
  if (!Drive(driven)) return false;
  if (x->battery) Draw(x->battery, driven->commands, x->seconds);
  return true;
}

}  // namespace
}  // namespace fluid_sim

using namespace fluid_sim;

// Note whom the socket is connected to, which is who is answered; returns whether there is one.
FSR_API int fsr_ardupilot_connected(ArduPilotExchange* x) {
  socklen_t size = sizeof x->autopilot.address;
  const bool connected = !getpeername(static_cast<int>(x->peer.socket),
                                      reinterpret_cast<sockaddr*>(x->autopilot.address), &size);
  x->autopilot.size = connected ? size : 0;
  return connected;
}

// Ask ArduPilot and hear it, or one of both (`phases`, kObserved: the caller has observed): the
// state of `tick` at `time_s` by its clock goes out, and the packet of frame `count` is waited for
// for `patience` [s]. Returns a Found, or -1 - i where instrument i first needs its noise; then
// nothing was sent.
FSR_API int fsr_ardupilot_exchange(ArduPilotExchange* x, int64_t phases, int64_t tick,
                                   double time_s, int64_t count, double patience) {
  if (phases & kAsk) {
    const int size = Write(x, phases, tick, time_s);
    if (size < 0) return size;
    x->reply_size = size;
    if (Receive(x)) return kBefore;  // it has asked again meanwhile
    const Clocked clocked(&x->peer, kSending);
    // nobody there is no error
    send(static_cast<int>(x->peer.socket), x->reply, size, MSG_DONTWAIT | MSG_NOSIGNAL);
  }
  if (!(phases & kHear)) return kAnswered;
  if (!Readable(&x->peer, patience) || !Receive(x)) return kSilent;
  return Take(x, count) ? kAnswered : kOther;
}
