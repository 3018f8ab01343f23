#pragma once

#include "rclcpp/type_adapter.hpp"
#include "rosidl_typesupport_cpp/message_type_support.hpp"

namespace rclcpp {

template <typename MessageT>
const rosidl_message_type_support_t& get_message_type_support_handle() {
  return *rosidl_typesupport_cpp::get_message_type_support_handle<
      typename detail::Adapted<MessageT>::ros_type>();
}

}  // namespace rclcpp
