#pragma once

#include <memory>
#include <type_traits>

#include "rosidl_runtime_cpp/traits.hpp"

namespace rclcpp {

/// Says how a user's class becomes a message and back; users specialise it.
template <typename CustomType, typename ROSMessageType = void, class Enable = void>
struct TypeAdapter {
  using is_specialized = std::false_type;
  using custom_type = CustomType;
  // What is no pair of types is a message that needs no conversion.
  using ros_message_type = CustomType;
};

template <typename T>
struct is_type_adapter : std::false_type {};
template <typename... Ts>
struct is_type_adapter<TypeAdapter<Ts...>> : std::true_type {};

template <typename T>
struct TypeAdapter<T, void, std::enable_if_t<is_type_adapter<T>::value>> : T {};

/// What `RCLCPP_USING_CUSTOM_TYPE_AS_ROS_MESSAGE_TYPE` specialises.
template <typename T>
struct ImplicitTypeAdapter {
  using is_specialized = std::false_type;
};

template <typename T>
struct TypeAdapter<T, void, std::enable_if_t<ImplicitTypeAdapter<T>::is_specialized::value>>
    : ImplicitTypeAdapter<T> {};

template <typename CustomType>
struct adapt_type {
  template <typename ROSMessageType>
  using as = TypeAdapter<CustomType, ROSMessageType>;
};

template <typename T>
struct is_ros_compatible_type {
  static constexpr bool value =
      rosidl_generator_traits::is_message<T>::value || TypeAdapter<T>::is_specialized::value;
};

namespace detail {

/// The two sides of what a topic was declared with.
template <typename T>
struct Adapted {
  using adapter = TypeAdapter<T>;
  static constexpr bool is_adapted = adapter::is_specialized::value;
  using custom_type = typename adapter::custom_type;
  using ros_type = typename adapter::ros_message_type;
};

template <typename T>
std::unique_ptr<typename Adapted<T>::custom_type> to_custom(
    const typename Adapted<T>::ros_type& message) {
  auto made = std::make_unique<typename Adapted<T>::custom_type>();
  Adapted<T>::adapter::convert_to_custom(message, *made);
  return made;
}

}  // namespace detail
}  // namespace rclcpp

#define RCLCPP_USING_CUSTOM_TYPE_AS_ROS_MESSAGE_TYPE(CustomType, ROSMessageType)          \
  template <>                                                                             \
  struct rclcpp::ImplicitTypeAdapter<CustomType>                                          \
      : public rclcpp::TypeAdapter<CustomType, ROSMessageType> {                          \
    using is_specialized = std::true_type;                                                \
    static_assert(                                                                        \
        is_specialized::value,                                                            \
        "Cannot use custom type as ros type when there is no TypeAdapter for that pair"); \
  }
