// What the filters shared with ROS 2 are made of in ROS 1.
#pragma once

#include <ros/console.h>
#include <ros/forwards.h>
#include <ros/message_event.h>
#include <ros/message_traits.h>
#include <ros/parameter_adapter.h>
#include <ros/time.h>

#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>
#include <cstdint>

#define GAZELLE_MESSAGE_FILTERS_BOOST 1

namespace message_filters {
namespace platform {

template <class T>
using Ptr = boost::shared_ptr<T>;
template <class M>
using Event = ros::MessageEvent<M>;
template <class P>
using Adapter = ros::ParameterAdapter<P>;
template <class S>
using Function = boost::function<S>;
using Time = ros::Time;
using Duration = ros::Duration;
using boost::static_pointer_cast;

template <class M>
Time stamp(const M& message) {
  return ros::message_traits::TimeStamp<M>::value(message);
}
inline std::int64_t ns_of(const Time& time) { return static_cast<std::int64_t>(time.toNSec()); }
inline std::int64_t ns_of(const Duration& span) { return span.toNSec(); }

inline void warn_of_bound(int topic, bool goes_back) {
  if (goes_back)
    ROS_WARN("Messages of type %d arrived out of order (will print only once)", topic);
  else
    ROS_WARN(
        "Messages of type %d arrived closer than the lower bound you provided (will print only "
        "once)",
        topic);
}

}  // namespace platform
}  // namespace message_filters
