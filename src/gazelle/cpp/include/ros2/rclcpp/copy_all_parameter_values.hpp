#pragma once

#include <string>
#include <vector>

#include "rclcpp/logging.hpp"
#include "rclcpp/parameter.hpp"

namespace rclcpp {

/// Give a node all parameters of another one, those that it has already too where asked for.
template <typename NodeT1, typename NodeT2>
void copy_all_parameter_values(const NodeT1& source, const NodeT2& destination,
                               bool override_existing_params = false) {
  using rcl_interfaces::msg::ParameterDescriptor;
  for (const auto& name : source->list_parameters({}, 0).names) {
    const Parameter value = source->get_parameter(name);
    if (!destination->has_parameter(name)) {
      ParameterDescriptor descriptor = source->describe_parameters({name}).at(0);
      destination->declare_parameter(name, value.get_parameter_value(), descriptor);
    } else if (override_existing_params) {
      destination->set_parameters({value});
    }
  }
}

}  // namespace rclcpp
