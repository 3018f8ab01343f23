#pragma once

#include <chrono>
#include <memory>

#include "rclcpp/clock.hpp"
#include "rclcpp/duration.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

class RateBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(RateBase)
  virtual ~RateBase() = default;
  virtual bool sleep() = 0;
  virtual bool is_steady() const { return get_type() == RCL_STEADY_TIME; }
  virtual rcl_clock_type_t get_type() const = 0;
  virtual void reset() = 0;
};

/// Lets a loop turn so many times a second of a clock.
class RCLCPP_PUBLIC Rate : public RateBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(Rate)
  explicit Rate(double rate, Clock::SharedPtr clock = std::make_shared<Clock>(RCL_SYSTEM_TIME));
  explicit Rate(const Duration& period,
                Clock::SharedPtr clock = std::make_shared<Clock>(RCL_SYSTEM_TIME));
  template <class Rep, class Period>
  explicit Rate(const std::chrono::duration<Rep, Period>& period,
                Clock::SharedPtr clock = std::make_shared<Clock>(RCL_SYSTEM_TIME))
      : Rate(Duration(period), std::move(clock)) {}

  bool sleep() override;
  rcl_clock_type_t get_type() const override;
  void reset() override;
  std::chrono::nanoseconds period() const;

 private:
  Clock::SharedPtr clock_;
  Duration period_;
  Time last_interval_;
};

class RCLCPP_PUBLIC WallRate : public Rate {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(WallRate)
  explicit WallRate(double rate) : Rate(rate, std::make_shared<Clock>(RCL_STEADY_TIME)) {}
  explicit WallRate(const Duration& period)
      : Rate(period, std::make_shared<Clock>(RCL_STEADY_TIME)) {}
  template <class Rep, class Period>
  explicit WallRate(const std::chrono::duration<Rep, Period>& period)
      : Rate(Duration(period), std::make_shared<Clock>(RCL_STEADY_TIME)) {}
};

class RCLCPP_PUBLIC ROSRate : public Rate {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(ROSRate)
  explicit ROSRate(double rate) : Rate(rate, std::make_shared<Clock>(RCL_ROS_TIME)) {}
  explicit ROSRate(const Duration& period) : Rate(period, std::make_shared<Clock>(RCL_ROS_TIME)) {}
};

template <class ClockT = std::chrono::high_resolution_clock>
using GenericRate = Rate;

}  // namespace rclcpp
