#pragma once

#include <string>

#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// The global name that a name means in a node; throws where it is not valid.
RCLCPP_PUBLIC std::string expand_topic_or_service_name(const std::string& name,
                                                       const std::string& node_name,
                                                       const std::string& namespace_,
                                                       bool is_service = false);

/// The same name below a node's sub-namespace.
RCLCPP_PUBLIC std::string extend_name_with_sub_namespace(const std::string& name,
                                                         const std::string& sub_namespace);

}  // namespace rclcpp
