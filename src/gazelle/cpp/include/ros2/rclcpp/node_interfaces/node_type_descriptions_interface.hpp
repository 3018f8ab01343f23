#pragma once

#include "rclcpp/macros.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {
namespace node_interfaces {

class RCLCPP_PUBLIC NodeTypeDescriptionsInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeTypeDescriptionsInterface)
  virtual ~NodeTypeDescriptionsInterface() = default;
};

}  // namespace node_interfaces
}  // namespace rclcpp
