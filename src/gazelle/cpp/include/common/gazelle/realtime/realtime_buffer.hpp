#pragma once

#include <mutex>

namespace realtime_tools {

// Hands values to a control loop, which reads the newest one without waiting: while a writer is
// at it, the reader keeps what it had.
template <class T>
class RealtimeBuffer {
 public:
  RealtimeBuffer() = default;
  RealtimeBuffer(const T& data) : current_(data), next_(data) {}  // NOLINT: as the original
  RealtimeBuffer(const RealtimeBuffer& source) { *this = source; }
  RealtimeBuffer& operator=(const RealtimeBuffer& source) {
    if (this != &source) writeFromNonRT(*source.readFromNonRT());
    return *this;
  }

  T* readFromRT() {
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (lock.owns_lock() && has_new_) {
      current_ = next_;
      has_new_ = false;
    }
    return &current_;
  }
  T* readFromNonRT() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return has_new_ ? &next_ : &current_;
  }
  void writeFromNonRT(const T& data) {
    const std::lock_guard<std::mutex> lock(mutex_);
    next_ = data;
    has_new_ = true;
  }
  void initRT(const T& data) {
    const std::lock_guard<std::mutex> lock(mutex_);
    current_ = next_ = data;
    has_new_ = false;
  }
  // A reset value is read at once; for use before the loop runs.
  void reset() {
    const std::lock_guard<std::mutex> lock(mutex_);
    current_ = next_ = T();
    has_new_ = false;
  }

 private:
  mutable std::mutex mutex_;
  mutable T current_{};
  mutable T next_{};
  bool has_new_ = false;
};

}  // namespace realtime_tools
