// How the parts of a node are made.
#pragma once

#include <memory>
#include <string>

#include "rclcpp/node.hpp"

namespace rclcpp {
namespace detail {

node_interfaces::NodeBaseInterface::SharedPtr make_base(const std::string& name,
                                                        const std::string& namespace_,
                                                        const NodeOptions& options);
node_interfaces::NodeGraphInterface::SharedPtr make_graph(
    node_interfaces::NodeBaseInterface::SharedPtr base);
node_interfaces::NodeParametersInterface::SharedPtr make_parameters(
    node_interfaces::NodeBaseInterface::SharedPtr base,
    node_interfaces::NodeTopicsInterface::SharedPtr topics,
    node_interfaces::NodeServicesInterface::SharedPtr services, Clock::SharedPtr clock,
    const NodeOptions& options);

/// Whether a list of parameters asked for with prefixes and a depth has a name.
bool is_listed(const std::string& name, const std::vector<std::string>& prefixes,
               std::uint64_t depth);

}  // namespace detail
}  // namespace rclcpp
