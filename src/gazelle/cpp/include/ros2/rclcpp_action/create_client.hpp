#pragma once

#include <memory>
#include <string>

#include "rclcpp_action/client.hpp"

namespace rclcpp_action {

template <typename ActionT>
typename Client<ActionT>::SharedPtr create_client(
    rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base,
    rclcpp::node_interfaces::NodeGraphInterface::SharedPtr,
    rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr,
    rclcpp::node_interfaces::NodeWaitablesInterface::SharedPtr, const std::string& name,
    rclcpp::CallbackGroup::SharedPtr group = nullptr,
    const rcl_action_client_options_t& options = rcl_action_client_get_default_options()) {
  return std::make_shared<Client<ActionT>>(base, name, options, group);
}

/// Make an action client for a node of any class.
template <typename ActionT, typename NodeT>
typename Client<ActionT>::SharedPtr create_client(
    NodeT node, const std::string& name, rclcpp::CallbackGroup::SharedPtr group = nullptr,
    const rcl_action_client_options_t& options = rcl_action_client_get_default_options()) {
  return std::make_shared<Client<ActionT>>(node->get_node_base_interface(), name, options, group);
}

}  // namespace rclcpp_action
