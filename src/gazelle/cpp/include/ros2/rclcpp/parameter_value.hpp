#pragma once

#include <cstdint>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "rcl_interfaces/msg/parameter_type.hpp"
#include "rcl_interfaces/msg/parameter_value.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

enum ParameterType : uint8_t {
  PARAMETER_NOT_SET = 0,
  PARAMETER_BOOL = 1,
  PARAMETER_INTEGER = 2,
  PARAMETER_DOUBLE = 3,
  PARAMETER_STRING = 4,
  PARAMETER_BYTE_ARRAY = 5,
  PARAMETER_BOOL_ARRAY = 6,
  PARAMETER_INTEGER_ARRAY = 7,
  PARAMETER_DOUBLE_ARRAY = 8,
  PARAMETER_STRING_ARRAY = 9,
};

RCLCPP_PUBLIC std::string to_string(ParameterType type);
RCLCPP_PUBLIC std::ostream& operator<<(std::ostream& out, ParameterType type);

/// A value was asked for as what it is not.
class ParameterTypeException : public std::runtime_error {
 public:
  ParameterTypeException(ParameterType expected, ParameterType actual)
      : std::runtime_error("expected [" + to_string(expected) + "] got [" + to_string(actual) +
                           "]") {}
};

namespace detail {

template <typename T, typename = void>
struct ParameterKind;  // the kind of parameter that a type of C++ is, and its member of the message

#define GAZELLE_RCLCPP_PARAMETER_KIND(type, kind, member)                       \
  template <>                                                                   \
  struct ParameterKind<type> {                                                  \
    static constexpr ParameterType value = kind;                                \
    static constexpr auto field = &rcl_interfaces::msg::ParameterValue::member; \
  };
GAZELLE_RCLCPP_PARAMETER_KIND(bool, PARAMETER_BOOL, bool_value)
GAZELLE_RCLCPP_PARAMETER_KIND(std::string, PARAMETER_STRING, string_value)
GAZELLE_RCLCPP_PARAMETER_KIND(std::vector<uint8_t>, PARAMETER_BYTE_ARRAY, byte_array_value)
GAZELLE_RCLCPP_PARAMETER_KIND(std::vector<bool>, PARAMETER_BOOL_ARRAY, bool_array_value)
GAZELLE_RCLCPP_PARAMETER_KIND(std::vector<int64_t>, PARAMETER_INTEGER_ARRAY, integer_array_value)
GAZELLE_RCLCPP_PARAMETER_KIND(std::vector<double>, PARAMETER_DOUBLE_ARRAY, double_array_value)
GAZELLE_RCLCPP_PARAMETER_KIND(std::vector<std::string>, PARAMETER_STRING_ARRAY, string_array_value)
#undef GAZELLE_RCLCPP_PARAMETER_KIND

template <typename T>
struct ParameterKind<T, std::enable_if_t<std::is_integral<T>::value>> {
  static constexpr ParameterType value = PARAMETER_INTEGER;
  static constexpr auto field = &rcl_interfaces::msg::ParameterValue::integer_value;
};
template <typename T>
struct ParameterKind<T, std::enable_if_t<std::is_floating_point<T>::value>> {
  static constexpr ParameterType value = PARAMETER_DOUBLE;
  static constexpr auto field = &rcl_interfaces::msg::ParameterValue::double_value;
};

}  // namespace detail

/// A value with its type.
class RCLCPP_PUBLIC ParameterValue {
 public:
  ParameterValue() { value_.type = PARAMETER_NOT_SET; }
  explicit ParameterValue(const rcl_interfaces::msg::ParameterValue& value);
  explicit ParameterValue(bool value);
  explicit ParameterValue(int value) : ParameterValue(static_cast<int64_t>(value)) {}
  explicit ParameterValue(int64_t value);
  explicit ParameterValue(float value) : ParameterValue(static_cast<double>(value)) {}
  explicit ParameterValue(double value);
  explicit ParameterValue(const std::string& value);
  explicit ParameterValue(const char* value) : ParameterValue(std::string(value)) {}
  explicit ParameterValue(const std::vector<uint8_t>& value);
  explicit ParameterValue(const std::vector<bool>& value);
  explicit ParameterValue(const std::vector<int>& value);
  explicit ParameterValue(const std::vector<int64_t>& value);
  explicit ParameterValue(const std::vector<float>& value);
  explicit ParameterValue(const std::vector<double>& value);
  explicit ParameterValue(const std::vector<std::string>& value);

  ParameterType get_type() const { return static_cast<ParameterType>(value_.type); }
  const rcl_interfaces::msg::ParameterValue& to_value_msg() const { return value_; }
  bool operator==(const ParameterValue& other) const { return value_ == other.value_; }
  bool operator!=(const ParameterValue& other) const { return !(*this == other); }

  template <ParameterType type>
  decltype(auto) get() const {
    if constexpr (type == PARAMETER_BOOL) {
      return get<bool>();
    } else if constexpr (type == PARAMETER_INTEGER) {
      return get<int64_t>();
    } else if constexpr (type == PARAMETER_DOUBLE) {
      return get<double>();
    } else if constexpr (type == PARAMETER_STRING) {
      return get<std::string>();
    } else if constexpr (type == PARAMETER_BYTE_ARRAY) {
      return get<std::vector<uint8_t>>();
    } else if constexpr (type == PARAMETER_BOOL_ARRAY) {
      return get<std::vector<bool>>();
    } else if constexpr (type == PARAMETER_INTEGER_ARRAY) {
      return get<std::vector<int64_t>>();
    } else if constexpr (type == PARAMETER_DOUBLE_ARRAY) {
      return get<std::vector<double>>();
    } else {
      return get<std::vector<std::string>>();
    }
  }

  template <typename T>
  decltype(auto) get() const {
    using V = std::decay_t<T>;
    if constexpr (std::is_same<V, std::vector<int>>::value ||
                  std::is_same<V, std::vector<float>>::value) {
      // Lists of the shorter kinds are made of the longer ones.
      using Long = std::conditional_t<std::is_same<V, std::vector<int>>::value, int64_t, double>;
      const auto& values = get<std::vector<Long>>();
      return V(values.begin(), values.end());
    } else {
      using Kind = detail::ParameterKind<V>;
      if (get_type() != Kind::value) throw ParameterTypeException(Kind::value, get_type());
      if constexpr (std::is_same<V, bool>::value || std::is_class<V>::value ||
                    std::is_same<V, int64_t>::value || std::is_same<V, double>::value) {
        return static_cast<const V&>(value_.*Kind::field);
      } else {
        return static_cast<V>(value_.*Kind::field);
      }
    }
  }

 private:
  rcl_interfaces::msg::ParameterValue value_;
};

RCLCPP_PUBLIC std::string to_string(const ParameterValue& value);

}  // namespace rclcpp
