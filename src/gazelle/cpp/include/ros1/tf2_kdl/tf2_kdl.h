// KDL and tf2.
#pragma once

#include "geometry_msgs/PointStamped.h"
#include "geometry_msgs/PoseStamped.h"
#include "geometry_msgs/TransformStamped.h"
#include "geometry_msgs/TwistStamped.h"
#include "geometry_msgs/WrenchStamped.h"
#include "kdl/frames.hpp"
#include "tf2/convert.h"

namespace tf2 {
namespace impl {
inline const ros::Time& kdl_stamp_of(const ros::Time& stamp) { return stamp; }
inline const ros::Time& kdl_stamp_for_message(const ros::Time& stamp) { return stamp; }
}  // namespace impl
}  // namespace tf2

#define GAZELLE_GEOMETRY(Name) ::geometry_msgs::Name
#include "gazelle/tf2_kdl.inc"
#undef GAZELLE_GEOMETRY
