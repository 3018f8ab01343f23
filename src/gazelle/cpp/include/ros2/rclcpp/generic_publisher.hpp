#pragma once

#include <memory>
#include <string>

#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/publisher_base.hpp"
#include "rclcpp/publisher_options.hpp"

namespace rclcpp {

/// Sends messages, as CDR, of a type that is named when the program runs.
class RCLCPP_PUBLIC GenericPublisher : public PublisherBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(GenericPublisher)
  GenericPublisher(node_interfaces::NodeBaseInterface* node, const std::string& topic,
                   const std::string& type, const QoS& qos, const PublisherOptionsBase& options)
      : PublisherBase(node, topic, type, qos, options) {}
  void publish(const SerializedMessage& message) {
    publish_bytes(message.get_rcl_serialized_message());
  }
  void publish_as_loaned_msg(const SerializedMessage& message) { publish(message); }
};

template <typename AllocatorT = std::allocator<void>>
std::shared_ptr<GenericPublisher> create_generic_publisher(
    node_interfaces::NodeTopicsInterface::SharedPtr topics, const std::string& topic,
    const std::string& type, const QoS& qos,
    const PublisherOptionsWithAllocator<AllocatorT>& options =
        PublisherOptionsWithAllocator<AllocatorT>()) {
  auto made = std::make_shared<GenericPublisher>(topics->get_node_base_interface(), topic, type,
                                                 qos, options);
  topics->add_publisher(made, options.callback_group);
  return made;
}

}  // namespace rclcpp
