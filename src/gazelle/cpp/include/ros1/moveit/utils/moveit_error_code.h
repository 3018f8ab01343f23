#pragma once

#include <moveit_msgs/MoveItErrorCodes.h>

namespace moveit {
namespace core {

using MoveItErrorCodesMsg = moveit_msgs::MoveItErrorCodes;

#include "gazelle/moveit/error_code.inc"

}  // namespace core
}  // namespace moveit
