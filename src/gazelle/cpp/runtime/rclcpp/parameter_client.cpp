// Parameters of other nodes: asked for, set, and heard of.
#include "rclcpp/parameter_client.hpp"

#include <algorithm>
#include <utility>

#include "rclcpp/parameter_event_handler.hpp"

namespace rclcpp {

using rcl_interfaces::msg::ListParametersResult;
using rcl_interfaces::msg::ParameterDescriptor;
using rcl_interfaces::msg::SetParametersResult;
using namespace rcl_interfaces::srv;  // NOLINT: the six of them

namespace {

/// Send a request; the future has what `read` makes of its response.
template <class T, class ServiceT, class Read>
std::shared_future<T> ask(const std::shared_ptr<Client<ServiceT>>& client,
                          typename ServiceT::Request::SharedPtr request, Read read,
                          std::function<void(std::shared_future<T>)> callback) {
  auto promise = std::make_shared<std::promise<T>>();
  std::shared_future<T> future = promise->get_future().share();
  client->async_send_request(
      request, [promise, future, read, callback](typename Client<ServiceT>::SharedFuture answer) {
        promise->set_value(read(*answer.get()));
        if (callback) callback(future);
      });
  return future;
}

}  // namespace

AsyncParametersClient::AsyncParametersClient(
    node_interfaces::NodeBaseInterface::SharedPtr base,
    node_interfaces::NodeTopicsInterface::SharedPtr topics,
    node_interfaces::NodeGraphInterface::SharedPtr graph,
    node_interfaces::NodeServicesInterface::SharedPtr services, const std::string& remote_node_name,
    const QoS& qos, CallbackGroup::SharedPtr group)
    : topics_(std::move(topics)),
      remote_node_name_(remote_node_name.empty() ? base->get_fully_qualified_name()
                                                 : remote_node_name) {
  const std::string prefix = remote_node_name_ + "/";
  get_ = create_client<GetParameters>(base, graph, services, prefix + "get_parameters", qos, group);
  types_ = create_client<GetParameterTypes>(base, graph, services, prefix + "get_parameter_types",
                                            qos, group);
  set_ = create_client<SetParameters>(base, graph, services, prefix + "set_parameters", qos, group);
  set_atomically_ = create_client<SetParametersAtomically>(
      base, graph, services, prefix + "set_parameters_atomically", qos, group);
  list_ =
      create_client<ListParameters>(base, graph, services, prefix + "list_parameters", qos, group);
  describe_ = create_client<DescribeParameters>(base, graph, services,
                                                prefix + "describe_parameters", qos, group);
}

std::shared_future<std::vector<Parameter>> AsyncParametersClient::get_parameters(
    const std::vector<std::string>& names, Done<std::vector<Parameter>> callback) {
  auto request = std::make_shared<GetParameters::Request>();
  request->names = names;
  return ask<std::vector<Parameter>, GetParameters>(
      get_, request,
      [names](const GetParameters::Response& response) {
        std::vector<Parameter> parameters;
        const std::size_t count = std::min(names.size(), response.values.size());
        for (std::size_t i = 0; i < count; ++i) {
          rcl_interfaces::msg::Parameter one;
          one.name = names[i];
          one.value = response.values[i];
          parameters.push_back(Parameter::from_parameter_msg(one));
        }
        return parameters;
      },
      std::move(callback));
}

std::shared_future<std::vector<ParameterDescriptor>> AsyncParametersClient::describe_parameters(
    const std::vector<std::string>& names, Done<std::vector<ParameterDescriptor>> callback) {
  auto request = std::make_shared<DescribeParameters::Request>();
  request->names = names;
  return ask<std::vector<ParameterDescriptor>, DescribeParameters>(
      describe_, request,
      [](const DescribeParameters::Response& response) { return response.descriptors; },
      std::move(callback));
}

std::shared_future<std::vector<ParameterType>> AsyncParametersClient::get_parameter_types(
    const std::vector<std::string>& names, Done<std::vector<ParameterType>> callback) {
  auto request = std::make_shared<GetParameterTypes::Request>();
  request->names = names;
  return ask<std::vector<ParameterType>, GetParameterTypes>(
      types_, request,
      [](const GetParameterTypes::Response& response) {
        std::vector<ParameterType> types;
        for (const auto one : response.types) types.push_back(static_cast<ParameterType>(one));
        return types;
      },
      std::move(callback));
}

std::shared_future<AsyncParametersClient::Results> AsyncParametersClient::set_parameters(
    const std::vector<Parameter>& parameters, Done<Results> callback) {
  auto request = std::make_shared<SetParameters::Request>();
  for (const auto& one : parameters) request->parameters.push_back(one.to_parameter_msg());
  return ask<Results, SetParameters>(
      set_, request, [](const SetParameters::Response& response) { return response.results; },
      std::move(callback));
}

std::shared_future<SetParametersResult> AsyncParametersClient::set_parameters_atomically(
    const std::vector<Parameter>& parameters, Done<SetParametersResult> callback) {
  auto request = std::make_shared<SetParametersAtomically::Request>();
  for (const auto& one : parameters) request->parameters.push_back(one.to_parameter_msg());
  return ask<SetParametersResult, SetParametersAtomically>(
      set_atomically_, request,
      [](const SetParametersAtomically::Response& response) { return response.result; },
      std::move(callback));
}

std::shared_future<AsyncParametersClient::Results> AsyncParametersClient::delete_parameters(
    const std::vector<std::string>& names) {
  std::vector<Parameter> parameters;
  for (const auto& one : names) parameters.emplace_back(one);
  return set_parameters(parameters);
}

std::shared_future<AsyncParametersClient::Results> AsyncParametersClient::load_parameters(
    const std::string& yaml_filename) {
  return load_parameters(parameter_map_from_yaml_file(yaml_filename, remote_node_name_.c_str()));
}

std::shared_future<AsyncParametersClient::Results> AsyncParametersClient::load_parameters(
    const ParameterMap& map) {
  const auto parameters = parameters_from_map(map, remote_node_name_.c_str());
  if (parameters.empty()) {
    throw exceptions::InvalidParametersException("No valid parameters found");
  }
  return set_parameters(parameters);
}

std::shared_future<ListParametersResult> AsyncParametersClient::list_parameters(
    const std::vector<std::string>& prefixes, uint64_t depth, Done<ListParametersResult> callback) {
  auto request = std::make_shared<ListParameters::Request>();
  request->prefixes = prefixes;
  request->depth = depth;
  return ask<ListParametersResult, ListParameters>(
      list_, request, [](const ListParameters::Response& response) { return response.result; },
      std::move(callback));
}

bool AsyncParametersClient::service_is_ready() const {
  return get_->service_is_ready() && types_->service_is_ready() && set_->service_is_ready() &&
         list_->service_is_ready() && describe_->service_is_ready();
}

bool AsyncParametersClient::wait_for_service_nanoseconds(std::chrono::nanoseconds timeout) {
  const auto end =
      std::chrono::steady_clock::now() + std::max(timeout, std::chrono::nanoseconds(0));
  const std::vector<std::shared_ptr<ClientBase>> all{get_, types_, set_, list_, describe_};
  for (const auto& one : all) {
    auto left = std::chrono::nanoseconds(-1);
    if (timeout >= std::chrono::nanoseconds(0)) {
      left = std::max(std::chrono::nanoseconds(0),
                      std::chrono::nanoseconds(end - std::chrono::steady_clock::now()));
    }
    if (!one->wait_for_service(left)) return false;
  }
  return true;
}

// ---- Events -------------------------------------------------------------------------------------

ParameterEventCallbackHandle::SharedPtr ParameterEventHandler::add_parameter_event_callback(
    ParameterEventCallbackType callback) {
  auto handle = std::make_shared<ParameterEventCallbackHandle>();
  handle->callback = std::move(callback);
  std::lock_guard<std::recursive_mutex> lock(callbacks_->mutex);
  callbacks_->events.emplace_front(handle);
  return handle;
}

void ParameterEventHandler::remove_parameter_event_callback(
    ParameterEventCallbackHandle::SharedPtr handle) {
  std::lock_guard<std::recursive_mutex> lock(callbacks_->mutex);
  const auto found = std::find_if(callbacks_->events.begin(), callbacks_->events.end(),
                                  [&](const auto& one) { return one.lock() == handle; });
  if (found == callbacks_->events.end()) throw std::runtime_error("Callback doesn't exist");
  callbacks_->events.erase(found);
}

ParameterCallbackHandle::SharedPtr ParameterEventHandler::add_parameter_callback(
    const std::string& parameter_name, ParameterCallbackType callback,
    const std::string& node_name) {
  auto handle = std::make_shared<ParameterCallbackHandle>();
  handle->callback = std::move(callback);
  handle->parameter_name = parameter_name;
  handle->node_name = resolve_path(node_name);
  std::lock_guard<std::recursive_mutex> lock(callbacks_->mutex);
  callbacks_->parameters.emplace_front(handle);
  return handle;
}

void ParameterEventHandler::remove_parameter_callback(ParameterCallbackHandle::SharedPtr handle) {
  std::lock_guard<std::recursive_mutex> lock(callbacks_->mutex);
  const auto found = std::find_if(callbacks_->parameters.begin(), callbacks_->parameters.end(),
                                  [&](const auto& one) { return one.lock() == handle; });
  if (found == callbacks_->parameters.end()) throw std::runtime_error("Callback doesn't exist");
  callbacks_->parameters.erase(found);
}

bool ParameterEventHandler::get_parameter_from_event(
    const rcl_interfaces::msg::ParameterEvent& event, Parameter& parameter,
    const std::string& parameter_name, const std::string& node_name) {
  if (event.node != node_name) return false;
  for (const auto* list : {&event.new_parameters, &event.changed_parameters}) {
    for (const auto& one : *list) {
      if (one.name != parameter_name) continue;
      parameter = Parameter::from_parameter_msg(one);
      return true;
    }
  }
  return false;
}

Parameter ParameterEventHandler::get_parameter_from_event(
    const rcl_interfaces::msg::ParameterEvent& event, const std::string& parameter_name,
    const std::string& node_name) {
  Parameter found;
  if (!get_parameter_from_event(event, found, parameter_name, node_name)) {
    throw std::runtime_error("Parameter '" + parameter_name + "' of node '" + node_name +
                             "' is not part of parameter event");
  }
  return found;
}

std::vector<Parameter> ParameterEventHandler::get_parameters_from_event(
    const rcl_interfaces::msg::ParameterEvent& event) {
  std::vector<Parameter> found;
  for (const auto* list : {&event.new_parameters, &event.changed_parameters}) {
    for (const auto& one : *list) found.push_back(Parameter::from_parameter_msg(one));
  }
  return found;
}

void ParameterEventHandler::Callbacks::hear(const rcl_interfaces::msg::ParameterEvent& event) {
  std::lock_guard<std::recursive_mutex> lock(mutex);
  // Callbacks may remove themselves and others while they are called.
  const auto parameters_now = parameters;
  for (const auto& weak : parameters_now) {
    const auto handle = weak.lock();
    Parameter found;
    if (handle &&
        get_parameter_from_event(event, found, handle->parameter_name, handle->node_name)) {
      handle->callback(found);
    }
  }
  const auto events_now = events;
  for (const auto& weak : events_now) {
    if (const auto handle = weak.lock()) handle->callback(event);
  }
}

std::string ParameterEventHandler::resolve_path(const std::string& path) const {
  if (path.empty()) return base_->get_fully_qualified_name();
  if (path.front() == '/') return path;
  const std::string space = base_->get_namespace();
  return (space == "/" ? "" : space) + "/" + path;
}

}  // namespace rclcpp
