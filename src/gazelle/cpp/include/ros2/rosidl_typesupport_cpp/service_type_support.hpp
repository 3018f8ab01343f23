#pragma once

#include <rosidl_runtime_c/service_type_support_struct.h>
#include <rosidl_typesupport_cpp/message_type_support.hpp>

#include <gazelle/message.hpp>

namespace rosidl_typesupport_cpp {

template <typename T>
const rosidl_service_type_support_t* get_service_type_support_handle() {
  static const rosidl_service_type_support_t found{typesupport_identifier,
                                                   &gazelle::service_type<T>(), nullptr};
  return &found;
}

}  // namespace rosidl_typesupport_cpp
