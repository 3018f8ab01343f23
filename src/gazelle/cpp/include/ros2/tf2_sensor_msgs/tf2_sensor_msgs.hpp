// Point clouds and tf2.
#pragma once

#include <cstring>

#include "sensor_msgs/msg/point_cloud2.hpp"
#include "tf2/LinearMath/Transform.h"
#include "tf2/convert.hpp"
#include "tf2_ros/buffer_interface.hpp"

namespace tf2 {
namespace impl {
inline TimePoint cloud_stamp_of(const builtin_interfaces::msg::Time& stamp) {
  return tf2_ros::fromMsg(stamp);
}
}  // namespace impl
}  // namespace tf2

#define GAZELLE_CLOUD ::sensor_msgs::msg::PointCloud2
#define GAZELLE_TRANSFORM ::geometry_msgs::msg::TransformStamped
#define GAZELLE_STAMP TimePoint
#define GAZELLE_FRAME_NAME std::string
#include "gazelle/tf2_clouds.inc"
#undef GAZELLE_FRAME_NAME
#undef GAZELLE_STAMP
#undef GAZELLE_TRANSFORM
#undef GAZELLE_CLOUD
