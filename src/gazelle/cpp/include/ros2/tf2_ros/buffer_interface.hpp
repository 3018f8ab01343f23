// What every source of transforms can do; times of messages, tf2 and rclcpp from one to another.
#pragma once

#include <chrono>
#include <string>

#include "builtin_interfaces/msg/duration.hpp"
#include "builtin_interfaces/msg/time.hpp"
#include "geometry_msgs/msg/transform_stamped.hpp"
#include "rclcpp/duration.hpp"
#include "rclcpp/time.hpp"
#include "tf2/convert.hpp"
#include "tf2/time.hpp"
#include "tf2/transform_datatypes.hpp"
#include "tf2_ros/visibility_control.h"

namespace tf2_ros {

using TransformStamped = geometry_msgs::msg::TransformStamped;

inline builtin_interfaces::msg::Time toMsg(const tf2::TimePoint& t) {
  const std::int64_t ns = t.time_since_epoch().count();
  const std::int64_t rest = ((ns % 1000000000) + 1000000000) % 1000000000;
  builtin_interfaces::msg::Time out;
  out.sec = static_cast<std::int32_t>((ns - rest) / 1000000000);
  out.nanosec = static_cast<std::uint32_t>(rest);
  return out;
}
inline tf2::TimePoint fromMsg(const builtin_interfaces::msg::Time& time_msg) {
  return tf2::TimePoint(std::chrono::seconds(time_msg.sec) +
                        std::chrono::nanoseconds(time_msg.nanosec));
}
inline builtin_interfaces::msg::Duration toMsg(const tf2::Duration& t) {
  const builtin_interfaces::msg::Time split = toMsg(tf2::TimePoint(t));
  builtin_interfaces::msg::Duration out;
  out.sec = split.sec;
  out.nanosec = split.nanosec;
  return out;
}
inline tf2::Duration fromMsg(const builtin_interfaces::msg::Duration& duration_msg) {
  return std::chrono::seconds(duration_msg.sec) + std::chrono::nanoseconds(duration_msg.nanosec);
}
inline double timeToSec(const builtin_interfaces::msg::Time& time_msg) {
  return static_cast<double>(time_msg.sec) + 1e-9 * static_cast<double>(time_msg.nanosec);
}
inline tf2::TimePoint fromRclcpp(const rclcpp::Time& time) {
  return tf2::TimePoint(std::chrono::nanoseconds(time.nanoseconds()));
}
inline rclcpp::Time toRclcpp(const tf2::TimePoint& time) {
  return rclcpp::Time(time.time_since_epoch().count());
}
inline tf2::Duration fromRclcpp(const rclcpp::Duration& duration) {
  return std::chrono::nanoseconds(duration.nanoseconds());
}
inline rclcpp::Duration toRclcpp(const tf2::Duration& duration) {
  return rclcpp::Duration::from_nanoseconds(duration.count());
}

class BufferInterface {
 public:
  virtual ~BufferInterface() = default;

  virtual TransformStamped lookupTransform(const std::string& target_frame,
                                           const std::string& source_frame,
                                           const tf2::TimePoint& time,
                                           const tf2::Duration timeout) const = 0;
  virtual TransformStamped lookupTransform(const std::string& target_frame,
                                           const tf2::TimePoint& target_time,
                                           const std::string& source_frame,
                                           const tf2::TimePoint& source_time,
                                           const std::string& fixed_frame,
                                           const tf2::Duration timeout) const = 0;
  virtual bool canTransform(const std::string& target_frame, const std::string& source_frame,
                            const tf2::TimePoint& time, const tf2::Duration timeout,
                            std::string* errstr = nullptr) const = 0;
  virtual bool canTransform(const std::string& target_frame, const tf2::TimePoint& target_time,
                            const std::string& source_frame, const tf2::TimePoint& source_time,
                            const std::string& fixed_frame, const tf2::Duration timeout,
                            std::string* errstr = nullptr) const = 0;

  template <class T>
  T& transform(const T& in, T& out, const std::string& target_frame,
               tf2::Duration timeout = tf2::Duration::zero()) const {
    tf2::doTransform(
        in, out,
        lookupTransform(target_frame, tf2::getFrameId(in), tf2::getTimestamp(in), timeout));
    return out;
  }
  template <class T>
  T transform(const T& in, const std::string& target_frame,
              tf2::Duration timeout = tf2::Duration::zero()) const {
    T out;
    return transform(in, out, target_frame, timeout);
  }
  template <class A, class B>
  B& transform(const A& in, B& out, const std::string& target_frame,
               tf2::Duration timeout = tf2::Duration::zero()) const {
    tf2::convert(transform(in, target_frame, timeout), out);
    return out;
  }

  // Between two times, by way of a frame that stands still.
  template <class T>
  T& transform(const T& in, T& out, const std::string& target_frame,
               const tf2::TimePoint& target_time, const std::string& fixed_frame,
               tf2::Duration timeout = tf2::Duration::zero()) const {
    tf2::doTransform(in, out,
                     lookupTransform(target_frame, target_time, tf2::getFrameId(in),
                                     tf2::getTimestamp(in), fixed_frame, timeout));
    return out;
  }
  template <class T>
  T transform(const T& in, const std::string& target_frame, const tf2::TimePoint& target_time,
              const std::string& fixed_frame, tf2::Duration timeout = tf2::Duration::zero()) const {
    T out;
    return transform(in, out, target_frame, target_time, fixed_frame, timeout);
  }
  template <class A, class B>
  B& transform(const A& in, B& out, const std::string& target_frame,
               const tf2::TimePoint& target_time, const std::string& fixed_frame,
               tf2::Duration timeout = tf2::Duration::zero()) const {
    tf2::convert(transform(in, target_frame, target_time, fixed_frame, timeout), out);
    return out;
  }
};

}  // namespace tf2_ros
