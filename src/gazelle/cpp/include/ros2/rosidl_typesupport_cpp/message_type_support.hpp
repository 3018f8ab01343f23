#pragma once

#include <rosidl_runtime_c/message_type_support_struct.h>

#include <gazelle/message.hpp>

namespace rosidl_typesupport_cpp {

inline constexpr const char* typesupport_identifier = "rosidl_typesupport_cpp";

template <typename T>
const rosidl_message_type_support_t* get_message_type_support_handle() {
  static const rosidl_message_type_support_t found{typesupport_identifier,
                                                   &gazelle::message_type<T>(), nullptr};
  return &found;
}

}  // namespace rosidl_typesupport_cpp
