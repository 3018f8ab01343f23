// Sends frames that move.
#pragma once

#include <vector>

#include "geometry_msgs/TransformStamped.h"
#include "ros/ros.h"

namespace tf2_ros {

class __attribute__((visibility("default"))) TransformBroadcaster {
 public:
  TransformBroadcaster();
  void sendTransform(const geometry_msgs::TransformStamped& transform);
  void sendTransform(const std::vector<geometry_msgs::TransformStamped>& transforms);

 private:
  ros::NodeHandle node_;
  ros::Publisher publisher_;
};

}  // namespace tf2_ros
