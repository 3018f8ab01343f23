#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "rclcpp/visibility_control.hpp"

namespace rclcpp {
namespace detail {

/// What an executor or a wait set sleeps on; whatever has work for it rings it.
class RCLCPP_PUBLIC Waker {
 public:
  Waker();
  ~Waker();
  void ring();
  std::uint64_t count() const;
  /// Sleep until it is rung after `seen` was read, or a time on the steady clock is there.
  void wait(std::uint64_t seen, std::optional<std::chrono::steady_clock::time_point> until);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Counts changes of what nodes and callback groups hold, so that executors look again.
RCLCPP_PUBLIC std::uint64_t entities_changed();
RCLCPP_PUBLIC std::uint64_t entities_version();

/// The order in which an executor runs what is ready together.
enum class WorkKind { kTimer, kSubscription, kService, kClient, kWaitable, kGuardCondition };

/// Something that gets work from outside: a subscription, a timer, a service, a client, an event.
class RCLCPP_PUBLIC Executable {
 public:
  Executable();
  virtual ~Executable();
  Executable(const Executable&) = delete;
  Executable& operator=(const Executable&) = delete;

  virtual WorkKind kind() const = 0;
  virtual bool has_work() = 0;
  /// Do one piece of work; false where there was none any more.
  virtual bool do_work() = 0;
  /// How long it takes until there is work by itself (timers).
  virtual std::optional<std::chrono::nanoseconds> time_until_work() { return std::nullopt; }

  virtual void add_waker(const std::shared_ptr<Waker>& waker);
  virtual void remove_waker(const Waker* waker);
  /// Called with the number of new pieces of work, with those that were there already at first.
  void set_on_new_work(std::function<void(std::size_t)> listener);

  bool exchange_in_use_by_wait_set_state(bool in_use) { return in_use_.exchange(in_use); }

 protected:
  /// Tell everybody who waits that there is work.
  void announce_work();

 private:
  std::mutex wakers_mutex_;
  std::vector<std::weak_ptr<Waker>> wakers_;
  std::function<void(std::size_t)> on_new_work_;
  std::size_t untold_ = 0;
  std::atomic<bool> in_use_{false};
};

}  // namespace detail
}  // namespace rclcpp
