// Sends frames that never move; who comes late hears of all that this object ever sent.
#pragma once

#include <vector>

#include "geometry_msgs/TransformStamped.h"
#include "ros/ros.h"
#include "tf2_msgs/TFMessage.h"

namespace tf2_ros {

class __attribute__((visibility("default"))) StaticTransformBroadcaster {
 public:
  StaticTransformBroadcaster();
  void sendTransform(const geometry_msgs::TransformStamped& transform);
  void sendTransform(const std::vector<geometry_msgs::TransformStamped>& transforms);

 private:
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  tf2_msgs::TFMessage net_message_;
};

}  // namespace tf2_ros
