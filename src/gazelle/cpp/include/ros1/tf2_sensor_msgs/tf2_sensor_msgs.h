// Point clouds and tf2.
#pragma once

#include <cstring>

#include "sensor_msgs/PointCloud2.h"
#include "tf2/LinearMath/Transform.h"
#include "tf2/convert.h"

namespace tf2 {
namespace impl {
inline const ros::Time& cloud_stamp_of(const ros::Time& stamp) { return stamp; }
}  // namespace impl
}  // namespace tf2

#define GAZELLE_CLOUD ::sensor_msgs::PointCloud2
#define GAZELLE_TRANSFORM ::geometry_msgs::TransformStamped
#define GAZELLE_STAMP const ros::Time&
#define GAZELLE_FRAME_NAME const std::string&
#include "gazelle/tf2_clouds.inc"
#undef GAZELLE_FRAME_NAME
#undef GAZELLE_STAMP
#undef GAZELLE_TRANSFORM
#undef GAZELLE_CLOUD
