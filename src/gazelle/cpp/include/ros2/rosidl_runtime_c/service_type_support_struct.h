// The handle by which generic code names a service's type: `data` is its gazelle::ServiceType.
#pragma once

typedef struct rosidl_service_type_support_t rosidl_service_type_support_t;

typedef const rosidl_service_type_support_t* (*rosidl_service_typesupport_handle_function)(
    const rosidl_service_type_support_t*, const char*);

struct rosidl_service_type_support_t {
  const char* typesupport_identifier;
  const void* data;
  rosidl_service_typesupport_handle_function func;
};
