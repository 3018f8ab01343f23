#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rcl_interfaces/msg/parameter.hpp"
#include "rcl_interfaces/msg/parameter_event.hpp"
#include "rcl_interfaces/msg/parameter_value.hpp"
#include "rcl_interfaces/srv/describe_parameters.hpp"
#include "rcl_interfaces/srv/get_parameter_types.hpp"
#include "rcl_interfaces/srv/get_parameters.hpp"
#include "rcl_interfaces/srv/list_parameters.hpp"
#include "rcl_interfaces/srv/set_parameters.hpp"
#include "rcl_interfaces/srv/set_parameters_atomically.hpp"
#include "rclcpp/executors.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node.hpp"
#include "rclcpp/parameter_map.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp {

/// Asks for the parameters of another node; answers come while an executor spins.
class RCLCPP_PUBLIC AsyncParametersClient {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(AsyncParametersClient)
  using Results = std::vector<rcl_interfaces::msg::SetParametersResult>;
  template <typename T>
  using Done = std::function<void(std::shared_future<T>)>;

  AsyncParametersClient(node_interfaces::NodeBaseInterface::SharedPtr base,
                        node_interfaces::NodeTopicsInterface::SharedPtr topics,
                        node_interfaces::NodeGraphInterface::SharedPtr graph,
                        node_interfaces::NodeServicesInterface::SharedPtr services,
                        const std::string& remote_node_name = "", const QoS& qos = ParametersQoS(),
                        CallbackGroup::SharedPtr group = nullptr);
  template <typename NodeT>
  explicit AsyncParametersClient(std::shared_ptr<NodeT> node,
                                 const std::string& remote_node_name = "",
                                 const QoS& qos = ParametersQoS(),
                                 CallbackGroup::SharedPtr group = nullptr)
      : AsyncParametersClient(node.get(), remote_node_name, qos, group) {}
  template <typename NodeT>
  explicit AsyncParametersClient(NodeT* node, const std::string& remote_node_name = "",
                                 const QoS& qos = ParametersQoS(),
                                 CallbackGroup::SharedPtr group = nullptr)
      : AsyncParametersClient(node->get_node_base_interface(), node->get_node_topics_interface(),
                              node->get_node_graph_interface(), node->get_node_services_interface(),
                              remote_node_name, qos, group) {}

  std::shared_future<std::vector<Parameter>> get_parameters(
      const std::vector<std::string>& names, Done<std::vector<Parameter>> callback = nullptr);
  std::shared_future<std::vector<rcl_interfaces::msg::ParameterDescriptor>> describe_parameters(
      const std::vector<std::string>& names,
      Done<std::vector<rcl_interfaces::msg::ParameterDescriptor>> callback = nullptr);
  std::shared_future<std::vector<ParameterType>> get_parameter_types(
      const std::vector<std::string>& names, Done<std::vector<ParameterType>> callback = nullptr);
  std::shared_future<Results> set_parameters(const std::vector<Parameter>& parameters,
                                             Done<Results> callback = nullptr);
  std::shared_future<rcl_interfaces::msg::SetParametersResult> set_parameters_atomically(
      const std::vector<Parameter>& parameters,
      Done<rcl_interfaces::msg::SetParametersResult> callback = nullptr);
  std::shared_future<Results> delete_parameters(const std::vector<std::string>& names);
  std::shared_future<Results> load_parameters(const std::string& yaml_filename);
  std::shared_future<Results> load_parameters(const ParameterMap& map);
  std::shared_future<rcl_interfaces::msg::ListParametersResult> list_parameters(
      const std::vector<std::string>& prefixes, uint64_t depth,
      Done<rcl_interfaces::msg::ListParametersResult> callback = nullptr);

  template <typename CallbackT>
  Subscription<rcl_interfaces::msg::ParameterEvent>::SharedPtr on_parameter_event(
      CallbackT&& callback, const QoS& qos = ParameterEventsQoS(),
      const SubscriptionOptions& options = SubscriptionOptions()) {
    return on_parameter_event(topics_, std::forward<CallbackT>(callback), qos, options);
  }
  template <typename CallbackT, typename NodeT>
  static Subscription<rcl_interfaces::msg::ParameterEvent>::SharedPtr on_parameter_event(
      NodeT&& node, CallbackT&& callback, const QoS& qos = ParameterEventsQoS(),
      const SubscriptionOptions& options = SubscriptionOptions()) {
    return create_subscription<rcl_interfaces::msg::ParameterEvent>(
        node, "/parameter_events", qos, std::forward<CallbackT>(callback), options);
  }

