// What containers of all kinds do with a request.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "composition_interfaces/srv/load_node.hpp"
#include "rclcpp/node_options.hpp"
#include "rclcpp_components/node_factory.hpp"

namespace rclcpp_components {

/// A class and the file of its library.
using Resource = std::pair<std::string, std::string>;

/// The components that a package registers; compiled first where they are not.
std::vector<Resource> resources_of(const std::string& package, const std::string& index);
/// The name under which a component's factory is registered.
std::string class_of(const Resource& resource);
/// Load a library and make the factory of a component, null where it has none.
std::shared_ptr<NodeFactory> factory_of(const Resource& resource,
                                        const std::function<void(const std::string&)>& found = {});
rclcpp::NodeOptions options_of(const composition_interfaces::srv::LoadNode::Request& request);

}  // namespace rclcpp_components
