#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "rclcpp/node_interfaces/node_base_interface.hpp"

namespace rclcpp_components {

/// A component that was made, whichever class of node it is.
class NodeInstanceWrapper {
 public:
  using NodeBaseInterfaceGetter =
      std::function<rclcpp::node_interfaces::NodeBaseInterface::SharedPtr(
          const std::shared_ptr<void>&)>;
  NodeInstanceWrapper() = default;
  NodeInstanceWrapper(std::shared_ptr<void> instance, NodeBaseInterfaceGetter getter)
      : instance_(std::move(instance)), getter_(std::move(getter)) {}
  std::shared_ptr<void> get_node_instance() const { return instance_; }
  rclcpp::node_interfaces::NodeBaseInterface::SharedPtr get_node_base_interface() {
    return getter_(instance_);
  }

 private:
  std::shared_ptr<void> instance_;
  NodeBaseInterfaceGetter getter_;
};

}  // namespace rclcpp_components
