// Eigen and tf2.
#pragma once

#include <Eigen/Geometry>

#include "geometry_msgs/msg/point_stamped.hpp"
#include "geometry_msgs/msg/pose_stamped.hpp"
#include "geometry_msgs/msg/quaternion_stamped.hpp"
#include "geometry_msgs/msg/transform_stamped.hpp"
#include "geometry_msgs/msg/twist.hpp"
#include "tf2/convert.hpp"
#include "tf2_ros/buffer_interface.hpp"

namespace tf2 {
namespace impl {
inline TimePoint eigen_stamp_of(const builtin_interfaces::msg::Time& stamp) {
  return tf2_ros::fromMsg(stamp);
}
inline builtin_interfaces::msg::Time eigen_stamp_for_message(const TimePoint& stamp) {
  return tf2_ros::toMsg(stamp);
}
}  // namespace impl
}  // namespace tf2

#define GAZELLE_GEOMETRY(Name) ::geometry_msgs::msg::Name
#include "gazelle/tf2_eigen.inc"
#undef GAZELLE_GEOMETRY
