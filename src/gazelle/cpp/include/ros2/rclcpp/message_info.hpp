#pragma once

#include "rclcpp/visibility_control.hpp"
#include "rmw/types.h"

namespace rclcpp {

/// Where a message is from and when it was sent.
class RCLCPP_PUBLIC MessageInfo {
 public:
  MessageInfo() : info_{} {}
  MessageInfo(const rmw_message_info_t& info) : info_(info) {}  // NOLINT(runtime/explicit)
  virtual ~MessageInfo() = default;
  const rmw_message_info_t& get_rmw_message_info() const { return info_; }
  rmw_message_info_t& get_rmw_message_info() { return info_; }

 private:
  rmw_message_info_t info_;
};

}  // namespace rclcpp
