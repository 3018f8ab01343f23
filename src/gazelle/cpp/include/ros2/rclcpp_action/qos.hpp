#pragma once

#include "rcl_action/types.h"
#include "rclcpp/qos.hpp"

namespace rclcpp_action {

class DefaultActionStatusQoS : public rclcpp::QoS {
 public:
  DefaultActionStatusQoS() : rclcpp::QoS(1) { reliable().transient_local(); }
};

}  // namespace rclcpp_action
