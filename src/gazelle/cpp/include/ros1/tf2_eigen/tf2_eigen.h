// Eigen and tf2.
#pragma once

#include <Eigen/Geometry>

#include "geometry_msgs/PointStamped.h"
#include "geometry_msgs/PoseStamped.h"
#include "geometry_msgs/QuaternionStamped.h"
#include "geometry_msgs/TransformStamped.h"
#include "geometry_msgs/Twist.h"
#include "tf2/convert.h"

namespace tf2 {
namespace impl {
inline const ros::Time& eigen_stamp_of(const ros::Time& stamp) { return stamp; }
inline const ros::Time& eigen_stamp_for_message(const ros::Time& stamp) { return stamp; }
}  // namespace impl
}  // namespace tf2

#define GAZELLE_GEOMETRY(Name) ::geometry_msgs::Name
#include "gazelle/tf2_eigen.inc"
#undef GAZELLE_GEOMETRY
