// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// One usual exchange with PX4 in one call: the sensors go out, and their answer comes in one piece.
//
// Whatever else happens goes back to mavlink/px4/bridge.py, with the bytes that have come.

#include <sys/socket.h>

#include <cerrno>

#include "api/api.h"
#include "exchange/battery.h"
#include "exchange/observer.h"
#include "exchange/outputs.h"
#include "exchange/peer.h"
#include "exchange/px4.h"

namespace fluid_sim {

constexpr int kPortion = 65536;  // largest that is read at once [bytes]

struct Px4Exchange {
  Observer observer;
  Px4Sensors* sensors;
  Driven* driven;
  Battery* battery;           // null: none
  double period;              // of exchanges [s]
  int64_t system, component;  // MAVLink ids of the simulator
  Peer peer;
  int64_t frame_size, sent;  // of the last HIL_SENSOR, and how much went out of it and the others
  int64_t size;              // of what has come
  Px4Answer answer;          // the last one
  uint8_t frame[kLongestFrame], portion[kPortion];
};

namespace {

// Returns the size of the frame, or what WriteSensors needs first.
int WriteFrame(Px4Exchange* x, int64_t phases, int64_t tick, uint64_t time_us, int number) {
  if (!(phases & kObserved)) {
    const Clocked clocked(&x->peer, kObserving);
    Observe(x->observer);
  }
  const Clocked clocked(&x->peer, kWriting);
  const int size = WriteSensors(x->sensors, tick, time_us, number, static_cast<int>(x->system),
                                static_cast<int>(x->component), x->frame);
  if (size > 0 && x->battery) Draw(x->battery, x->driven->commands, x->period);
  return size;
}

Found Send(Px4Exchange* x, int size, const uint8_t* others, int64_t others_size) {
  const Clocked clocked(&x->peer, kSending);
  x->frame_size = size;
  iovec parts[] = {{x->frame, static_cast<size_t>(size)},
                   {const_cast<uint8_t*>(others), static_cast<size_t>(others_size)}};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = others_size ? 2 : 1;
  const ssize_t sent =
      sendmsg(static_cast<int>(x->peer.socket), &message, MSG_DONTWAIT | MSG_NOSIGNAL);
  x->sent = sent < 0 ? 0 : sent;
  if (sent < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) return kGone;
  return x->sent == size + others_size ? kAnswered : kHeld;
}

Found Hear(Px4Exchange* x, uint64_t time_us, double patience) {
  if (!Readable(&x->peer, patience)) return kSilent;
  ssize_t size;
  {
    const Clocked clocked(&x->peer, kReceiving);
    size = recv(static_cast<int>(x->peer.socket), x->portion, kPortion, MSG_DONTWAIT);
  }
  if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return kSilent;
  if (size <= 0) return kGone;
  const Clocked clocked(&x->peer, kDriving);
  x->size = size;
  Driven* driven = x->driven;
  if (!ReadAnswer(x->portion, size, &x->answer) || x->answer.time_us != time_us) return kOther;
  driven->known = kPx4Outputs;
  for (int i = 0; i < kPx4Outputs; ++i) driven->outputs[i] = x->answer.controls[i];
  return Drive(driven) ? kAnswered : kOther;
}

}  // namespace
}  // namespace fluid_sim

using namespace fluid_sim;

// Ask PX4 and hear it, or one of both (`phases`, kObserved: the caller has observed): HIL_SENSOR of
// `tick`, numbered `number`, and `others` go out at `time_us`, and their answer is waited for for
// `patience` [s]. Returns a Found, or -1 - i where instrument i first needs its noise; then nothing
// was sent.
FSR_API int fsr_px4_exchange(Px4Exchange* x, int64_t phases, int64_t tick, uint64_t time_us,
                             int number, const uint8_t* others, int64_t others_size,
                             double patience) {
  if (phases & kAsk) {
    const int size = WriteFrame(x, phases, tick, time_us, number);
    if (size < 0) return size;
    const Found found = Send(x, size, others, others_size);
    if (found != kAnswered) return found;
  }
  return phases & kHear ? Hear(x, time_us, patience) : kAnswered;
}
