#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/steady_timer_options.h>

namespace ros {

/// Calls back at a period of the steady clock until it is stopped or the last copy goes.
class ROSCPP_DECL SteadyTimer {
 public:
  SteadyTimer() {}

  void start();
  void stop();
  bool hasPending();
  bool isValid() const;
  bool hasStarted() const;
  /// A new period; by `reset` it begins now.
  void setPeriod(const WallDuration& period, bool reset = true);

  operator void*() const { return isValid() ? reinterpret_cast<void*>(1) : 0; }
  bool operator<(const SteadyTimer& other) const { return impl_ < other.impl_; }
  bool operator==(const SteadyTimer& other) const { return impl_ == other.impl_; }
  bool operator!=(const SteadyTimer& other) const { return impl_ != other.impl_; }

  class Impl;

 private:
  friend class NodeHandle;
  explicit SteadyTimer(const SteadyTimerOptions& options);

  boost::shared_ptr<Impl> impl_;
};

}  // namespace ros
