#pragma once

#include "rcl/allocator.h"
#include "rcl/types.h"

// Handles of C: nothing of ours lies in them but whose they are, so that code which only passes
// them on compiles.
typedef struct rcl_context_s {
  void* impl;
} rcl_context_t;
typedef struct rcl_node_s {
  rcl_context_t* context;
  void* impl;
} rcl_node_t;
typedef struct rcl_publisher_s {
  void* impl;
} rcl_publisher_t;
typedef struct rcl_subscription_s {
  void* impl;
} rcl_subscription_t;
typedef struct rcl_client_s {
  void* impl;
} rcl_client_t;
typedef struct rcl_service_s {
  void* impl;
} rcl_service_t;
typedef struct rcl_timer_s {
  void* impl;
} rcl_timer_t;
typedef struct rcl_event_s {
  void* impl;
} rcl_event_t;
typedef struct rcl_guard_condition_s {
  rcl_context_t* context;
  void* impl;
} rcl_guard_condition_t;
/// Guard conditions that a waitable adds are noted here; the executor waits for them.
typedef struct rcl_wait_set_s {
  const rcl_guard_condition_t** guard_conditions;
  size_t size_of_guard_conditions;
  void* impl;
} rcl_wait_set_t;

#ifdef __cplusplus
extern "C" {
#endif
rcl_ret_t rcl_trigger_guard_condition(rcl_guard_condition_t* guard_condition);
rcl_ret_t rcl_wait_set_add_guard_condition(rcl_wait_set_t* wait_set,
                                           const rcl_guard_condition_t* guard_condition,
                                           size_t* index);
#ifdef __cplusplus
}
#endif