  bool service_is_ready() const;
  template <typename RepT = int64_t, typename RatioT = std::milli>
  bool wait_for_service(
      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return wait_for_service_nanoseconds(
        std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }
  const std::string& remote_node_name() const { return remote_node_name_; }

 private:
  bool wait_for_service_nanoseconds(std::chrono::nanoseconds timeout);
  node_interfaces::NodeTopicsInterface::SharedPtr topics_;
  Client<rcl_interfaces::srv::GetParameters>::SharedPtr get_;
  Client<rcl_interfaces::srv::GetParameterTypes>::SharedPtr types_;
  Client<rcl_interfaces::srv::SetParameters>::SharedPtr set_;
  Client<rcl_interfaces::srv::SetParametersAtomically>::SharedPtr set_atomically_;
  Client<rcl_interfaces::srv::ListParameters>::SharedPtr list_;
  Client<rcl_interfaces::srv::DescribeParameters>::SharedPtr describe_;
  std::string remote_node_name_;
};

/// The same, spinning an executor of its own until the answer is there.
class RCLCPP_PUBLIC SyncParametersClient {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(SyncParametersClient)
  using Nanoseconds = std::chrono::nanoseconds;

  template <typename NodeT>
  explicit SyncParametersClient(std::shared_ptr<NodeT> node,
                                const std::string& remote_node_name = "",
                                const QoS& qos = ParametersQoS())
      : SyncParametersClient(std::make_shared<executors::SingleThreadedExecutor>(), node.get(),
                             remote_node_name, qos) {}
  template <typename NodeT>
  SyncParametersClient(Executor::SharedPtr executor, std::shared_ptr<NodeT> node,
                       const std::string& remote_node_name = "", const QoS& qos = ParametersQoS())
      : SyncParametersClient(executor, node.get(), remote_node_name, qos) {}
  template <typename NodeT>
  explicit SyncParametersClient(NodeT* node, const std::string& remote_node_name = "",
                                const QoS& qos = ParametersQoS())
      : SyncParametersClient(std::make_shared<executors::SingleThreadedExecutor>(), node,
                             remote_node_name, qos) {}
  template <typename NodeT>
  SyncParametersClient(Executor::SharedPtr executor, NodeT* node,
                       const std::string& remote_node_name = "", const QoS& qos = ParametersQoS())
      : executor_(executor),
        base_(node->get_node_base_interface()),
        client_(std::make_shared<AsyncParametersClient>(node, remote_node_name, qos)) {}

