#pragma once

#include <memory>
#include <string>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_timers_interface.hpp"
#include "rclcpp/publisher_base.hpp"
#include "rclcpp/subscription_base.hpp"

namespace rclcpp {
namespace node_interfaces {

/// Publishers and subscriptions of a node.
class RCLCPP_PUBLIC NodeTopicsInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeTopicsInterface)
  virtual ~NodeTopicsInterface() = default;
  virtual void add_publisher(PublisherBase::SharedPtr publisher,
                             CallbackGroup::SharedPtr group) = 0;
  virtual void add_subscription(SubscriptionBase::SharedPtr subscription,
                                CallbackGroup::SharedPtr group) = 0;
  virtual NodeBaseInterface* get_node_base_interface() const = 0;
  virtual NodeTimersInterface* get_node_timers_interface() const = 0;
  virtual std::string resolve_topic_name(const std::string& name,
                                         bool only_expand = false) const = 0;
};

}  // namespace node_interfaces
}  // namespace rclcpp
