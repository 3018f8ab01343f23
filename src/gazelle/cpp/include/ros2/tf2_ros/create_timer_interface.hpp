// Timers that a buffer can be given, to end its waiting.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "rclcpp/clock.hpp"
#include "tf2/time.hpp"
#include "tf2_ros/visibility_control.h"

namespace tf2_ros {

using TimerHandle = std::uint64_t;
using TimerCallbackType = std::function<void(const TimerHandle&)>;

class TF2_ROS_PUBLIC CreateTimerInterfaceException : public std::runtime_error {
 public:
  explicit CreateTimerInterfaceException(const std::string& description)
      : std::runtime_error(description) {}
};
class TF2_ROS_PUBLIC InvalidTimerHandleException : public std::runtime_error {
 public:
  explicit InvalidTimerHandleException(const std::string& description)
      : std::runtime_error(description) {}
};

class CreateTimerInterface {
 public:
  using SharedPtr = std::shared_ptr<CreateTimerInterface>;
  using ConstSharedPtr = std::shared_ptr<const CreateTimerInterface>;
  using UniquePtr = std::unique_ptr<CreateTimerInterface>;

  virtual ~CreateTimerInterface() = default;
  virtual TimerHandle createTimer(rclcpp::Clock::SharedPtr clock, const tf2::Duration& period,
                                  TimerCallbackType callback) = 0;
  virtual void cancel(const TimerHandle& timer_handle) = 0;
  virtual void reset(const TimerHandle& timer_handle) = 0;
  virtual void remove(const TimerHandle& timer_handle) = 0;
};

}  // namespace tf2_ros
