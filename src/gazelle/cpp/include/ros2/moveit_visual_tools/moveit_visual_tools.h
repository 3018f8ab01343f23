#pragma once

#include "gazelle/moveit/robot_model.hpp"
#include "moveit_msgs/msg/robot_trajectory.hpp"
#include "rviz_visual_tools/rviz_visual_tools.hpp"

namespace moveit_visual_tools {

using RobotTrajectoryMsg = moveit_msgs::msg::RobotTrajectory;

#include "gazelle/moveit/visual_tools.inc"

class MoveItVisualTools : public TrajectoryTools {
 public:
  MoveItVisualTools(const rclcpp::Node::SharedPtr& node, const std::string& base_frame,
                    const std::string& marker_topic = "/rviz_visual_tools",
                    moveit::core::RobotModelConstPtr = nullptr)
      : TrajectoryTools(base_frame,
                        std::make_shared<rviz_visual_tools::Outlet>(node, marker_topic)) {}
};

}  // namespace moveit_visual_tools
