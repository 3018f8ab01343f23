// Conversions between message types and others, as packages specialise and overload them.
#pragma once

#include <string>

#include "geometry_msgs/TransformStamped.h"
#include "ros/message_traits.h"
#include "tf2/exceptions.h"
#include "tf2/transform_datatypes.h"

namespace tf2 {

template <class T>
void doTransform(const T& data_in, T& data_out, const geometry_msgs::TransformStamped& transform);
template <class T>
const ros::Time& getTimestamp(const T& t);
template <class T>
const std::string& getFrameId(const T& t);

template <class P>
const ros::Time& getTimestamp(const Stamped<P>& t) {
  return t.stamp_;
}
template <class P>
const std::string& getFrameId(const Stamped<P>& t) {
  return t.frame_id_;
}

template <typename A, typename B>
B toMsg(const A& a);
template <typename A, typename B>
void fromMsg(const A&, B& b);

// A message becomes something else, something else a message, or one thing another by way of the
// message that both know. toMsg and fromMsg are looked up in the arguments' namespaces.
template <class A, class B>
void convert(const A& a, B& b) {
  constexpr bool from_message = ros::message_traits::IsMessage<A>::value;
  constexpr bool to_message = ros::message_traits::IsMessage<B>::value;
  if constexpr (from_message) {
    fromMsg(a, b);
  } else if constexpr (to_message) {
    b = toMsg(a);
  } else {
    fromMsg(toMsg(a), b);
  }
}
template <class A>
void convert(const A& a1, A& a2) {
  if (&a1 != &a2) a2 = a1;
}

}  // namespace tf2
