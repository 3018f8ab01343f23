#pragma once

#include "rclcpp/callback_group.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/timer.hpp"

namespace rclcpp {
namespace node_interfaces {

/// Timers of a node.
class RCLCPP_PUBLIC NodeTimersInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeTimersInterface)
  virtual ~NodeTimersInterface() = default;
  virtual void add_timer(TimerBase::SharedPtr timer, CallbackGroup::SharedPtr group) = 0;
};

}  // namespace node_interfaces
}  // namespace rclcpp
