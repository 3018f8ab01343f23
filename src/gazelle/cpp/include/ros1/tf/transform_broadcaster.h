// Sends frames that move.
#pragma once

#include <vector>

#include "tf/tf.h"
#include "tf2_ros/transform_broadcaster.h"

namespace tf {

class __attribute__((visibility("default"))) TransformBroadcaster {
 public:
  TransformBroadcaster();
  void sendTransform(const StampedTransform& transform);
  void sendTransform(const std::vector<StampedTransform>& transforms);
  void sendTransform(const geometry_msgs::TransformStamped& transform);
  void sendTransform(const std::vector<geometry_msgs::TransformStamped>& transforms);

 private:
  tf2_ros::TransformBroadcaster tf2_broadcaster_;
};

}  // namespace tf
