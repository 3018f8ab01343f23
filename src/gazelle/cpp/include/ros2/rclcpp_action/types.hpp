#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "action_msgs/msg/goal_info.hpp"
#include "action_msgs/msg/goal_status.hpp"
#include "action_msgs/msg/goal_status_array.hpp"
#include "action_msgs/srv/cancel_goal.hpp"
#include "rcl_action/types.h"
#include "rclcpp_action/visibility_control.hpp"

namespace rclcpp_action {

using GoalUUID = std::array<uint8_t, 16>;
using GoalStatus = action_msgs::msg::GoalStatus;
using GoalInfo = action_msgs::msg::GoalInfo;

RCLCPP_ACTION_PUBLIC std::string to_string(const GoalUUID& goal_id);

/// How a goal ended.
enum class ResultCode : int8_t { UNKNOWN = 0, SUCCEEDED = 4, CANCELED = 5, ABORTED = 6 };

}  // namespace rclcpp_action

namespace std {
template <>
struct less<rclcpp_action::GoalUUID> {
  bool operator()(const rclcpp_action::GoalUUID& a, const rclcpp_action::GoalUUID& b) const {
    return a < b;
  }
};

template <>
struct hash<rclcpp_action::GoalUUID> {
  size_t operator()(const rclcpp_action::GoalUUID& id) const noexcept {
    size_t result = 1469598103934665603ULL;
    for (const uint8_t byte : id) result = (result ^ byte) * 1099511628211ULL;
    return result;
  }
};
}  // namespace std
