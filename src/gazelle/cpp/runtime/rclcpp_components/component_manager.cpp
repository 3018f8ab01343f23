// Containers: components made by their names and run together.
#include "rclcpp_components/component_manager.hpp"

#include <algorithm>
#include <utility>

#include "class_loader/class_loader.hpp"
#include "component_requests.hpp"
#include "gazelle/class_registry.hpp"
#include "gazelle/core.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp_components {

ComponentManager::ComponentManager(std::weak_ptr<rclcpp::Executor> executor, std::string node_name,
                                   const rclcpp::NodeOptions& node_options)
    : Node(std::move(node_name), node_options), executor_(std::move(executor)) {
  const std::string prefix = "~/_container/";
  using std::placeholders::_1;
  using std::placeholders::_2;
  using std::placeholders::_3;
  loadNode_srv_ = create_service<LoadNode>(
      prefix + "load_node", std::bind(&ComponentManager::on_load_node, this, _1, _2, _3));
  unloadNode_srv_ = create_service<UnloadNode>(
      prefix + "unload_node", std::bind(&ComponentManager::on_unload_node, this, _1, _2, _3));
  listNodes_srv_ = create_service<ListNodes>(
      prefix + "list_nodes", std::bind(&ComponentManager::on_list_nodes, this, _1, _2, _3));
}

ComponentManager::~ComponentManager() {
  for (const auto& one : node_wrappers_) {
    if (const auto executor = executor_.lock()) {
      auto wrapper = one.second;
      executor->remove_node(wrapper.get_node_base_interface());
    }
  }
}

std::vector<ComponentManager::ComponentResource> ComponentManager::get_component_resources(
    const std::string& package_name, const std::string& resource_index) const {
  try {
    return resources_of(package_name, resource_index);
  } catch (const gazelle::Error& error) {
    throw ComponentManagerException(error.what());
  }
}

std::shared_ptr<NodeFactory> ComponentManager::create_component_factory(
    const ComponentResource& resource) {
  auto& known = factories_[resource.first + "@" + resource.second];
  if (known) return known;
  RCLCPP_INFO(get_logger(), "Load Library: %s", resource.second.c_str());
  known = factory_of(resource, [this](const std::string& found) {
    RCLCPP_INFO(get_logger(), "Found class: %s", found.c_str());
  });
  if (known) RCLCPP_INFO(get_logger(), "Instantiate class: %s", class_of(resource).c_str());
  return known;
}

rclcpp::NodeOptions ComponentManager::create_node_options(
    const std::shared_ptr<LoadNode::Request> request) {
  return options_of(*request);
}

void ComponentManager::set_executor(const std::weak_ptr<rclcpp::Executor> executor) {
  executor_ = executor;
}

void ComponentManager::add_node_to_executor(uint64_t node_id) {
  if (const auto executor = executor_.lock()) {
    executor->add_node(node_wrappers_[node_id].get_node_base_interface(), true);
  }
}

void ComponentManager::remove_node_from_executor(uint64_t node_id) {
  if (const auto executor = executor_.lock()) {
    executor->remove_node(node_wrappers_[node_id].get_node_base_interface());
  }
}

void ComponentManager::on_load_node(const std::shared_ptr<rmw_request_id_t>,
                                    const std::shared_ptr<LoadNode::Request> request,
                                    std::shared_ptr<LoadNode::Response> response) {
  try {
    for (const auto& resource : get_component_resources(request->package_name)) {
      if (resource.first != request->plugin_name) continue;
      const auto factory = create_component_factory(resource);
      if (!factory) continue;
      const auto options = create_node_options(request);
      const uint64_t id = unique_id_++;
      try {
        node_wrappers_[id] = factory->create_node_instance(options);
      } catch (const std::exception& error) {
        node_wrappers_.erase(id);
        throw ComponentManagerException("Component constructor threw an exception: " +
                                        std::string(error.what()));
      } catch (...) {
        node_wrappers_.erase(id);
        throw ComponentManagerException("Component constructor threw an exception");
      }
      add_node_to_executor(id);
      response->full_node_name =
          node_wrappers_[id].get_node_base_interface()->get_fully_qualified_name();
      response->unique_id = id;
      response->success = true;
      return;
    }
    RCLCPP_ERROR(get_logger(),
                 "Failed to find class with the requested plugin name '%s' in the loaded library",
                 request->plugin_name.c_str());
    response->error_message =
        "Failed to find class with the requested plugin name '" + request->plugin_name + "'.";
    response->success = false;
  } catch (const std::exception& error) {
    RCLCPP_ERROR(get_logger(), "%s", error.what());
    response->error_message = error.what();
    response->success = false;
  }
}

