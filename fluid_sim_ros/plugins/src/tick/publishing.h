// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0
// Messages handed to a middleware, by the thread that has them or by one of its own.

#ifndef FLUID_SIM_TICK_PUBLISHING_H_
#define FLUID_SIM_TICK_PUBLISHING_H_

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace fluid_sim {

// rcl_serialized_message_t (rcutils/types/uint8_array.h); only read by the middleware.
struct SerializedMessage {
  const std::uint8_t* buffer;
  std::size_t length, capacity;
  void* allocator[5];
};

// rcutils_error_string_t (rcutils/error_handling.h).
struct ErrorText {
  char text[1024];
};

// What publishes: rcl_publish_serialized_message, rcutils_get_error_string, rcutils_reset_error.
struct Middleware {
  int (*publish)(const void* publisher, const SerializedMessage* message, void* allocation);
  ErrorText (*error)();
  void (*forget_error)();
};

// Why a message was not published.
struct PublishFault {
  int code;  // of the middleware; 0: there was none
  const void* publisher;
  std::string text;
};

// One thread calls all of this. Messages go out in the order in which they were put, by that thread
// or by one of their own: then they wait in a ring of bytes. Who puts a message waits while there
// is no room for it; one that is larger than the ring goes out when all others have.
class Publishing {
 public:
  // `size` of the ring in bytes.
  Publishing(const Middleware& middleware, std::size_t size);
  ~Publishing();

  // Publish, or put into the queue where there is a thread; it is woken by Kick.
  void Put(const void* publisher, const std::uint8_t* data, std::size_t size);
  void Kick();

  void Start();
  // End the thread when the queue is empty, or after `seconds`. Returns how many messages were
  // left out then.
  int Stop(double seconds);
  bool threaded() const { return thread_.joinable(); }

  bool faulty() const { return faulty_; }
  // The first fault since the last call.
  PublishFault TakeFault();

 private:
  struct Record {  // what stands before each message in the ring
    const void* publisher;
    std::size_t size;  // of the message; where `publisher` is null, of the unused rest
  };
  static constexpr std::size_t kHead = sizeof(Record);

  void Run();
  void Send(const void* publisher, const std::uint8_t* data, std::size_t size);

  const Middleware middleware_;
  std::vector<std::uint8_t> ring_;
  std::size_t first_ = 0, used_ = 0;  // oldest byte, and bytes in the queue
  int count_ = 0;                     // messages in the queue
  bool asleep_ = false, ending_ = false, abandoned_ = false;
  std::atomic<bool> faulty_{false};
  std::mutex mutex_;
  std::condition_variable filled_, freed_;
  std::thread thread_;
  PublishFault fault_{0, nullptr, {}};
};

}  // namespace fluid_sim

#endif  // FLUID_SIM_TICK_PUBLISHING_H_
