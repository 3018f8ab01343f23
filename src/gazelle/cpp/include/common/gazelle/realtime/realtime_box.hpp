#pragma once

#include <functional>
#include <mutex>
#include <optional>

namespace realtime_tools {

// A value that threads put in and take out.
template <class T>
class RealtimeBox {
 public:
  explicit RealtimeBox(const T& initial = T()) : value_(initial) {}

  void set(const T& value) {
    const std::lock_guard<std::mutex> lock(mutex_);
    value_ = value;
  }
  void get(T& value) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    value = value_;
  }
  T get() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return value_;
  }
  // Those that never wait: false or nothing while another thread is at the value.
  bool trySet(const T& value) {
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) value_ = value;
    return lock.owns_lock();
  }
  std::optional<T> tryGet() const {
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    return lock.owns_lock() ? std::optional<T>(value_) : std::nullopt;
  }
  void set(const std::function<void(T&)>& change) {
    const std::lock_guard<std::mutex> lock(mutex_);
    change(value_);
  }
  void get(const std::function<void(const T&)>& look) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    look(value_);
  }

 private:
  mutable std::mutex mutex_;
  T value_;
};

template <class T>
using RealtimeThreadSafeBox = RealtimeBox<T>;

}  // namespace realtime_tools
