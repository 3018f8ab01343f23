// What the filters shared with ROS 1 are made of in ROS 2.
#pragma once

#include <message_filters/message_event.hpp>
#include <message_filters/message_traits.hpp>
#include <message_filters/parameter_adapter.hpp>
#include <rclcpp/duration.hpp>
#include <rclcpp/logging.hpp>
#include <rclcpp/time.hpp>

#include <cstdint>
#include <functional>
#include <memory>

namespace message_filters {
namespace platform {

template <class T>
using Ptr = std::shared_ptr<T>;
template <class M>
using Event = MessageEvent<M>;
template <class P>
using Adapter = ParameterAdapter<P>;
template <class S>
using Function = std::function<S>;
using Time = rclcpp::Time;
using Duration = rclcpp::Duration;
using std::static_pointer_cast;

template <class M>
Time stamp(const M& message) {
  return message_traits::TimeStamp<M>::value(message);
}
inline std::int64_t ns_of(const Time& time) { return time.nanoseconds(); }
inline std::int64_t ns_of(const Duration& span) { return span.nanoseconds(); }

inline void warn_of_bound(int topic, bool goes_back) {
  const rclcpp::Logger logger = rclcpp::get_logger("message_filters");
  if (goes_back)
    RCLCPP_WARN(logger, "Messages of type %d arrived out of order (will print only once)", topic);
  else
    RCLCPP_WARN(logger,
                "Messages of type %d arrived closer than the lower bound you provided (will print "
                "only once)",
                topic);
}

}  // namespace platform
}  // namespace message_filters
