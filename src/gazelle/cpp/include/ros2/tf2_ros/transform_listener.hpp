// Puts what is sent on /tf and /tf_static into a buffer.
#pragma once

#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "rclcpp/rclcpp.hpp"
#include "tf2/buffer_core.hpp"
#include "tf2/time.hpp"
#include "tf2_msgs/msg/tf_message.hpp"
#include "tf2_ros/qos.hpp"
#include "tf2_ros/visibility_control.h"

namespace tf2_ros {

namespace detail {

template <class AllocatorT = std::allocator<void>>
rclcpp::SubscriptionOptionsWithAllocator<AllocatorT> get_default_transform_listener_sub_options() {
  using Kind = rclcpp::QosPolicyKind;
  rclcpp::SubscriptionOptionsWithAllocator<AllocatorT> options;
  options.qos_overriding_options =
      rclcpp::QosOverridingOptions{Kind::Depth, Kind::Durability, Kind::History, Kind::Reliability};
  return options;
}
template <class AllocatorT = std::allocator<void>>
rclcpp::SubscriptionOptionsWithAllocator<AllocatorT>
get_default_transform_listener_static_sub_options() {
  using Kind = rclcpp::QosPolicyKind;
  rclcpp::SubscriptionOptionsWithAllocator<AllocatorT> options;
  options.qos_overriding_options =
      rclcpp::QosOverridingOptions{Kind::Depth, Kind::History, Kind::Reliability};
  return options;
}

}  // namespace detail

class TF2_ROS_PUBLIC TransformListener {
 public:
  // With a node of its own.
  explicit TransformListener(tf2::BufferCore& buffer, bool spin_thread = true,
                             bool static_only = false);

  template <class NodeT, class AllocatorT = std::allocator<void>>
  TransformListener(tf2::BufferCore& buffer, NodeT&& node, bool spin_thread = true,
                    const rclcpp::QoS& qos = DynamicListenerQoS(),
                    const rclcpp::QoS& static_qos = StaticListenerQoS(),
                    const rclcpp::SubscriptionOptionsWithAllocator<AllocatorT>& options =
                        detail::get_default_transform_listener_sub_options<AllocatorT>(),
                    const rclcpp::SubscriptionOptionsWithAllocator<AllocatorT>& static_options =
                        detail::get_default_transform_listener_static_sub_options<AllocatorT>(),
                    bool static_only = false)
      : TransformListener(buffer, node->get_node_base_interface(),
                          node->get_node_logging_interface(), node->get_node_parameters_interface(),
                          node->get_node_topics_interface(), spin_thread, qos, static_qos, options,
                          static_options, static_only) {}

  template <class AllocatorT = std::allocator<void>>
  TransformListener(tf2::BufferCore& buffer,
                    rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base,
                    rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr node_logging,
                    rclcpp::node_interfaces::NodeParametersInterface::SharedPtr node_parameters,
                    rclcpp::node_interfaces::NodeTopicsInterface::SharedPtr node_topics,
                    bool spin_thread = true, const rclcpp::QoS& qos = DynamicListenerQoS(),
                    const rclcpp::QoS& static_qos = StaticListenerQoS(),
                    const rclcpp::SubscriptionOptionsWithAllocator<AllocatorT>& options =
                        detail::get_default_transform_listener_sub_options<AllocatorT>(),
                    const rclcpp::SubscriptionOptionsWithAllocator<AllocatorT>& static_options =
                        detail::get_default_transform_listener_static_sub_options<AllocatorT>(),
                    bool static_only = false)
      : buffer_(buffer), node_base_(node_base), node_logging_(node_logging) {
    rclcpp::SubscriptionOptionsWithAllocator<AllocatorT> moving = options, still = static_options;
    if (spin_thread) {
      group_ =
          node_base->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
      moving.callback_group = group_;
      still.callback_group = group_;
    }
    if (!static_only) {
      moving_ = rclcpp::create_subscription<tf2_msgs::msg::TFMessage>(
          node_parameters, node_topics, "/tf", qos, taker(false), moving);
    }
    static_ = rclcpp::create_subscription<tf2_msgs::msg::TFMessage>(
        node_parameters, node_topics, "/tf_static", static_qos, taker(true), still);
    if (spin_thread) spin();
  }

  virtual ~TransformListener();
  TransformListener(const TransformListener&) = delete;
  TransformListener& operator=(const TransformListener&) = delete;

  virtual void subscription_callback(tf2_msgs::msg::TFMessage::ConstSharedPtr msg, bool is_static);

 private:
  using Taker = std::function<void(tf2_msgs::msg::TFMessage::ConstSharedPtr)>;

  Taker taker(bool is_static);
  void spin();

  tf2::BufferCore& buffer_;
  rclcpp::Node::SharedPtr own_node_;
  rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base_;
  rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr node_logging_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::Subscription<tf2_msgs::msg::TFMessage>::SharedPtr moving_;
  rclcpp::Subscription<tf2_msgs::msg::TFMessage>::SharedPtr static_;
  rclcpp::Executor::SharedPtr executor_;
  std::unique_ptr<std::thread> thread_;
};

// Hears of frames that never move only.
class TF2_ROS_PUBLIC StaticTransformListener : public TransformListener {
 public:
  explicit StaticTransformListener(tf2::BufferCore& buffer, bool spin_thread = true)
      : TransformListener(buffer, spin_thread, true) {}
  template <class NodeT, class AllocatorT = std::allocator<void>>
  StaticTransformListener(
      tf2::BufferCore& buffer, NodeT&& node, bool spin_thread = true,
      const rclcpp::QoS& static_qos = StaticListenerQoS(),
      const rclcpp::SubscriptionOptionsWithAllocator<AllocatorT>& static_options =
          detail::get_default_transform_listener_static_sub_options<AllocatorT>())
      : TransformListener(buffer, node, spin_thread, rclcpp::QoS(1), static_qos,
                          rclcpp::SubscriptionOptionsWithAllocator<AllocatorT>(), static_options,
                          true) {}
};

}  // namespace tf2_ros
