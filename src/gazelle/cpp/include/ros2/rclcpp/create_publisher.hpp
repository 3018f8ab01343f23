#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/detail/interface_of.hpp"
#include "rclcpp/publisher.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp {
namespace detail {

/// Let parameters of the node override a topic's QoS where its options allow that.
RCLCPP_PUBLIC QoS overridden_qos(node_interfaces::NodeParametersInterface* parameters,
                                 const std::string& topic, const QoS& qos,
                                 const QosOverridingOptions& options, bool is_publisher);

}  // namespace detail

template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename PublisherT = Publisher<MessageT, AllocatorT>>
std::shared_ptr<PublisherT> create_publisher(
    std::shared_ptr<node_interfaces::NodeParametersInterface> parameters,
    std::shared_ptr<node_interfaces::NodeTopicsInterface> topics, const std::string& topic,
    const QoS& qos,
    const PublisherOptionsWithAllocator<AllocatorT>& options =
        PublisherOptionsWithAllocator<AllocatorT>()) {
  const QoS actual =
      options.qos_overriding_options.get_policy_kinds().empty()
          ? qos
          : detail::overridden_qos(parameters.get(), topics->resolve_topic_name(topic), qos,
                                   options.qos_overriding_options, true);
  auto made =
      std::make_shared<PublisherT>(topics->get_node_base_interface(), topic, actual, options);
  made->post_init_setup(topics->get_node_base_interface(), topic, actual, options);
  topics->add_publisher(made, options.callback_group);
  return made;
}

/// Make a publisher for a node of any class.
template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename PublisherT = Publisher<MessageT, AllocatorT>, typename NodeT>
std::shared_ptr<PublisherT> create_publisher(
    NodeT&& node, const std::string& topic, const QoS& qos,
    const PublisherOptionsWithAllocator<AllocatorT>& options =
        PublisherOptionsWithAllocator<AllocatorT>()) {
  std::shared_ptr<node_interfaces::NodeParametersInterface> parameters;
  if constexpr (!std::is_convertible_v<std::remove_cv_t<std::remove_reference_t<NodeT>>,
                                       std::shared_ptr<node_interfaces::NodeTopicsInterface>>) {
    parameters = node_interfaces::get_node_parameters_interface(node);
  }
  return create_publisher<MessageT, AllocatorT, PublisherT>(
      parameters, node_interfaces::get_node_topics_interface(node), topic, qos, options);
}

}  // namespace rclcpp
