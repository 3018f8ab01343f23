// The handle by which generic code names a message's type: `data` is its gazelle::MessageType.
#pragma once

typedef struct rosidl_message_type_support_t rosidl_message_type_support_t;

typedef const rosidl_message_type_support_t* (*rosidl_message_typesupport_handle_function)(
    const rosidl_message_type_support_t*, const char*);

struct rosidl_message_type_support_t {
  const char* typesupport_identifier;
  const void* data;
  rosidl_message_typesupport_handle_function func;
};
