#pragma once

#include "rmw/types.h"

typedef struct rmw_topic_endpoint_info_s {
  const char* node_name;
  const char* node_namespace;
  const char* topic_type;
  rmw_endpoint_type_t endpoint_type;
  uint8_t endpoint_gid[RMW_GID_STORAGE_SIZE];
  rmw_qos_profile_t qos_profile;
} rmw_topic_endpoint_info_t;
