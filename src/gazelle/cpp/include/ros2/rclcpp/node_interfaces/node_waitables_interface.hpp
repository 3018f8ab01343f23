#pragma once

#include "rclcpp/callback_group.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {
namespace node_interfaces {

/// Work of other kinds of a node.
class RCLCPP_PUBLIC NodeWaitablesInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeWaitablesInterface)
  virtual ~NodeWaitablesInterface() = default;
  virtual void add_waitable(Waitable::SharedPtr waitable, CallbackGroup::SharedPtr group) = 0;
  virtual void remove_waitable(Waitable::SharedPtr waitable,
                               CallbackGroup::SharedPtr group) noexcept = 0;
};

}  // namespace node_interfaces
}  // namespace rclcpp
