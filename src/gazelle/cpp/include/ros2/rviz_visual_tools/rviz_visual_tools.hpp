#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "rclcpp/rclcpp.hpp"
#include "sensor_msgs/msg/joy.hpp"
#include "visualization_msgs/msg/marker_array.hpp"

namespace rviz_visual_tools {

using ColorMsg = std_msgs::msg::ColorRGBA;
using Marker = visualization_msgs::msg::Marker;
using MarkerArray = visualization_msgs::msg::MarkerArray;
using PointMsg = geometry_msgs::msg::Point;
using PoseMsg = geometry_msgs::msg::Pose;

class Outlet {
 public:
  Outlet(rclcpp::Node::SharedPtr node, const std::string& topic) : node_(std::move(node)) {
    publisher_ = node_->create_publisher<MarkerArray>(topic, 10);
    group_ = node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
    rclcpp::SubscriptionOptions options;
    options.callback_group = group_;
    buttons_ = node_->create_subscription<sensor_msgs::msg::Joy>(
        "/rviz_visual_tools_gui", 10,
        [this](sensor_msgs::msg::Joy::ConstSharedPtr joy) {
          if (joy->buttons.size() > 1 && joy->buttons[1] != 0) goes_on_ = true;
          if (joy->buttons.size() > 2 && joy->buttons[2] != 0) goes_on_ = runs_on_ = true;
        },
        options);
  }
  void publish(const MarkerArray& markers) { publisher_->publish(markers); }
  void stamp(Marker& marker) { marker.header.stamp = node_->now(); }
  void wait_for_next(const std::string& message) {
    RCLCPP_INFO(node_->get_logger(), "\033[0;32mWaiting to continue: %s\033[0m", message.c_str());
    rclcpp::executors::SingleThreadedExecutor executor;
    executor.add_callback_group(group_, node_->get_node_base_interface());
    goes_on_ = false;
    while (rclcpp::ok() && !goes_on_ && !runs_on_) {
      executor.spin_once(std::chrono::milliseconds(100));
    }
    executor.remove_callback_group(group_);
  }

 private:
  rclcpp::Node::SharedPtr node_;
  rclcpp::Publisher<MarkerArray>::SharedPtr publisher_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::Subscription<sensor_msgs::msg::Joy>::SharedPtr buttons_;
  std::atomic<bool> goes_on_{false}, runs_on_{false};
};

#include "gazelle/rviz_visual_tools/visual_tools.inc"

class RvizVisualTools : public VisualTools {
 public:
  RvizVisualTools(const std::string& base_frame, const std::string& marker_topic,
                  const rclcpp::Node::SharedPtr& node)
      : VisualTools(base_frame, std::make_shared<Outlet>(node, marker_topic)) {}
};

}  // namespace rviz_visual_tools
