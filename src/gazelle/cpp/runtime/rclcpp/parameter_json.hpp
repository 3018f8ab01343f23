// Parameters as the host gives them.
#pragma once

#include "gazelle/json.hpp"
#include "rclcpp/parameter_value.hpp"

namespace rclcpp {
namespace detail {

ParameterValue value_from_json(const gazelle::Json& json);

}  // namespace detail
}  // namespace rclcpp
