#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "rclcpp/parameter.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// Parameters of nodes by the nodes' names.
using ParameterMap = std::unordered_map<std::string, std::vector<Parameter>>;

/// Read a YAML file of parameters.
RCLCPP_PUBLIC ParameterMap parameter_map_from_yaml_file(const std::string& yaml_filename,
                                                        const char* node_fqn = nullptr);
RCLCPP_PUBLIC std::vector<Parameter> parameters_from_map(const ParameterMap& map,
                                                         const char* node_fqn = nullptr);

}  // namespace rclcpp
