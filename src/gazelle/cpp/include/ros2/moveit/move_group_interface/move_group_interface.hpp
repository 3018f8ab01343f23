#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gazelle/moveit/robot_model.hpp"
#include "geometry_msgs/msg/pose_stamped.hpp"
#include "moveit/utils/moveit_error_code.hpp"
#include "moveit_msgs/msg/attached_collision_object.hpp"
#include "moveit_msgs/msg/collision_object.hpp"
#include "moveit_msgs/msg/constraints.hpp"
#include "moveit_msgs/msg/motion_plan_request.hpp"
#include "moveit_msgs/msg/object_color.hpp"
#include "moveit_msgs/msg/planning_scene.hpp"
#include "moveit_msgs/msg/robot_state.hpp"
#include "moveit_msgs/msg/robot_trajectory.hpp"
#include "rclcpp/rclcpp.hpp"
#include "sensor_msgs/msg/joint_state.hpp"

namespace tf2_ros {
class Buffer;
}

namespace moveit {
namespace planning_interface {

using MoveItErrorCode = moveit::core::MoveItErrorCode;

namespace msgs {
namespace geo = ::geometry_msgs::msg;
namespace mv = ::moveit_msgs::msg;
namespace sen = ::sensor_msgs::msg;
}  // namespace msgs

#include "gazelle/moveit/move_group_core.inc"

class MoveGroupInterface : public MoveGroupCore {
 public:
  struct Options {
    Options(std::string group_name, std::string desc = ROBOT_DESCRIPTION,
            std::string move_group_namespace = "")
        : group_name_(std::move(group_name)),
          robot_description_(std::move(desc)),
          move_group_namespace_(std::move(move_group_namespace)) {}

    std::string group_name_;
    std::string robot_description_;
    moveit::core::RobotModelConstPtr robot_model_;
    std::string move_group_namespace_;
  };

  // Waits for move_group to be there; for ever where the time is negative.
  MoveGroupInterface(const rclcpp::Node::SharedPtr& node, const Options& opt,
                     const std::shared_ptr<tf2_ros::Buffer>& tf_buffer = {},
                     const rclcpp::Duration& wait_for_servers = rclcpp::Duration::from_seconds(-1));
  MoveGroupInterface(const rclcpp::Node::SharedPtr& node, const std::string& group,
                     const std::shared_ptr<tf2_ros::Buffer>& tf_buffer = {},
                     const rclcpp::Duration& wait_for_servers = rclcpp::Duration::from_seconds(-1))
      : MoveGroupInterface(node, Options(group), tf_buffer, wait_for_servers) {}

  const rclcpp::Node::SharedPtr& getNode() const { return node_; }

 private:
  rclcpp::Node::SharedPtr node_;
};

using MoveGroupInterfacePtr = std::shared_ptr<MoveGroupInterface>;
using MoveGroupInterfaceConstPtr = std::shared_ptr<const MoveGroupInterface>;

}  // namespace planning_interface
}  // namespace moveit
