#pragma once

typedef enum rcl_service_introspection_state_e {
  RCL_SERVICE_INTROSPECTION_OFF,
  RCL_SERVICE_INTROSPECTION_METADATA,
  RCL_SERVICE_INTROSPECTION_CONTENTS
} rcl_service_introspection_state_t;
