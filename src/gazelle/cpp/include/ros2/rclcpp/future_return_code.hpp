#pragma once

#include <iostream>
#include <string>

#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

enum class FutureReturnCode { SUCCESS, INTERRUPTED, TIMEOUT };

RCLCPP_PUBLIC std::string to_string(const FutureReturnCode& code);
RCLCPP_PUBLIC std::ostream& operator<<(std::ostream& out, const FutureReturnCode& code);

}  // namespace rclcpp
