// geometry_msgs and tf2.
#pragma once

#include <array>

#include "geometry_msgs/msg/point32.hpp"
#include "geometry_msgs/msg/point_stamped.hpp"
#include "geometry_msgs/msg/polygon_stamped.hpp"
#include "geometry_msgs/msg/pose_stamped.hpp"
#include "geometry_msgs/msg/pose_with_covariance_stamped.hpp"
#include "geometry_msgs/msg/quaternion_stamped.hpp"
#include "geometry_msgs/msg/transform_stamped.hpp"
#include "geometry_msgs/msg/vector3_stamped.hpp"
#include "geometry_msgs/msg/velocity_stamped.hpp"
#include "geometry_msgs/msg/wrench_stamped.hpp"
#include "tf2/LinearMath/Transform.h"
#include "tf2/convert.hpp"
#include "tf2_ros/buffer_interface.hpp"

namespace tf2 {
namespace impl {
inline TimePoint stamp_of(const builtin_interfaces::msg::Time& stamp) {
  return tf2_ros::fromMsg(stamp);
}
inline builtin_interfaces::msg::Time stamp_for_message(const TimePoint& stamp) {
  return tf2_ros::toMsg(stamp);
}
}  // namespace impl
}  // namespace tf2

#define GAZELLE_GEOMETRY(Name) ::geometry_msgs::msg::Name
#define GAZELLE_STAMP TimePoint
#define GAZELLE_FRAME_NAME std::string
#include "gazelle/tf2_messages.inc"
#undef GAZELLE_FRAME_NAME
#undef GAZELLE_STAMP
#undef GAZELLE_GEOMETRY

namespace tf2 {

template <>
inline std::array<std::array<double, 6>, 6> getCovarianceMatrix(
    const geometry_msgs::msg::PoseWithCovariance& t) {
  return covarianceRowMajorToNested(t.covariance);
}
template <>
inline std::array<std::array<double, 6>, 6> getCovarianceMatrix(
    const geometry_msgs::msg::PoseWithCovarianceStamped& t) {
  return covarianceRowMajorToNested(t.pose.covariance);
}
inline geometry_msgs::msg::PoseWithCovarianceStamped toMsg(
    const WithCovarianceStamped<Transform>& in) {
  geometry_msgs::msg::PoseWithCovarianceStamped out;
  out.header.stamp = tf2_ros::toMsg(in.stamp_);
  out.header.frame_id = in.frame_id_;
  toMsg(static_cast<const Transform&>(in), out.pose.pose);
  out.pose.covariance = covarianceNestedToRowMajor(in.cov_mat_);
  return out;
}
inline void fromMsg(const geometry_msgs::msg::PoseWithCovarianceStamped& in,
                    WithCovarianceStamped<Transform>& out) {
  impl::header_from_message(in, out);
  out.cov_mat_ = covarianceRowMajorToNested(in.pose.covariance);
  Transform pose;
  fromMsg(in.pose.pose, pose);
  out.setData(pose);
}
// The velocity of the same body, in other axes and for the other frame's origin.
template <>
inline void doTransform(const geometry_msgs::msg::VelocityStamped& t_in,
                        geometry_msgs::msg::VelocityStamped& t_out,
                        const geometry_msgs::msg::TransformStamped& transform) {
  const Transform outer = impl::transform_of(transform);
  Vector3 linear, angular;
  fromMsg(t_in.velocity.linear, linear);
  fromMsg(t_in.velocity.angular, angular);
  angular = outer.getBasis() * angular;
  linear = outer.getBasis() * linear + outer.getOrigin().cross(angular);
  const std::string body = t_in.body_frame_id, reference = t_in.reference_frame_id;
  t_out.header = transform.header;
  t_out.body_frame_id = body;
  t_out.reference_frame_id = reference;
  t_out.velocity.linear = toMsg(linear);
  t_out.velocity.angular = toMsg(angular);
}

}  // namespace tf2
