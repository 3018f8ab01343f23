// geometry_msgs and tf2.
#pragma once

#include <array>

#include "geometry_msgs/PointStamped.h"
#include "geometry_msgs/PolygonStamped.h"
#include "geometry_msgs/Pose.h"
#include "geometry_msgs/PoseStamped.h"
#include "geometry_msgs/PoseWithCovarianceStamped.h"
#include "geometry_msgs/QuaternionStamped.h"
#include "geometry_msgs/TransformStamped.h"
#include "geometry_msgs/Vector3Stamped.h"
#include "geometry_msgs/Wrench.h"
#include "geometry_msgs/WrenchStamped.h"
#include "tf2/LinearMath/Transform.h"
#include "tf2/convert.h"

namespace tf2 {
namespace impl {
inline const ros::Time& stamp_of(const ros::Time& stamp) { return stamp; }
inline const ros::Time& stamp_for_message(const ros::Time& stamp) { return stamp; }
}  // namespace impl
}  // namespace tf2

#define GAZELLE_GEOMETRY(Name) ::geometry_msgs::Name
#define GAZELLE_STAMP const ros::Time&
#define GAZELLE_FRAME_NAME const std::string&
#include "gazelle/tf2_messages.inc"
#undef GAZELLE_FRAME_NAME
#undef GAZELLE_STAMP
#undef GAZELLE_GEOMETRY
