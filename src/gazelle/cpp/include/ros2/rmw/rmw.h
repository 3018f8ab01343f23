#pragma once

#include "rmw/qos_profiles.h"
#include "rmw/types.h"
#include "rmw/visibility_control.h"
#include "rosidl_runtime_c/message_type_support_struct.h"

#ifdef __cplusplus
extern "C" {
#endif
RMW_PUBLIC const char* rmw_get_implementation_identifier(void);
/// Write a message as CDR.
RMW_PUBLIC rmw_ret_t rmw_serialize(const void* message,
                                   const rosidl_message_type_support_t* type_support,
                                   rmw_serialized_message_t* serialized);
RMW_PUBLIC rmw_ret_t rmw_deserialize(const rmw_serialized_message_t* serialized,
                                     const rosidl_message_type_support_t* type_support,
                                     void* message);
#ifdef __cplusplus
}
#endif
