#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp_action/server.hpp"

namespace rclcpp_action {

template <typename ActionT>
typename Server<ActionT>::SharedPtr create_server(
    rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base,
    rclcpp::node_interfaces::NodeClockInterface::SharedPtr clock,
    rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr,
    rclcpp::node_interfaces::NodeWaitablesInterface::SharedPtr, const std::string& name,
    typename Server<ActionT>::GoalCallback handle_goal,
    typename Server<ActionT>::CancelCallback handle_cancel,
    typename Server<ActionT>::AcceptedCallback handle_accepted,
    const rcl_action_server_options_t& options = rcl_action_server_get_default_options(),
    rclcpp::CallbackGroup::SharedPtr group = nullptr) {
  auto made = std::make_shared<Server<ActionT>>(base, clock->get_clock(), name, options,
                                                std::move(handle_goal), std::move(handle_cancel),
                                                std::move(handle_accepted), group);
  made->open();
  return made;
}

/// Make an action server for a node of any class.
template <typename ActionT, typename NodeT>
typename Server<ActionT>::SharedPtr create_server(
    NodeT node, const std::string& name, typename Server<ActionT>::GoalCallback handle_goal,
    typename Server<ActionT>::CancelCallback handle_cancel,
    typename Server<ActionT>::AcceptedCallback handle_accepted,
    const rcl_action_server_options_t& options = rcl_action_server_get_default_options(),
    rclcpp::CallbackGroup::SharedPtr group = nullptr) {
  return create_server<ActionT>(
      node->get_node_base_interface(), node->get_node_clock_interface(),
      node->get_node_logging_interface(), node->get_node_waitables_interface(), name,
      std::move(handle_goal), std::move(handle_cancel), std::move(handle_accepted), options, group);
}

}  // namespace rclcpp_action
