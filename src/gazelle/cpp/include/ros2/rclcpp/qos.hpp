#pragma once

#include <string>

#include "rclcpp/duration.hpp"
#include "rclcpp/exceptions.hpp"
#include "rclcpp/visibility_control.hpp"
#include "rmw/qos_profiles.h"
#include "rmw/qos_string_conversions.h"
#include "rmw/types.h"

namespace gazelle {
struct Qos;
}

namespace rclcpp {

RCLCPP_PUBLIC std::string qos_policy_name_from_kind(rmw_qos_policy_kind_t policy_kind);

enum class HistoryPolicy {
  KeepLast = RMW_QOS_POLICY_HISTORY_KEEP_LAST,
  KeepAll = RMW_QOS_POLICY_HISTORY_KEEP_ALL,
  SystemDefault = RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT,
  Unknown = RMW_QOS_POLICY_HISTORY_UNKNOWN,
};

enum class ReliabilityPolicy {
  BestEffort = RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT,
  Reliable = RMW_QOS_POLICY_RELIABILITY_RELIABLE,
  SystemDefault = RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT,
  BestAvailable = RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE,
  Unknown = RMW_QOS_POLICY_RELIABILITY_UNKNOWN,
};

enum class DurabilityPolicy {
  Volatile = RMW_QOS_POLICY_DURABILITY_VOLATILE,
  TransientLocal = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL,
  SystemDefault = RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT,
  BestAvailable = RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE,
  Unknown = RMW_QOS_POLICY_DURABILITY_UNKNOWN,
};

enum class LivelinessPolicy {
  Automatic = RMW_QOS_POLICY_LIVELINESS_AUTOMATIC,
  ManualByTopic = RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC,
  SystemDefault = RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
  BestAvailable = RMW_QOS_POLICY_LIVELINESS_BEST_AVAILABLE,
  Unknown = RMW_QOS_POLICY_LIVELINESS_UNKNOWN,
};

enum class QoSCompatibility {
  Ok = RMW_QOS_COMPATIBILITY_OK,
  Warning = RMW_QOS_COMPATIBILITY_WARNING,
  Error = RMW_QOS_COMPATIBILITY_ERROR,
};

struct RCLCPP_PUBLIC QoSInitialization {
  rmw_qos_history_policy_t history_policy;
  std::size_t depth;
  bool print_depth_warning;

  QoSInitialization() = delete;
  QoSInitialization(rmw_qos_history_policy_t history, std::size_t depth,
                    bool print_depth_warning = true)
      : history_policy(history), depth(depth), print_depth_warning(print_depth_warning) {}
  static QoSInitialization from_rmw(const rmw_qos_profile_t& profile);
};

struct RCLCPP_PUBLIC KeepAll : public QoSInitialization {
  KeepAll() : QoSInitialization(RMW_QOS_POLICY_HISTORY_KEEP_ALL, 0) {}
};

struct RCLCPP_PUBLIC KeepLast : public QoSInitialization {
  explicit KeepLast(std::size_t depth, bool print_depth_warning = true)
      : QoSInitialization(RMW_QOS_POLICY_HISTORY_KEEP_LAST, depth, print_depth_warning) {}
};

/// How a topic or service is carried; every setter returns the object.
class RCLCPP_PUBLIC QoS {
 public:
  explicit QoS(const QoSInitialization& initialization,
               const rmw_qos_profile_t& profile = rmw_qos_profile_default);
  QoS(std::size_t history_depth);  // NOLINT(runtime/explicit)

  rmw_qos_profile_t& get_rmw_qos_profile() { return profile_; }
  const rmw_qos_profile_t& get_rmw_qos_profile() const { return profile_; }

  QoS& history(HistoryPolicy history);
  QoS& history(rmw_qos_history_policy_t history);
  QoS& keep_last(std::size_t depth);
  QoS& keep_all();
  QoS& reliability(rmw_qos_reliability_policy_t reliability);
  QoS& reliability(ReliabilityPolicy reliability);
  QoS& reliable();
  QoS& best_effort();
  QoS& reliability_best_available();
  QoS& durability(rmw_qos_durability_policy_t durability);
  QoS& durability(DurabilityPolicy durability);
  QoS& durability_volatile();
  QoS& transient_local();
  QoS& durability_best_available();
  QoS& deadline(rmw_time_t deadline);
  QoS& deadline(const Duration& deadline);
  QoS& lifespan(rmw_time_t lifespan);
  QoS& lifespan(const Duration& lifespan);
  QoS& liveliness(rmw_qos_liveliness_policy_t liveliness);
  QoS& liveliness(LivelinessPolicy liveliness);
  QoS& liveliness_lease_duration(rmw_time_t lease);
  QoS& liveliness_lease_duration(const Duration& lease);
  QoS& avoid_ros_namespace_conventions(bool avoid);

  HistoryPolicy history() const;
  std::size_t depth() const { return profile_.depth; }
  ReliabilityPolicy reliability() const;
  DurabilityPolicy durability() const;
  Duration deadline() const;
  Duration lifespan() const;
  LivelinessPolicy liveliness() const;
  Duration liveliness_lease_duration() const;
  bool avoid_ros_namespace_conventions() const { return profile_.avoid_ros_namespace_conventions; }

  /// What the core of the graph understands of it.
  gazelle::Qos to_graph() const;

 private:
  rmw_qos_profile_t profile_;
};

RCLCPP_PUBLIC bool operator==(const QoS& left, const QoS& right);
RCLCPP_PUBLIC bool operator!=(const QoS& left, const QoS& right);

struct QoSCheckCompatibleResult {
  QoSCompatibility compatibility;
  std::string reason;
};

RCLCPP_PUBLIC QoSCheckCompatibleResult qos_check_compatible(const QoS& publisher_qos,
                                                            const QoS& subscription_qos);

// One class for each usual profile.
#define GAZELLE_RCLCPP_QOS(Name, profile)                                                         \
  class RCLCPP_PUBLIC Name : public QoS {                                                         \
   public:                                                                                        \
    explicit Name(const QoSInitialization& initialization = QoSInitialization::from_rmw(profile)) \
        : QoS(initialization, profile) {}                                                         \
  };
GAZELLE_RCLCPP_QOS(SensorDataQoS, rmw_qos_profile_sensor_data)
GAZELLE_RCLCPP_QOS(ParametersQoS, rmw_qos_profile_parameters)
GAZELLE_RCLCPP_QOS(ServicesQoS, rmw_qos_profile_services_default)
GAZELLE_RCLCPP_QOS(ParameterEventsQoS, rmw_qos_profile_parameter_events)
GAZELLE_RCLCPP_QOS(RosoutQoS, rmw_qos_profile_rosout_default)
GAZELLE_RCLCPP_QOS(SystemDefaultsQoS, rmw_qos_profile_system_default)
GAZELLE_RCLCPP_QOS(BestAvailableQoS, rmw_qos_profile_best_available)
#undef GAZELLE_RCLCPP_QOS

class RCLCPP_PUBLIC ClockQoS : public QoS {
 public:
  explicit ClockQoS(const QoSInitialization& initialization = KeepLast(1))
      : QoS(initialization, rmw_qos_profile_sensor_data) {}
};

}  // namespace rclcpp
