#pragma once

#include "rmw/types.h"

#define GAZELLE_RMW_PROFILE(history, depth, reliability, durability)                               \
  {                                                                                                \
    history, depth, reliability, durability, RMW_QOS_DEADLINE_DEFAULT, RMW_QOS_LIFESPAN_DEFAULT,   \
        RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT, RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT, false \
  }

static const rmw_qos_profile_t rmw_qos_profile_sensor_data =
    GAZELLE_RMW_PROFILE(RMW_QOS_POLICY_HISTORY_KEEP_LAST, 5, RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT,
                        RMW_QOS_POLICY_DURABILITY_VOLATILE);
static const rmw_qos_profile_t rmw_qos_profile_parameters =
    GAZELLE_RMW_PROFILE(RMW_QOS_POLICY_HISTORY_KEEP_LAST, 1000, RMW_QOS_POLICY_RELIABILITY_RELIABLE,
                        RMW_QOS_POLICY_DURABILITY_VOLATILE);
static const rmw_qos_profile_t rmw_qos_profile_default =
    GAZELLE_RMW_PROFILE(RMW_QOS_POLICY_HISTORY_KEEP_LAST, 10, RMW_QOS_POLICY_RELIABILITY_RELIABLE,
                        RMW_QOS_POLICY_DURABILITY_VOLATILE);
static const rmw_qos_profile_t rmw_qos_profile_services_default =
    GAZELLE_RMW_PROFILE(RMW_QOS_POLICY_HISTORY_KEEP_LAST, 10, RMW_QOS_POLICY_RELIABILITY_RELIABLE,
                        RMW_QOS_POLICY_DURABILITY_VOLATILE);
static const rmw_qos_profile_t rmw_qos_profile_parameter_events =
    GAZELLE_RMW_PROFILE(RMW_QOS_POLICY_HISTORY_KEEP_LAST, 1000, RMW_QOS_POLICY_RELIABILITY_RELIABLE,
                        RMW_QOS_POLICY_DURABILITY_VOLATILE);
static const rmw_qos_profile_t rmw_qos_profile_rosout_default =
    GAZELLE_RMW_PROFILE(RMW_QOS_POLICY_HISTORY_KEEP_LAST, 1000, RMW_QOS_POLICY_RELIABILITY_RELIABLE,
                        RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL);
static const rmw_qos_profile_t rmw_qos_profile_system_default = GAZELLE_RMW_PROFILE(
    RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT, 0, RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT,
    RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT);
static const rmw_qos_profile_t rmw_qos_profile_best_available = GAZELLE_RMW_PROFILE(
    RMW_QOS_POLICY_HISTORY_KEEP_LAST, 10, RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE,
    RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE);
static const rmw_qos_profile_t rmw_qos_profile_unknown =
    GAZELLE_RMW_PROFILE(RMW_QOS_POLICY_HISTORY_UNKNOWN, 0, RMW_QOS_POLICY_RELIABILITY_UNKNOWN,
                        RMW_QOS_POLICY_DURABILITY_UNKNOWN);

typedef enum rmw_qos_compatibility_type_e {
  RMW_QOS_COMPATIBILITY_OK = 0,
  RMW_QOS_COMPATIBILITY_WARNING,
  RMW_QOS_COMPATIBILITY_ERROR
} rmw_qos_compatibility_type_t;
