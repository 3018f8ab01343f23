#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <moveit/utils/moveit_error_code.h>
#include <moveit_msgs/AttachedCollisionObject.h>
#include <moveit_msgs/CollisionObject.h>
#include <moveit_msgs/Constraints.h>
#include <moveit_msgs/MotionPlanRequest.h>
#include <moveit_msgs/ObjectColor.h>
#include <moveit_msgs/PlanningScene.h>
#include <moveit_msgs/RobotState.h>
#include <moveit_msgs/RobotTrajectory.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gazelle/moveit/robot_model.hpp"

namespace tf2_ros {
class Buffer;
}

namespace moveit {
namespace planning_interface {

using MoveItErrorCode = moveit::core::MoveItErrorCode;

namespace msgs {
namespace geo = ::geometry_msgs;
namespace mv = ::moveit_msgs;
namespace sen = ::sensor_msgs;
}  // namespace msgs

#include "gazelle/moveit/move_group_core.inc"

class MoveGroupInterface : public MoveGroupCore {
 public:
  struct Options {
    Options(std::string group_name, std::string desc = ROBOT_DESCRIPTION,
            const ros::NodeHandle& node_handle = ros::NodeHandle())
        : group_name_(std::move(group_name)),
          robot_description_(std::move(desc)),
          node_handle_(node_handle) {}

    std::string group_name_;
    std::string robot_description_;
    moveit::core::RobotModelConstPtr robot_model_;
    ros::NodeHandle node_handle_;
  };

  // Waits for move_group to be there; for ever where no time is given.
  MoveGroupInterface(const Options& opt, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer = {},
                     const ros::WallDuration& wait_for_servers = ros::WallDuration());
  MoveGroupInterface(const std::string& group,
                     const std::shared_ptr<tf2_ros::Buffer>& tf_buffer = {},
                     const ros::WallDuration& wait_for_servers = ros::WallDuration())
      : MoveGroupInterface(Options(group), tf_buffer, wait_for_servers) {}

  const ros::NodeHandle& getNodeHandle() const { return node_handle_; }

 private:
  ros::NodeHandle node_handle_;
};

// The name of before Kinetic.
using MoveGroup = MoveGroupInterface;
using MoveGroupInterfacePtr = std::shared_ptr<MoveGroupInterface>;
using MoveGroupInterfaceConstPtr = std::shared_ptr<const MoveGroupInterface>;

}  // namespace planning_interface
}  // namespace moveit
