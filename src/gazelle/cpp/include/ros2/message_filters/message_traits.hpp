// Where a message's stamp is.
#pragma once

#include <rclcpp/time.hpp>

#include <string>
#include <type_traits>
#include <utility>

namespace message_filters {
namespace message_traits {

template <typename M, typename = void>
struct HasHeader : public std::false_type {};
template <typename M>
struct HasHeader<M, std::void_t<decltype(std::declval<M>().header.stamp)>> : public std::true_type {
};

template <typename M, typename Enable = void>
struct FrameId;
template <typename M>
struct FrameId<M, std::enable_if_t<HasHeader<M>::value>> {
  static std::string* pointer(M& m) { return &m.header.frame_id; }
  static const std::string* pointer(const M& m) { return &m.header.frame_id; }
  static std::string value(const M& m) { return m.header.frame_id; }
};

template <typename M, typename Enable = void>
struct TimeStamp {
  static rclcpp::Time value(const M&) { return rclcpp::Time(0, 0, RCL_ROS_TIME); }
};
template <typename M>
struct TimeStamp<M, std::enable_if_t<HasHeader<M>::value>> {
  static rclcpp::Time value(const M& m) { return rclcpp::Time(m.header.stamp, RCL_ROS_TIME); }
};

}  // namespace message_traits
}  // namespace message_filters
