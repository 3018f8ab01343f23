#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <type_traits>

#include <gazelle/message.hpp>

namespace rosidl_generator_traits {

template <typename T>
struct is_message : std::bool_constant<gazelle::is_message_v<T>> {};
template <typename T>
struct is_service : std::bool_constant<gazelle::is_service_v<T>> {};
template <typename T, typename = void>
struct is_action : std::false_type {};
template <typename T>
struct is_action<T, std::void_t<decltype(gazelle::ActionDescription<T>::type)>> : std::true_type {};

namespace detail {
template <typename T, typename = void>
struct IsRequest : std::false_type {};
template <typename T>
struct IsRequest<T, std::void_t<typename gazelle::ServiceOf<T>::type>>
    : std::is_same<T, typename gazelle::ServiceOf<T>::type::Request> {};
template <typename T, typename = void>
struct IsResponse : std::false_type {};
template <typename T>
struct IsResponse<T, std::void_t<typename gazelle::ServiceOf<T>::type>>
    : std::is_same<T, typename gazelle::ServiceOf<T>::type::Response> {};

template <typename T>
std::string name_of() {
  if constexpr (is_action<T>::value) {
    return gazelle::ActionDescription<T>::type;
  } else {
    return gazelle::Description<T>::type;
  }
}
}  // namespace detail

template <typename T>
struct is_service_request : detail::IsRequest<T> {};
template <typename T>
struct is_service_response : detail::IsResponse<T> {};

template <typename T>
struct has_fixed_size : std::bool_constant<gazelle::Description<T>::is_fixed_size> {};
template <typename T>
struct has_bounded_size : std::bool_constant<gazelle::Description<T>::is_bounded_size> {};

// "std_msgs/msg/String"
template <typename T>
const char* name() {
  static const std::string found = detail::name_of<T>();
  return found.c_str();
}

// "std_msgs::msg::String"
template <typename T>
const char* data_type() {
  static const std::string found = [] {
    std::string text;
    for (char letter : detail::name_of<T>()) {
      text += letter == '/' ? std::string("::") : std::string(1, letter);
    }
    return text;
  }();
  return found.c_str();
}

template <typename T, typename = std::enable_if_t<gazelle::is_message_v<T>>>
void to_block_style_yaml(const T& message, std::ostream& out, std::size_t indentation = 0) {
  gazelle::print_yaml(out, gazelle::Description<T>::layout(), &message, indentation, false);
}

template <typename T, typename = std::enable_if_t<gazelle::is_message_v<T>>>
void to_flow_style_yaml(const T& message, std::ostream& out) {
  gazelle::print_yaml(out, gazelle::Description<T>::layout(), &message, 0, true);
}

template <typename T, typename = std::enable_if_t<gazelle::is_message_v<T>>>
std::string to_yaml(const T& message, bool use_flow_style = false) {
  std::ostringstream out;
  gazelle::print_yaml(out, gazelle::Description<T>::layout(), &message, 0, use_flow_style);
  return out.str();
}

}  // namespace rosidl_generator_traits
