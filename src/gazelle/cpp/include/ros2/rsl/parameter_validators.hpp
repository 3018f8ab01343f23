// What generate_parameter_library's YAML files may ask of a parameter's value.
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include <rcl_interfaces/msg/set_parameters_result.hpp>
#include <rclcpp/parameter.hpp>
#include <tl_expected/expected.hpp>

namespace rsl {

using Checked = tl::expected<void, std::string>;

namespace detail {

template <class T>
void show(std::ostream& out, const T& value) {
  out << value;
}
template <class T>
void show(std::ostream& out, const std::vector<T>& values) {
  out << '[';
  for (std::size_t i = 0; i < values.size(); ++i) {
    out << (i == 0 ? "" : ", ") << values[i];
  }
  out << ']';
}

template <class... Words>
Checked refused(const rclcpp::Parameter& parameter, const Words&... words) {
  std::ostringstream out;
  out << "Parameter '" << parameter.get_name() << "' ";
  (show(out, words), ...);
  return tl::make_unexpected(out.str());
}

template <class T>
std::vector<T> elements(const rclcpp::Parameter& parameter) {
  return parameter.get_value<std::vector<T>>();
}

// Letters of a text, values of an array.
template <class T>
std::size_t length(const rclcpp::Parameter& parameter) {
  if constexpr (std::is_same<T, std::string>::value) {
    if (parameter.get_type() == rclcpp::ParameterType::PARAMETER_STRING) {
      return parameter.as_string().size();
    }
  }
  return elements<T>(parameter).size();
}

template <class T, class Fails>
Checked each(const rclcpp::Parameter& parameter, Fails&& fails) {
  for (const auto value : elements<T>(parameter)) {
    if (Checked checked = fails(value); !checked) return checked;
  }
  return {};
}

}  // namespace detail

template <class T>
Checked unique(const rclcpp::Parameter& parameter) {
  const auto values = detail::elements<T>(parameter);
  if (std::set<T>(values.begin(), values.end()).size() != values.size()) {
    return detail::refused(parameter, "must only contain unique values");
  }
  return {};
}

template <class T>
Checked subset_of(const rclcpp::Parameter& parameter, const std::vector<T>& allowed) {
  for (const auto& value : detail::elements<T>(parameter)) {
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
      return detail::refused(parameter, "contains '", value, "', which is not one of ", allowed);
    }
  }
  return {};
}

template <class T>
Checked one_of(const rclcpp::Parameter& parameter, const std::vector<T>& allowed) {
  const auto value = parameter.get_value<T>();
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
    return detail::refused(parameter, "with the value '", value, "' is not one of ", allowed);
  }
  return {};
}

template <class T>
Checked fixed_size(const rclcpp::Parameter& parameter, std::size_t size) {
  const std::size_t length = detail::length<T>(parameter);
  if (length != size) {
    return detail::refused(parameter, "has length ", length, ", it must be ", size);
  }
  return {};
}

template <class T>
Checked size_gt(const rclcpp::Parameter& parameter, std::size_t size) {
  const std::size_t length = detail::length<T>(parameter);
  if (length <= size) {
    return detail::refused(parameter, "has length ", length, ", it must be more than ", size);
  }
  return {};
}

template <class T>
Checked size_lt(const rclcpp::Parameter& parameter, std::size_t size) {
  const std::size_t length = detail::length<T>(parameter);
  if (length >= size) {
    return detail::refused(parameter, "has length ", length, ", it must be less than ", size);
  }
  return {};
}

template <class T>
Checked not_empty(const rclcpp::Parameter& parameter) {
  if (detail::length<T>(parameter) == 0) {
    return detail::refused(parameter, "must not be empty");
  }
  return {};
}

template <class T>
Checked element_bounds(const rclcpp::Parameter& parameter, T lower, T upper) {
  return detail::each<T>(parameter, [&](T value) -> Checked {
    if (value >= lower && value <= upper) return {};
    return detail::refused(parameter, "has a value ", value, ", it must be within [", lower, ", ",
                           upper, "]");
  });
}

template <class T>
Checked lower_element_bounds(const rclcpp::Parameter& parameter, T lower) {
  return detail::each<T>(parameter, [&](T value) -> Checked {
    if (value >= lower) return {};
    return detail::refused(parameter, "has a value ", value, ", it must be at least ", lower);
  });
}

template <class T>
Checked upper_element_bounds(const rclcpp::Parameter& parameter, T upper) {
  return detail::each<T>(parameter, [&](T value) -> Checked {
    if (value <= upper) return {};
    return detail::refused(parameter, "has a value ", value, ", it must be at most ", upper);
  });
}

template <class T>
Checked bounds(const rclcpp::Parameter& parameter, T lower, T upper) {
  const auto value = parameter.get_value<T>();
  if (value >= lower && value <= upper) return {};
  return detail::refused(parameter, "with the value ", value, " must be within [", lower, ", ",
                         upper, "]");
}

template <class T>
Checked gt_eq(const rclcpp::Parameter& parameter, T limit) {
  const auto value = parameter.get_value<T>();
  if (value >= limit) return {};
  return detail::refused(parameter, "with the value ", value, " must be at least ", limit);
}

template <class T>
Checked lt_eq(const rclcpp::Parameter& parameter, T limit) {
  const auto value = parameter.get_value<T>();
  if (value <= limit) return {};
  return detail::refused(parameter, "with the value ", value, " must be at most ", limit);
}

template <class T>
Checked gt(const rclcpp::Parameter& parameter, T limit) {
  const auto value = parameter.get_value<T>();
  if (value > limit) return {};
  return detail::refused(parameter, "with the value ", value, " must be above ", limit);
}

template <class T>
Checked lt(const rclcpp::Parameter& parameter, T limit) {
  const auto value = parameter.get_value<T>();
  if (value < limit) return {};
  return detail::refused(parameter, "with the value ", value, " must be below ", limit);
}

template <class T>
Checked lower_bounds(const rclcpp::Parameter& parameter, T limit) {
  return gt_eq<T>(parameter, limit);
}

template <class T>
Checked upper_bounds(const rclcpp::Parameter& parameter, T limit) {
  return lt_eq<T>(parameter, limit);
}

inline rcl_interfaces::msg::SetParametersResult to_parameter_result_msg(const Checked& checked) {
  rcl_interfaces::msg::SetParametersResult result;
  result.successful = checked.has_value();
  result.reason = checked.has_value() ? "" : checked.error();
  return result;
}

}  // namespace rsl
