#pragma once

#include <type_traits>
#include <utility>

namespace rclcpp_lifecycle {

template <class T, class = void>
struct has_on_activate : std::false_type {};
template <class T>
struct has_on_activate<T, std::void_t<decltype(std::declval<T>().on_activate())>> : std::true_type {
};
template <class T, class = void>
struct has_on_deactivate : std::false_type {};
template <class T>
struct has_on_deactivate<T, std::void_t<decltype(std::declval<T>().on_deactivate())>>
    : std::true_type {};
template <class T>
struct is_manageable_node
    : std::bool_constant<has_on_activate<T>::value && has_on_deactivate<T>::value> {};

}  // namespace rclcpp_lifecycle
