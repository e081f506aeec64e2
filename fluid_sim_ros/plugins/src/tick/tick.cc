// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// From the state to all messages that are due, as messages/state_topics.py makes them.

#include <mujoco/mujoco.h>

#include <cstdint>
#include <cstring>

#include "api/api.h"
#include "thruster/thruster.h"
#include "tick/publishing.h"

namespace fluid_sim {

// Bytes that go from one place to another.
struct Copy {
  std::uint8_t* target;
  const std::uint8_t* source;
  std::int64_t size;
};

// A number that is made from another: scale times source; where there is none, the speed of the
// rotor of `actuator` [rad/s].
struct Number {
  double* target;
  const double* source;
  double scale;
  std::int64_t actuator;
};

// One topic, and the message that it holds.
struct TickTopic {
  std::int64_t period;        // due at its multiples [ticks]
  std::int64_t needs_forces;  // of its numbers
  std::int64_t asks;          // the caller makes its numbers, or says that there is no message
  const Number* numbers;
  std::int64_t number_count;
  const Copy* copies;
  std::int64_t copy_count;
  const std::uint8_t* message;
  std::int64_t size;
  const void* publisher;   // null: not published
  std::int64_t published;  // messages so far
};

struct Tick {
  const mjModel* m;  // from here to `rows` as for fsr_observe
  const mjData* d;
  mjData* scratch;
  const int* bases;
  std::int64_t count;
  double* rows;
  std::uint8_t* stamp;  // of all messages: builtin_interfaces/Time
  TickTopic* topics;
  const std::int64_t* chosen;  // places of the wanted topics, in the order of their messages
  std::int64_t chosen_count;
  std::int64_t* made;  // places of the topics whose messages were made at this tick
  std::int64_t made_count;
  Publishing* publishing;  // null: nothing is published
  std::int64_t observed;   // of this tick: 0 nothing, 1 the motion, 2 the forces, too
};

namespace {

// Have rows that hold at this tick what a topic needs.
void Observe(Tick* t, bool forces) {
  const std::int64_t wanted = forces ? 2 : 1;
  if (t->observed >= wanted) return;
  // what was put so far is on its way while the forces are evaluated
  if (t->publishing) t->publishing->Kick();
  fsr_observe(t->m, t->d, t->scratch, t->bases, static_cast<int>(t->count), forces ? 2 : 0,
              t->rows);
  t->observed = wanted;
}

void Make(Tick* t, TickTopic* topic) {
  for (std::int64_t i = 0; i < topic->number_count; ++i) {
    const Number& number = topic->numbers[i];
    if (number.source) {
      *number.target = number.scale * *number.source;
      continue;
    }
    const Thruster* thruster = FindThruster(t->m, t->scratch, static_cast<int>(number.actuator));
    *number.target = EvaluateThruster(t->m, t->scratch, *thruster).omega;
  }
  for (std::int64_t i = 0; i < topic->copy_count; ++i) {
    const Copy& copy = topic->copies[i];
    std::memcpy(copy.target, copy.source, static_cast<std::size_t>(copy.size));
  }
  if (t->publishing && topic->publisher) {
    t->publishing->Put(topic->publisher, topic->message, static_cast<std::size_t>(topic->size));
    ++topic->published;
  }
}

}  // namespace
}  // namespace fluid_sim

using namespace fluid_sim;

// Make the messages of the chosen topics that are due at a tick, and publish them, from `place`
// among the chosen ones on; 0 begins a tick. Returns the place of a due topic that asks, with the
// rows observed as it needs them: go on there with `ready` if it has a message, or at the next
// place. Returns -1 at the end, or -2 where a message could not be published
// (fsr_publishing_fault).
FSR_API long long fsr_tick(Tick* t, long long tick, long long time_ns, long long place, int ready) {
  if (!place && !ready) {
    t->observed = t->made_count = 0;
    const std::int32_t seconds = static_cast<std::int32_t>(time_ns / 1000000000);
    const std::uint32_t rest = static_cast<std::uint32_t>(time_ns % 1000000000);
    std::memcpy(t->stamp, &seconds, sizeof seconds);
    std::memcpy(t->stamp + sizeof seconds, &rest, sizeof rest);
  }
  for (; place < t->chosen_count; ++place) {
    TickTopic* topic = t->topics + t->chosen[place];
    if (!ready) {
      if (tick % topic->period) continue;
      Observe(t, topic->needs_forces);
      if (topic->asks) return place;
    }
    ready = 0;
    Make(t, topic);
    t->made[t->made_count++] = t->chosen[place];
  }
  if (!t->publishing) return -1;
  t->publishing->Kick();
  return t->publishing->faulty() ? -2 : -1;
}
