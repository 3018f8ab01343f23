// Durations and points in time.
#include "rclcpp/time.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "rclcpp/duration.hpp"
#include "rclcpp/utilities.hpp"

namespace rclcpp {
namespace {

constexpr std::int64_t kBillion = 1000000000LL;

std::int64_t sum_of(std::int64_t a, std::int64_t b, const char* overflow, const char* underflow) {
  if (add_will_overflow(a, b)) throw std::overflow_error(overflow);
  if (add_will_underflow(a, b)) throw std::underflow_error(underflow);
  return a + b;
}

std::int64_t difference_of(std::int64_t a, std::int64_t b, const char* overflow,
                           const char* underflow) {
  if (sub_will_overflow(a, b)) throw std::overflow_error(overflow);
  if (sub_will_underflow(a, b)) throw std::underflow_error(underflow);
  return a - b;
}

std::int64_t scaled(std::int64_t ns, double factor) {
  if (!std::isfinite(factor)) throw std::runtime_error("abnormal scale in rclcpp::Duration");
  const auto most = static_cast<long double>(std::numeric_limits<std::int64_t>::max());
  const long double product = static_cast<long double>(ns) * static_cast<long double>(factor);
  if (product > most) throw std::overflow_error("duration scaling leads to int64_t overflow");
  if (product < -most) throw std::underflow_error("duration scaling leads to int64_t underflow");
  return static_cast<std::int64_t>(product);
}

// Seconds are rounded down, so that nanoseconds are never negative.
template <class Message>
Message split(std::int64_t ns) {
  Message message;
  std::int64_t seconds = ns / kBillion;
  std::int64_t rest = ns % kBillion;
  if (rest < 0) {
    --seconds;
    rest += kBillion;
  }
  message.sec = static_cast<std::int32_t>(seconds);
  message.nanosec = static_cast<std::uint32_t>(rest);
  return message;
}

void must_be_same_clock(const rcl_time_point_t& a, const rcl_time_point_t& b, const char* text) {
  if (a.clock_type != b.clock_type) throw std::runtime_error(text);
}

constexpr const char* kOtherClock = "can't compare times with different time sources";

}  // namespace

Duration::Duration(int32_t seconds, uint32_t nanoseconds)
    : ns_(static_cast<std::int64_t>(seconds) * kBillion + nanoseconds) {}

Duration::Duration(const builtin_interfaces::msg::Duration& message)
    : ns_(static_cast<std::int64_t>(message.sec) * kBillion + message.nanosec) {}

Duration::operator builtin_interfaces::msg::Duration() const {
  const std::int64_t most_seconds = std::numeric_limits<std::int32_t>::max();
  builtin_interfaces::msg::Duration message;
  if (ns_ / kBillion > most_seconds) {
    message.sec = std::numeric_limits<std::int32_t>::max();
    message.nanosec = std::numeric_limits<std::uint32_t>::max();
    return message;
  }
  if (ns_ / kBillion <= std::numeric_limits<std::int32_t>::min()) {
    message.sec = std::numeric_limits<std::int32_t>::min();
    message.nanosec = 0;
    return message;
  }
  return split<builtin_interfaces::msg::Duration>(ns_);
}

Duration& Duration::operator=(const builtin_interfaces::msg::Duration& message) {
  return *this = Duration(message);
}

Duration Duration::operator+(const Duration& other) const {
  return from_nanoseconds(sum_of(ns_, other.ns_, "addition leads to int64_t overflow",
                                 "addition leads to int64_t underflow"));
}
Duration& Duration::operator+=(const Duration& other) { return *this = *this + other; }
Duration Duration::operator-(const Duration& other) const {
  return from_nanoseconds(difference_of(ns_, other.ns_,
                                        "duration subtraction leads to int64_t overflow",
                                        "duration subtraction leads to int64_t underflow"));
}
Duration& Duration::operator-=(const Duration& other) { return *this = *this - other; }
Duration Duration::operator*(double factor) const { return from_nanoseconds(scaled(ns_, factor)); }
Duration& Duration::operator*=(double factor) { return *this = *this * factor; }
Duration operator*(double factor, const Duration& duration) { return duration * factor; }

Duration Duration::from_seconds(double seconds) {
  return from_nanoseconds(
      static_cast<std::int64_t>(std::llround(static_cast<long double>(seconds) * 1e9L)));
}

Duration Duration::from_rmw_time(rmw_time_t time) {
  return from_nanoseconds(rmw_time_total_nsec(time));
}

rmw_time_t Duration::to_rmw_time() const {
  if (ns_ < 0) throw std::runtime_error("rmw_time_t cannot be negative");
  rmw_time_t time;
  time.sec = static_cast<std::uint64_t>(ns_ / kBillion);
  time.nsec = static_cast<std::uint64_t>(ns_ % kBillion);
  return time;
}

Time::Time(int32_t seconds, uint32_t nanoseconds, rcl_clock_type_t clock_type)
    : point_{static_cast<std::int64_t>(seconds) * kBillion + nanoseconds, clock_type} {
  if (seconds < 0) throw std::runtime_error("cannot store a negative time point in rclcpp::Time");
}

Time::Time(const builtin_interfaces::msg::Time& message, rcl_clock_type_t clock_type)
    : Time(message.sec, message.nanosec, clock_type) {}

Time::operator builtin_interfaces::msg::Time() const {
  return split<builtin_interfaces::msg::Time>(point_.nanoseconds);
}

Time& Time::operator=(const builtin_interfaces::msg::Time& message) {
  return *this = Time(message);
}

bool Time::operator==(const Time& other) const {
  must_be_same_clock(point_, other.point_, kOtherClock);
  return point_.nanoseconds == other.point_.nanoseconds;
}
bool Time::operator!=(const Time& other) const { return !(*this == other); }
bool Time::operator<(const Time& other) const {
  must_be_same_clock(point_, other.point_, kOtherClock);
  return point_.nanoseconds < other.point_.nanoseconds;
}
bool Time::operator<=(const Time& other) const { return !(other < *this); }
bool Time::operator>(const Time& other) const { return other < *this; }
bool Time::operator>=(const Time& other) const { return !(*this < other); }

Time Time::operator+(const Duration& duration) const {
  return Time(sum_of(point_.nanoseconds, duration.nanoseconds(),
                     "addition leads to int64_t overflow", "addition leads to int64_t underflow"),
              point_.clock_type);
}
Duration Time::operator-(const Time& other) const {
  must_be_same_clock(point_, other.point_, "can't subtract times with different time sources");
  return Duration::from_nanoseconds(difference_of(point_.nanoseconds, other.point_.nanoseconds,
                                                  "time subtraction leads to int64_t overflow",
                                                  "time subtraction leads to int64_t underflow"));
}
Time Time::operator-(const Duration& duration) const {
  return Time(difference_of(point_.nanoseconds, duration.nanoseconds(),
                            "time subtraction leads to int64_t overflow",
                            "time subtraction leads to int64_t underflow"),
              point_.clock_type);
}
Time& Time::operator+=(const Duration& duration) { return *this = *this + duration; }
Time& Time::operator-=(const Duration& duration) { return *this = *this - duration; }
Time operator+(const Duration& duration, const Time& time) { return time + duration; }

builtin_interfaces::msg::Time convert_rcl_time_to_sec_nanos(
    const rcl_time_point_value_t& nanoseconds) {
  return split<builtin_interfaces::msg::Time>(nanoseconds);
}

}  // namespace rclcpp
