// Puts what is sent on /tf and /tf_static into a buffer.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "ros/callback_queue.h"
#include "ros/ros.h"
#include "tf2/buffer_core.h"
#include "tf2_msgs/TFMessage.h"
#include "tf2_ros/buffer.h"

namespace tf2_ros {

class __attribute__((visibility("default"))) TransformListener {
 public:
  explicit TransformListener(tf2::BufferCore& buffer, bool spin_thread = true,
                             ros::TransportHints transport_hints = ros::TransportHints());
  TransformListener(tf2::BufferCore& buffer, const ros::NodeHandle& nh, bool spin_thread = true,
                    ros::TransportHints transport_hints = ros::TransportHints());
  ~TransformListener();
  TransformListener(const TransformListener&) = delete;
  TransformListener& operator=(const TransformListener&) = delete;

 private:
  void listen(bool spin_thread, const ros::TransportHints& hints);
  void take(const ros::MessageEvent<tf2_msgs::TFMessage const>& event, bool is_static);

  tf2::BufferCore& buffer_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::Subscriber moving_;
  ros::Subscriber static_;
  ros::Time last_update_;
  std::atomic<bool> spins_{false};
  std::unique_ptr<std::thread> thread_;
};

}  // namespace tf2_ros
