#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

#include "builtin_interfaces/msg/duration.hpp"
#include "rcl/time.h"
#include "rclcpp/visibility_control.hpp"
#include "rmw/types.h"

namespace rclcpp {

/// A signed span of time in nanoseconds.
class RCLCPP_PUBLIC Duration {
 public:
  Duration() = default;
  Duration(int32_t seconds, uint32_t nanoseconds);
  explicit Duration(std::chrono::nanoseconds nanoseconds) : ns_(nanoseconds.count()) {}
  template <class Rep, class Period>
  Duration(const std::chrono::duration<Rep, Period>& duration)  // NOLINT(runtime/explicit)
      : ns_(std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count()) {}
  Duration(const builtin_interfaces::msg::Duration& message);  // NOLINT(runtime/explicit)
  explicit Duration(const rcl_duration_t& duration) : ns_(duration.nanoseconds) {}
  Duration(const Duration&) = default;
  ~Duration() = default;

  operator builtin_interfaces::msg::Duration() const;  // NOLINT(runtime/explicit)
  Duration& operator=(const Duration&) = default;
  Duration& operator=(const builtin_interfaces::msg::Duration& message);

  bool operator==(const Duration& other) const { return ns_ == other.ns_; }
  bool operator!=(const Duration& other) const { return ns_ != other.ns_; }
  bool operator<(const Duration& other) const { return ns_ < other.ns_; }
  bool operator<=(const Duration& other) const { return ns_ <= other.ns_; }
  bool operator>(const Duration& other) const { return ns_ > other.ns_; }
  bool operator>=(const Duration& other) const { return ns_ >= other.ns_; }
  Duration operator+(const Duration& other) const;
  Duration& operator+=(const Duration& other);
  Duration operator-(const Duration& other) const;
  Duration& operator-=(const Duration& other);
  Duration operator-() const { return from_nanoseconds(-ns_); }
  Duration operator*(double factor) const;
  Duration& operator*=(double factor);

  static Duration max() { return from_nanoseconds(std::numeric_limits<int64_t>::max()); }
  rcl_duration_value_t nanoseconds() const { return ns_; }
  double seconds() const { return static_cast<double>(ns_) / 1e9; }
  static Duration from_seconds(double seconds);
  static Duration from_nanoseconds(rcl_duration_value_t nanoseconds) {
    Duration made;
    made.ns_ = nanoseconds;
    return made;
  }
  static Duration from_rmw_time(rmw_time_t time);
  template <class DurationT>
  DurationT to_chrono() const {
    return std::chrono::duration_cast<DurationT>(std::chrono::nanoseconds(ns_));
  }
  rmw_time_t to_rmw_time() const;

 private:
  rcl_duration_value_t ns_ = 0;
};

RCLCPP_PUBLIC Duration operator*(double factor, const Duration& duration);

}  // namespace rclcpp
