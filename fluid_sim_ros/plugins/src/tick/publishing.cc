// SPDX-FileCopyrightText: 2026 fluid_sim_ros maintainers
// SPDX-License-Identifier: Apache-2.0

#include "tick/publishing.h"

#include <pthread.h>
#include <signal.h>

#include <chrono>
#include <cstring>
#include <utility>

#include "api/api.h"

namespace fluid_sim {
namespace {

// Messages begin at multiples of the size of what stands before them.
std::size_t Rounded(std::size_t size, std::size_t to) { return (size + to - 1) / to * to; }

}  // namespace

Publishing::Publishing(const Middleware& middleware, std::size_t size)
    : middleware_(middleware), ring_(Rounded(size, kHead)) {}

Publishing::~Publishing() { Stop(0); }

void Publishing::Put(const void* publisher, const std::uint8_t* data, std::size_t size) {
  if (!threaded()) {
    Send(publisher, data, size);
    return;
  }
  const std::size_t need = kHead + Rounded(size, kHead), whole = ring_.size();
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    if (!used_) first_ = 0;
    const std::size_t end = (first_ + used_) % whole, rest = whole - end;
    const std::size_t skipped = rest < need ? rest : 0;  // a message stands in one piece
    if (used_ + skipped + need <= whole) {
      if (skipped) {
        const Record gap{nullptr, rest};
        std::memcpy(ring_.data() + end, &gap, kHead);
      }
      const std::size_t place = skipped ? 0 : end;
      const Record record{publisher, size};
      std::memcpy(ring_.data() + place, &record, kHead);
      std::memcpy(ring_.data() + place + kHead, data, size);
      used_ += skipped + need;
      ++count_;
      return;
    }
    filled_.notify_one();
    if (need > whole) {
      freed_.wait(lock, [this] { return !count_; });
      lock.unlock();
      Send(publisher, data, size);
      return;
    }
    freed_.wait(lock);
  }
}

void Publishing::Kick() {
  if (!threaded()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (asleep_ && count_) {
    asleep_ = false;
    filled_.notify_one();
  }
}

void Publishing::Start() {
  if (threaded()) return;
  ending_ = abandoned_ = asleep_ = false;
  // signals are for the interpreter's main thread, whose sleep they end
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread(&Publishing::Run, this);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

int Publishing::Stop(double seconds) {
  if (!threaded()) return 0;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    ending_ = true;
    filled_.notify_one();
    freed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return !count_; });
    abandoned_ = true;
  }
  thread_.join();
  const int left = count_;
  first_ = used_ = 0;
  count_ = 0;
  return left;
}

PublishFault Publishing::TakeFault() {
  const std::lock_guard<std::mutex> lock(mutex_);
  faulty_ = false;
  return std::exchange(fault_, {0, nullptr, {}});
}

void Publishing::Run() {
  pthread_setname_np(pthread_self(), "publish");
  const std::size_t whole = ring_.size();
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    while (!count_ && !ending_) {
      asleep_ = true;
      filled_.wait(lock);
    }
    asleep_ = false;
    if (!count_ || abandoned_) return;
    Record record;
    std::memcpy(&record, ring_.data() + first_, kHead);
    if (!record.publisher) {
      used_ -= record.size;
      first_ = 0;
      continue;
    }
    const std::size_t place = first_, taken = kHead + Rounded(record.size, kHead);
    lock.unlock();
    Send(record.publisher, ring_.data() + place + kHead, record.size);
    lock.lock();
    first_ = (first_ + taken) % whole;
    used_ -= taken;
    --count_;
    if (used_ <= whole / 2 || !count_) freed_.notify_one();  // not for each, that costs more
  }
}

void Publishing::Send(const void* publisher, const std::uint8_t* data, std::size_t size) {
  const SerializedMessage message{data, size, size, {}};
  const int code = middleware_.publish(publisher, &message, nullptr);
  if (!code) return;
  const ErrorText error = middleware_.error();
  middleware_.forget_error();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (fault_.code) return;
  fault_ = {code, publisher, error.text};
  faulty_ = true;
}

}  // namespace fluid_sim

using namespace fluid_sim;

// A queue of `size` bytes to a middleware (struct Middleware); to be freed with
// fsr_publishing_free. Until fsr_publishing_start messages go out in the caller's thread.
FSR_API void* fsr_publishing(void* publish, void* error, void* forget_error, long long size) {
  Middleware middleware;
  std::memcpy(&middleware.publish, &publish, sizeof publish);
  std::memcpy(&middleware.error, &error, sizeof error);
  std::memcpy(&middleware.forget_error, &forget_error, sizeof forget_error);
  return new Publishing(middleware, static_cast<std::size_t>(size));
}

FSR_API void fsr_publishing_free(void* publishing) { delete static_cast<Publishing*>(publishing); }

FSR_API void fsr_publishing_start(void* publishing) {
  static_cast<Publishing*>(publishing)->Start();
}

FSR_API int fsr_publishing_stop(void* publishing, double seconds) {
  return static_cast<Publishing*>(publishing)->Stop(seconds);
}

// Publish one message, at once or by the thread.
FSR_API void fsr_publishing_send(void* publishing, const void* publisher, const void* data,
                                 long long size) {
  Publishing* queue = static_cast<Publishing*>(publishing);
  queue->Put(publisher, static_cast<const std::uint8_t*>(data), static_cast<std::size_t>(size));
  queue->Kick();
}

// The first fault since the last call: its code (0: none), the publisher, and `size` bytes of text.
FSR_API int fsr_publishing_fault(void* publishing, const void** publisher, char* text, int size) {
  const PublishFault fault = static_cast<Publishing*>(publishing)->TakeFault();
  *publisher = fault.publisher;
  std::strncpy(text, fault.text.c_str(), static_cast<std::size_t>(size) - 1);
  text[size - 1] = 0;
  return fault.code;
}
