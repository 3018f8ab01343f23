#pragma once

#include "rmw/types.h"

#ifdef __cplusplus
extern "C" {
#endif
const char* rmw_qos_policy_kind_to_str(rmw_qos_policy_kind_t kind);
const char* rmw_qos_durability_policy_to_str(rmw_qos_durability_policy_t policy);
const char* rmw_qos_history_policy_to_str(rmw_qos_history_policy_t policy);
const char* rmw_qos_liveliness_policy_to_str(rmw_qos_liveliness_policy_t policy);
const char* rmw_qos_reliability_policy_to_str(rmw_qos_reliability_policy_t policy);
rmw_qos_durability_policy_t rmw_qos_durability_policy_from_str(const char* text);
rmw_qos_history_policy_t rmw_qos_history_policy_from_str(const char* text);
rmw_qos_liveliness_policy_t rmw_qos_liveliness_policy_from_str(const char* text);
rmw_qos_reliability_policy_t rmw_qos_reliability_policy_from_str(const char* text);
#ifdef __cplusplus
}
#endif
