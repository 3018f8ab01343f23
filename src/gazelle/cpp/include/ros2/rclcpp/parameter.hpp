#pragma once

#include <iostream>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "rcl_interfaces/msg/parameter.hpp"
#include "rcl_interfaces/msg/parameter_descriptor.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/parameter_value.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

class Parameter;

namespace node_interfaces {
struct ParameterInfo {
  ParameterValue value;
  rcl_interfaces::msg::ParameterDescriptor descriptor;
};
}  // namespace node_interfaces

/// A name with a value.
class RCLCPP_PUBLIC Parameter {
  // Name the parameter where its value is asked for as what it is not.
  template <typename Function>
  decltype(auto) guarded(Function function) const {
    try {
      return function();
    } catch (const ParameterTypeException& error) {
      throw exceptions::InvalidParameterTypeException(name_, error.what());
    }
  }

 public:
  Parameter() = default;
  explicit Parameter(const std::string& name) : name_(name) {}
  Parameter(const std::string& name, const ParameterValue& value) : name_(name), value_(value) {}
  template <typename ValueTypeT>
  Parameter(const std::string& name, ValueTypeT value)
      : Parameter(name, ParameterValue(std::move(value))) {}
  explicit Parameter(const node_interfaces::ParameterInfo& info)
      : Parameter(info.descriptor.name, info.value) {}

  bool operator==(const Parameter& other) const {
    return name_ == other.name_ && value_ == other.value_;
  }
  bool operator!=(const Parameter& other) const { return !(*this == other); }
  ParameterType get_type() const { return value_.get_type(); }
  std::string get_type_name() const { return to_string(get_type()); }
  const std::string& get_name() const { return name_; }
  rcl_interfaces::msg::ParameterValue get_value_message() const { return value_.to_value_msg(); }
  const ParameterValue& get_parameter_value() const { return value_; }

  template <ParameterType ParamT>
  decltype(auto) get_value() const {
    return guarded([this]() -> decltype(auto) { return value_.get<ParamT>(); });
  }
  template <typename T>
  decltype(auto) get_value() const {
    return guarded([this]() -> decltype(auto) { return value_.get<T>(); });
  }

  bool as_bool() const { return get_value<bool>(); }
  int64_t as_int() const { return get_value<int64_t>(); }
  double as_double() const { return get_value<double>(); }
  const std::string& as_string() const { return get_value<std::string>(); }
  const std::vector<uint8_t>& as_byte_array() const { return get_value<std::vector<uint8_t>>(); }
  const std::vector<bool>& as_bool_array() const { return get_value<std::vector<bool>>(); }
  const std::vector<int64_t>& as_integer_array() const { return get_value<std::vector<int64_t>>(); }
  const std::vector<double>& as_double_array() const { return get_value<std::vector<double>>(); }
  const std::vector<std::string>& as_string_array() const {
    return get_value<std::vector<std::string>>();
  }

  static Parameter from_parameter_msg(const rcl_interfaces::msg::Parameter& message);
  rcl_interfaces::msg::Parameter to_parameter_msg() const;
  std::string value_to_string() const { return to_string(value_); }

 private:
  std::string name_;
  ParameterValue value_;
};

RCLCPP_PUBLIC std::string _to_json_dict_entry(const Parameter& parameter);
RCLCPP_PUBLIC std::ostream& operator<<(std::ostream& out, const Parameter& parameter);
RCLCPP_PUBLIC std::ostream& operator<<(std::ostream& out, const std::vector<Parameter>& parameters);

}  // namespace rclcpp

namespace std {
RCLCPP_PUBLIC std::string to_string(const rclcpp::Parameter& parameter);
RCLCPP_PUBLIC std::string to_string(const std::vector<rclcpp::Parameter>& parameters);
}  // namespace std
