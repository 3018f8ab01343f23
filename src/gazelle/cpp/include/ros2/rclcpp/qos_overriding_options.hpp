#pragma once

#include <functional>
#include <initializer_list>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "rcl_interfaces/msg/set_parameters_result.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

enum class QosPolicyKind {
  AvoidRosNamespaceConventions = RMW_QOS_POLICY_AVOID_ROS_NAMESPACE_CONVENTIONS,
  Deadline = RMW_QOS_POLICY_DEADLINE,
  Depth = RMW_QOS_POLICY_DEPTH,
  Durability = RMW_QOS_POLICY_DURABILITY,
  History = RMW_QOS_POLICY_HISTORY,
  Lifespan = RMW_QOS_POLICY_LIFESPAN,
  Liveliness = RMW_QOS_POLICY_LIVELINESS,
  LivelinessLeaseDuration = RMW_QOS_POLICY_LIVELINESS_LEASE_DURATION,
  Reliability = RMW_QOS_POLICY_RELIABILITY,
  Invalid = RMW_QOS_POLICY_INVALID,
};

RCLCPP_PUBLIC const char* qos_policy_kind_to_cstr(const QosPolicyKind& kind);
RCLCPP_PUBLIC std::ostream& operator<<(std::ostream& out, const QosPolicyKind& kind);

using QosCallbackResult = rcl_interfaces::msg::SetParametersResult;
using QosCallback = std::function<QosCallbackResult(const QoS&)>;

/// Which policies of a topic parameters of its node override.
class RCLCPP_PUBLIC QosOverridingOptions {
 public:
  QosOverridingOptions() = default;
  QosOverridingOptions(std::initializer_list<QosPolicyKind> kinds,
                       QosCallback validation_callback = nullptr, std::string id = {})
      : id_(std::move(id)), kinds_(kinds), validation_callback_(std::move(validation_callback)) {}
  static QosOverridingOptions with_default_policies(QosCallback validation_callback = nullptr,
                                                    std::string id = {}) {
    return QosOverridingOptions(
        {QosPolicyKind::History, QosPolicyKind::Depth, QosPolicyKind::Reliability},
        std::move(validation_callback), std::move(id));
  }
  const std::string& get_id() const { return id_; }
  const std::vector<QosPolicyKind>& get_policy_kinds() const { return kinds_; }
  const QosCallback& get_validation_callback() const { return validation_callback_; }

 private:
  std::string id_;
  std::vector<QosPolicyKind> kinds_;
  QosCallback validation_callback_;
};

}  // namespace rclcpp
