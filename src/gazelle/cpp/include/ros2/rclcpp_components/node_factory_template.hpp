#pragma once

#include <functional>
#include <memory>

#include "rclcpp/node.hpp"
#include "rclcpp_components/node_factory.hpp"

namespace rclcpp_components {

/// The component is a node, or has one behind `get_node_base_interface`.
template <typename NodeT>
class NodeFactoryTemplate : public NodeFactory {
 public:
  NodeInstanceWrapper create_node_instance(const rclcpp::NodeOptions& options) override {
    auto node = std::make_shared<NodeT>(options);
    return NodeInstanceWrapper(node, [](const std::shared_ptr<void>& instance) {
      return std::static_pointer_cast<NodeT>(instance)->get_node_base_interface();
    });
  }
};

}  // namespace rclcpp_components
