// Sends frames that move.
#pragma once

#include <cmath>
#include <vector>

#include "geometry_msgs/msg/transform_stamped.hpp"
#include "rclcpp/node_interfaces/get_node_parameters_interface.hpp"
#include "rclcpp/node_interfaces/get_node_topics_interface.hpp"
#include "rclcpp/rclcpp.hpp"
#include "tf2_msgs/msg/tf_message.hpp"
#include "tf2_ros/qos.hpp"
#include "tf2_ros/visibility_control.h"

namespace tf2_ros {

namespace detail {

template <class AllocatorT = std::allocator<void>>
rclcpp::PublisherOptionsWithAllocator<AllocatorT> overridable_publisher(bool durability) {
  using Kind = rclcpp::QosPolicyKind;
  rclcpp::PublisherOptionsWithAllocator<AllocatorT> options;
  if (durability) {
    options.qos_overriding_options = rclcpp::QosOverridingOptions{Kind::Depth, Kind::Durability,
                                                                  Kind::History, Kind::Reliability};
  } else {
    options.qos_overriding_options =
        rclcpp::QosOverridingOptions{Kind::Depth, Kind::History, Kind::Reliability};
  }
  return options;
}

}  // namespace detail

class TF2_ROS_PUBLIC TransformBroadcaster {
 public:
  template <class NodeT, class AllocatorT = std::allocator<void>>
  explicit TransformBroadcaster(NodeT&& node, const rclcpp::QoS& qos = DynamicBroadcasterQoS(),
                                const rclcpp::PublisherOptionsWithAllocator<AllocatorT>& options =
                                    detail::overridable_publisher<AllocatorT>(true))
      : TransformBroadcaster(rclcpp::node_interfaces::get_node_parameters_interface(node),
                             rclcpp::node_interfaces::get_node_topics_interface(node), qos,
                             options) {}
  template <class AllocatorT = std::allocator<void>>
  TransformBroadcaster(rclcpp::node_interfaces::NodeParametersInterface::SharedPtr node_parameters,
                       rclcpp::node_interfaces::NodeTopicsInterface::SharedPtr node_topics,
                       const rclcpp::QoS& qos = DynamicBroadcasterQoS(),
                       const rclcpp::PublisherOptionsWithAllocator<AllocatorT>& options =
                           detail::overridable_publisher<AllocatorT>(true))
      : publisher_(rclcpp::create_publisher<tf2_msgs::msg::TFMessage>(node_parameters, node_topics,
                                                                      "/tf", qos, options)) {}

  void sendTransform(const geometry_msgs::msg::TransformStamped& transform);
  void sendTransform(const std::vector<geometry_msgs::msg::TransformStamped>& transforms);

 private:
  rclcpp::Publisher<tf2_msgs::msg::TFMessage>::SharedPtr publisher_;
};

}  // namespace tf2_ros
