#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rviz_visual_tools {

using ColorMsg = std_msgs::ColorRGBA;
using Marker = visualization_msgs::Marker;
using MarkerArray = visualization_msgs::MarkerArray;
using PointMsg = geometry_msgs::Point;
using PoseMsg = geometry_msgs::Pose;

class Outlet {
 public:
  Outlet(ros::NodeHandle node, const std::string& topic) : node_(node) {
    publisher_ = node_.advertise<MarkerArray>(topic, 10);
    node_.setCallbackQueue(&queue_);
    buttons_ = node_.subscribe("/rviz_visual_tools_gui", 10, &Outlet::take, this);
  }
  void publish(const MarkerArray& markers) { publisher_.publish(markers); }
  void stamp(Marker& marker) { marker.header.stamp = ros::Time::now(); }
  void wait_for_next(const std::string& message) {
    ROS_INFO("\033[0;32mWaiting to continue: %s\033[0m", message.c_str());
    goes_on_ = false;
    while (ros::ok() && !goes_on_ && !runs_on_) queue_.callAvailable(ros::WallDuration(0.1));
  }

 private:
  void take(const sensor_msgs::Joy::ConstPtr& joy) {
    if (joy->buttons.size() > 1 && joy->buttons[1] != 0) goes_on_ = true;
    if (joy->buttons.size() > 2 && joy->buttons[2] != 0) goes_on_ = runs_on_ = true;
  }

  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::Publisher publisher_;
  ros::Subscriber buttons_;
  bool goes_on_ = false, runs_on_ = false;
};

#include "gazelle/rviz_visual_tools/visual_tools.inc"

class RvizVisualTools : public VisualTools {
 public:
  explicit RvizVisualTools(const std::string& base_frame,
                           const std::string& marker_topic = "/rviz_visual_tools",
                           ros::NodeHandle node = ros::NodeHandle("~"))
      : VisualTools(base_frame, std::make_shared<Outlet>(node, marker_topic)) {}
};

}  // namespace rviz_visual_tools
