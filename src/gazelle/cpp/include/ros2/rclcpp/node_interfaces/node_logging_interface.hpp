#pragma once

#include "rclcpp/logger.hpp"
#include "rclcpp/macros.hpp"

namespace rclcpp {
namespace node_interfaces {

class RCLCPP_PUBLIC NodeLoggingInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeLoggingInterface)
  virtual ~NodeLoggingInterface() = default;
  virtual Logger get_logger() const = 0;
  virtual const char* get_logger_name() const = 0;
};

}  // namespace node_interfaces
}  // namespace rclcpp
