#pragma once

#include "moveit_msgs/msg/move_it_error_codes.hpp"

namespace moveit {
namespace core {

using MoveItErrorCodesMsg = moveit_msgs::msg::MoveItErrorCodes;

#include "gazelle/moveit/error_code.inc"

}  // namespace core
}  // namespace moveit