  template <typename Rep = int64_t, typename Ratio = std::milli>
  std::vector<Parameter> get_parameters(
      const std::vector<std::string>& names,
      std::chrono::duration<Rep, Ratio> timeout = std::chrono::duration<Rep, Ratio>(-1)) {
    return waited(client_->get_parameters(names), timeout);
  }
  bool has_parameter(const std::string& name) {
    const auto found = list_parameters({name}, 1).names;
    return std::find(found.begin(), found.end(), name) != found.end();
  }
  template <typename T>
  T get_parameter(const std::string& name, const T& fallback) {
    return get_parameter_impl<T>(name, [&fallback]() { return fallback; });
  }
  template <typename T>
  T get_parameter(const std::string& name) {
    return get_parameter_impl<T>(
        name, [&name]() -> T { throw std::runtime_error("Parameter '" + name + "' is not set"); });
  }
  template <typename Rep = int64_t, typename Ratio = std::milli>
  std::vector<rcl_interfaces::msg::ParameterDescriptor> describe_parameters(
      const std::vector<std::string>& names,
      std::chrono::duration<Rep, Ratio> timeout = std::chrono::duration<Rep, Ratio>(-1)) {
    return waited(client_->describe_parameters(names), timeout);
  }
  template <typename Rep = int64_t, typename Ratio = std::milli>
  std::vector<ParameterType> get_parameter_types(
      const std::vector<std::string>& names,
      std::chrono::duration<Rep, Ratio> timeout = std::chrono::duration<Rep, Ratio>(-1)) {
    return waited(client_->get_parameter_types(names), timeout);
  }
  template <typename Rep = int64_t, typename Ratio = std::milli>
  std::vector<rcl_interfaces::msg::SetParametersResult> set_parameters(
      const std::vector<Parameter>& parameters,
      std::chrono::duration<Rep, Ratio> timeout = std::chrono::duration<Rep, Ratio>(-1)) {
    return waited(client_->set_parameters(parameters), timeout);
  }
  template <typename Rep = int64_t, typename Ratio = std::milli>
  std::vector<rcl_interfaces::msg::SetParametersResult> delete_parameters(
      const std::vector<std::string>& names,
      std::chrono::duration<Rep, Ratio> timeout = std::chrono::duration<Rep, Ratio>(-1)) {
    return waited(client_->delete_parameters(names), timeout);
  }
  template <typename Rep = int64_t, typename Ratio = std::milli>
  std::vector<rcl_interfaces::msg::SetParametersResult> load_parameters(
      const std::string& yaml_filename,
      std::chrono::duration<Rep, Ratio> timeout = std::chrono::duration<Rep, Ratio>(-1)) {
    return waited(client_->load_parameters(yaml_filename), timeout);
  }
  template <typename Rep = int64_t, typename Ratio = std::milli>
  rcl_interfaces::msg::SetParametersResult set_parameters_atomically(
      const std::vector<Parameter>& parameters,
      std::chrono::duration<Rep, Ratio> timeout = std::chrono::duration<Rep, Ratio>(-1)) {
    return waited(client_->set_parameters_atomically(parameters), timeout,
                  "Unable to get result of set parameters service call.");
  }
  template <typename Rep = int64_t, typename Ratio = std::milli>
  rcl_interfaces::msg::ListParametersResult list_parameters(
      const std::vector<std::string>& prefixes, uint64_t depth,
      std::chrono::duration<Rep, Ratio> timeout = std::chrono::duration<Rep, Ratio>(-1)) {
    return waited(client_->list_parameters(prefixes, depth), timeout,
                  "Unable to get result of list parameters service call.");
  }
  template <typename CallbackT>
  Subscription<rcl_interfaces::msg::ParameterEvent>::SharedPtr on_parameter_event(
      CallbackT&& callback) {
    return client_->on_parameter_event(std::forward<CallbackT>(callback));
  }
  template <typename CallbackT, typename NodeT>
  static Subscription<rcl_interfaces::msg::ParameterEvent>::SharedPtr on_parameter_event(
      NodeT&& node, CallbackT&& callback, const QoS& qos = ParameterEventsQoS()) {
    return AsyncParametersClient::on_parameter_event(node, std::forward<CallbackT>(callback), qos);
  }
  bool service_is_ready() const { return client_->service_is_ready(); }
  template <typename RepT = int64_t, typename RatioT = std::milli>
  bool wait_for_service(
      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return client_->wait_for_service(timeout);
  }

 private:
  template <typename T, typename Rep, typename Ratio>
  T waited(std::shared_future<T> future, std::chrono::duration<Rep, Ratio> timeout,
           const char* failure = nullptr) {
    const auto code =
        executors::spin_node_until_future_complete(*executor_, base_, future, timeout);
    if (code == FutureReturnCode::SUCCESS) return future.get();
    if (failure) throw std::runtime_error(failure);
    return T();
  }
  template <typename T, typename Function>
  T get_parameter_impl(const std::string& name, Function otherwise) {
    const auto found = get_parameters({name});
    if (found.size() != 1 || found[0].get_type() == PARAMETER_NOT_SET) return otherwise();
    return static_cast<T>(found[0].get_value<T>());
  }
  Executor::SharedPtr executor_;
  node_interfaces::NodeBaseInterface::SharedPtr base_;
  AsyncParametersClient::SharedPtr client_;
};

}  // namespace rclcpp
