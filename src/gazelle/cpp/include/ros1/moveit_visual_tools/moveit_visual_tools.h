#pragma once

#include <moveit_msgs/RobotTrajectory.h>
#include <rviz_visual_tools/rviz_visual_tools.h>

#include "gazelle/moveit/robot_model.hpp"

namespace moveit_visual_tools {

using RobotTrajectoryMsg = moveit_msgs::RobotTrajectory;

#include "gazelle/moveit/visual_tools.inc"

class MoveItVisualTools : public TrajectoryTools {
 public:
  explicit MoveItVisualTools(const std::string& base_frame,
                             const std::string& marker_topic = "/rviz_visual_tools",
                             moveit::core::RobotModelConstPtr = nullptr)
      : TrajectoryTools(base_frame, std::make_shared<rviz_visual_tools::Outlet>(ros::NodeHandle(),
                                                                                marker_topic)) {}
};

}  // namespace moveit_visual_tools
