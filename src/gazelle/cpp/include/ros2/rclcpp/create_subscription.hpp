#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/create_publisher.hpp"
#include "rclcpp/detail/interface_of.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/subscription.hpp"

namespace rclcpp {

template <typename MessageT, typename CallbackT, typename AllocatorT = std::allocator<void>,
          typename SubscriptionT = Subscription<MessageT, AllocatorT>,
          typename MessageMemoryStrategyT = typename SubscriptionT::MessageMemoryStrategyType>
std::shared_ptr<SubscriptionT> create_subscription(
    std::shared_ptr<node_interfaces::NodeParametersInterface> parameters,
    std::shared_ptr<node_interfaces::NodeTopicsInterface> topics, const std::string& topic,
    const QoS& qos, CallbackT&& callback,
    const SubscriptionOptionsWithAllocator<AllocatorT>& options =
        SubscriptionOptionsWithAllocator<AllocatorT>(),
    typename MessageMemoryStrategyT::SharedPtr strategy = nullptr) {
  (void)strategy;
  const QoS actual =
      options.qos_overriding_options.get_policy_kinds().empty()
          ? qos
          : detail::overridden_qos(parameters.get(), topics->resolve_topic_name(topic), qos,
                                   options.qos_overriding_options, false);
  auto made = std::make_shared<SubscriptionT>(topics->get_node_base_interface(), topic, actual,
                                              std::forward<CallbackT>(callback), options);
  topics->add_subscription(made, options.callback_group);
  made->start_statistics(topics.get(), options,
                         topics->get_node_base_interface()->get_enable_topic_statistics_default());
  return made;
}

/// Make a subscription for a node of any class.
template <typename MessageT, typename CallbackT, typename AllocatorT = std::allocator<void>,
          typename SubscriptionT = Subscription<MessageT, AllocatorT>,
          typename MessageMemoryStrategyT = typename SubscriptionT::MessageMemoryStrategyType,
          typename NodeT>
std::shared_ptr<SubscriptionT> create_subscription(
    NodeT&& node, const std::string& topic, const QoS& qos, CallbackT&& callback,
    const SubscriptionOptionsWithAllocator<AllocatorT>& options =
        SubscriptionOptionsWithAllocator<AllocatorT>(),
    typename MessageMemoryStrategyT::SharedPtr strategy = nullptr) {
  std::shared_ptr<node_interfaces::NodeParametersInterface> parameters;
  if constexpr (!std::is_convertible_v<std::remove_cv_t<std::remove_reference_t<NodeT>>,
                                       std::shared_ptr<node_interfaces::NodeTopicsInterface>>) {
    parameters = node_interfaces::get_node_parameters_interface(node);
  }
  return create_subscription<MessageT, CallbackT, AllocatorT, SubscriptionT,
                             MessageMemoryStrategyT>(
      parameters, node_interfaces::get_node_topics_interface(node), topic, qos,
      std::forward<CallbackT>(callback), options, strategy);
}

}  // namespace rclcpp
