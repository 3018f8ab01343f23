// A transformer that listens to /tf and /tf_static, and transforms messages.
#pragma once

#include <string>

#include "geometry_msgs/PointStamped.h"
#include "geometry_msgs/PoseStamped.h"
#include "geometry_msgs/QuaternionStamped.h"
#include "geometry_msgs/Vector3Stamped.h"
#include "ros/ros.h"
#include "sensor_msgs/PointCloud.h"
#include "tf/tf.h"
#include "tf2_ros/transform_listener.h"

namespace tf {

// The prefix of the robot's frames: the parameter tf_prefix next above; "" where there is none.
inline std::string getPrefixParam(ros::NodeHandle& nh) {
  std::string parameter, prefix;
  if (nh.searchParam("tf_prefix", parameter)) nh.getParam(parameter, prefix);
  return prefix;
}
__attribute__((visibility("default"))) std::string remap(const std::string& frame_id);

class __attribute__((visibility("default"))) TransformListener : public Transformer {
 public:
  explicit TransformListener(ros::Duration max_cache_time = ros::Duration(DEFAULT_CACHE_TIME),
                             bool spin_thread = true);
  explicit TransformListener(const ros::NodeHandle& nh,
                             ros::Duration max_cache_time = ros::Duration(DEFAULT_CACHE_TIME),
                             bool spin_thread = true);
  ~TransformListener() override;

  using Transformer::transformPoint;
  using Transformer::transformPose;
  using Transformer::transformQuaternion;
  using Transformer::transformVector;

  void transformQuaternion(const std::string& target_frame,
                           const geometry_msgs::QuaternionStamped& stamped_in,
                           geometry_msgs::QuaternionStamped& stamped_out) const;
  void transformVector(const std::string& target_frame,
                       const geometry_msgs::Vector3Stamped& stamped_in,
                       geometry_msgs::Vector3Stamped& stamped_out) const;
  void transformPoint(const std::string& target_frame,
                      const geometry_msgs::PointStamped& stamped_in,
                      geometry_msgs::PointStamped& stamped_out) const;
  void transformPose(const std::string& target_frame, const geometry_msgs::PoseStamped& stamped_in,
                     geometry_msgs::PoseStamped& stamped_out) const;
  void transformQuaternion(const std::string& target_frame, const ros::Time& target_time,
                           const geometry_msgs::QuaternionStamped& qin,
                           const std::string& fixed_frame,
                           geometry_msgs::QuaternionStamped& qout) const;
  void transformVector(const std::string& target_frame, const ros::Time& target_time,
                       const geometry_msgs::Vector3Stamped& vin, const std::string& fixed_frame,
                       geometry_msgs::Vector3Stamped& vout) const;
  void transformPoint(const std::string& target_frame, const ros::Time& target_time,
                      const geometry_msgs::PointStamped& pin, const std::string& fixed_frame,
                      geometry_msgs::PointStamped& pout) const;
  void transformPose(const std::string& target_frame, const ros::Time& target_time,
                     const geometry_msgs::PoseStamped& pin, const std::string& fixed_frame,
                     geometry_msgs::PoseStamped& pout) const;
  void transformPointCloud(const std::string& target_frame, const sensor_msgs::PointCloud& pcin,
                           sensor_msgs::PointCloud& pcout) const;
  void transformPointCloud(const std::string& target_frame, const ros::Time& target_time,
                           const sensor_msgs::PointCloud& pcin, const std::string& fixed_frame,
                           sensor_msgs::PointCloud& pcout) const;

  std::string resolve(const std::string& frame_name) {
    ros::NodeHandle own("~");
    return tf::resolve(tf::getPrefixParam(own), frame_name);
  }

 protected:
  bool ok() const override;

 private:
  ros::NodeHandle node_;
  tf2_ros::TransformListener tf2_listener_;
};

}  // namespace tf
