#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rclcpp/visibility_control.hpp"

namespace gazelle {
class GraphNode;
}

namespace rclcpp {
namespace detail {

/// Take `--log-level` and its like from a command line.
RCLCPP_PUBLIC void use_log_arguments(const std::vector<std::string>& words);
/// Let what is said under a name, and below it, go out on a node's /rosout.
RCLCPP_PUBLIC void attach_logger(const std::string& name,
                                 const std::shared_ptr<gazelle::GraphNode>& node);

}  // namespace detail
}  // namespace rclcpp
