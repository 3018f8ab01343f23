#pragma once

#include <cstdint>

#include "builtin_interfaces/msg/time.hpp"
#include "rcl/time.h"
#include "rclcpp/duration.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// A point in time of one of the clocks, in nanoseconds.
class RCLCPP_PUBLIC Time {
 public:
  Time(int32_t seconds, uint32_t nanoseconds, rcl_clock_type_t clock_type = RCL_SYSTEM_TIME);
  explicit Time(int64_t nanoseconds = 0, rcl_clock_type_t clock_type = RCL_SYSTEM_TIME)
      : point_{nanoseconds, clock_type} {}
  Time(const Time&) = default;
  Time(const builtin_interfaces::msg::Time& message,  // NOLINT(runtime/explicit)
       rcl_clock_type_t clock_type = RCL_ROS_TIME);
  explicit Time(const rcl_time_point_t& point) : point_(point) {}
  ~Time() = default;

  operator builtin_interfaces::msg::Time() const;  // NOLINT(runtime/explicit)
  Time& operator=(const Time&) = default;
  Time& operator=(const builtin_interfaces::msg::Time& message);

  bool operator==(const Time& other) const;
  bool operator!=(const Time& other) const;
  bool operator<(const Time& other) const;
  bool operator<=(const Time& other) const;
  bool operator>(const Time& other) const;
  bool operator>=(const Time& other) const;
  Time operator+(const Duration& duration) const;
  Duration operator-(const Time& other) const;
  Time operator-(const Duration& duration) const;
  Time& operator+=(const Duration& duration);
  Time& operator-=(const Duration& duration);

  rcl_time_point_value_t nanoseconds() const { return point_.nanoseconds; }
  static Time max(rcl_clock_type_t clock_type = RCL_SYSTEM_TIME) {
    return Time(std::numeric_limits<int64_t>::max(), clock_type);
  }
  double seconds() const { return static_cast<double>(point_.nanoseconds) / 1e9; }
  rcl_clock_type_t get_clock_type() const { return point_.clock_type; }

 private:
  rcl_time_point_t point_;
};

RCLCPP_PUBLIC Time operator+(const Duration& duration, const Time& time);

/// Turn a message into the time that it holds, as time of the ROS clock.
RCLCPP_PUBLIC builtin_interfaces::msg::Time convert_rcl_time_to_sec_nanos(
    const rcl_time_point_value_t& nanoseconds);

}  // namespace rclcpp
