// Sends frames that never move; who comes late hears of all that this object ever sent.
#pragma once

#include <vector>

#include "tf2_ros/transform_broadcaster.hpp"

namespace tf2_ros {

class TF2_ROS_PUBLIC StaticTransformBroadcaster {
 public:
  template <class NodeT, class AllocatorT = std::allocator<void>>
  explicit StaticTransformBroadcaster(
      NodeT&& node, const rclcpp::QoS& qos = StaticBroadcasterQoS(),
      const rclcpp::PublisherOptionsWithAllocator<AllocatorT>& options =
          detail::overridable_publisher<AllocatorT>(false))
      : StaticTransformBroadcaster(rclcpp::node_interfaces::get_node_parameters_interface(node),
                                   rclcpp::node_interfaces::get_node_topics_interface(node), qos,
                                   options) {}
  template <class AllocatorT = std::allocator<void>>
  StaticTransformBroadcaster(
      rclcpp::node_interfaces::NodeParametersInterface::SharedPtr node_parameters,
      rclcpp::node_interfaces::NodeTopicsInterface::SharedPtr node_topics,
      const rclcpp::QoS& qos = StaticBroadcasterQoS(),
      const rclcpp::PublisherOptionsWithAllocator<AllocatorT>& options =
          detail::overridable_publisher<AllocatorT>(false))
      : publisher_(rclcpp::create_publisher<tf2_msgs::msg::TFMessage>(
            node_parameters, node_topics, "/tf_static", qos, options)) {}

  void sendTransform(const geometry_msgs::msg::TransformStamped& transform);
  void sendTransform(const std::vector<geometry_msgs::msg::TransformStamped>& transforms);

 private:
  rclcpp::Publisher<tf2_msgs::msg::TFMessage>::SharedPtr publisher_;
  tf2_msgs::msg::TFMessage net_message_;
};

}  // namespace tf2_ros