void ComponentManager::on_unload_node(const std::shared_ptr<rmw_request_id_t>,
                                      const std::shared_ptr<UnloadNode::Request> request,
                                      std::shared_ptr<UnloadNode::Response> response) {
  const auto found = node_wrappers_.find(request->unique_id);
  response->success = found != node_wrappers_.end();
  if (!response->success) {
    response->error_message = "No node found with unique_id: " + std::to_string(request->unique_id);
    RCLCPP_WARN(get_logger(), "%s", response->error_message.c_str());
    return;
  }
  remove_node_from_executor(request->unique_id);
  node_wrappers_.erase(found);
}

void ComponentManager::on_list_nodes(const std::shared_ptr<rmw_request_id_t>,
                                     const std::shared_ptr<ListNodes::Request>,
                                     std::shared_ptr<ListNodes::Response> response) {
  for (auto& one : node_wrappers_) {
    response->unique_ids.push_back(one.first);
    response->full_node_names.emplace_back(
        one.second.get_node_base_interface()->get_fully_qualified_name());
  }
}

// ---- What containers of all kinds do ------------------------------------------------------------

std::vector<Resource> resources_of(const std::string& package, const std::string& index) {
  std::vector<Resource> found;
  const auto rows = gazelle::call("component/resources",
                                  gazelle::Json::object({{"package", package}, {"index", index}}));
  for (const auto& one : rows.items()) found.emplace_back(one[0].as_string(), one[1].as_string());
  return found;
}

std::string class_of(const Resource& resource) {
  return "rclcpp_components::NodeFactoryTemplate<" + resource.first + ">";
}

std::shared_ptr<NodeFactory> factory_of(const Resource& resource,
                                        const std::function<void(const std::string&)>& found) {
  // What the library needs of Gazelle's own is loaded by the host.
  gazelle::call("component/prepare", gazelle::Json::object({{"library", resource.second}}));
  auto loader = std::make_shared<class_loader::ClassLoader>(resource.second);
  for (const auto& one : loader->getAvailableClasses<NodeFactory>()) {
    if (found) found(one);
    if (one == class_of(resource) || one == resource.first) {
      auto made = loader->createSharedInstance<NodeFactory>(one);
      // The library is there as long as what came out of it.
      return std::shared_ptr<NodeFactory>(made.get(), [made, loader](NodeFactory*) {});
    }
  }
  return nullptr;
}

rclcpp::NodeOptions options_of(const composition_interfaces::srv::LoadNode::Request& request) {
  std::vector<rclcpp::Parameter> parameters;
  for (const auto& one : request.parameters) {
    parameters.push_back(rclcpp::Parameter::from_parameter_msg(one));
  }
  std::vector<std::string> words{"--ros-args"};
  for (const auto& rule : request.remap_rules) {
    words.push_back("-r");
    words.push_back(rule);
  }
  if (!request.node_name.empty()) {
    words.push_back("-r");
    words.push_back("__node:=" + request.node_name);
  }
  if (!request.node_namespace.empty()) {
    words.push_back("-r");
    words.push_back("__ns:=" + request.node_namespace);
  }
  auto options = rclcpp::NodeOptions()
                     .use_global_arguments(false)
                     .parameter_overrides(parameters)
                     .arguments(words);
  for (const auto& one : request.extra_arguments) {
    const rclcpp::Parameter extra = rclcpp::Parameter::from_parameter_msg(one);
    const auto as_bool = [&extra]() {
      if (extra.get_type() != rclcpp::PARAMETER_BOOL) {
        throw ComponentManagerException("Extra component argument '" + extra.get_name() +
                                        "' must be a boolean");
      }
      return extra.as_bool();
    };
    if (extra.get_name() == "use_intra_process_comms") {
      options.use_intra_process_comms(as_bool());
    } else if (extra.get_name() == "forward_global_arguments") {
      options.use_global_arguments(as_bool());
    } else if (extra.get_name() == "enable_logger_service") {
      options.enable_logger_service(as_bool());
    }
  }
  return options;
}

}  // namespace rclcpp_components
