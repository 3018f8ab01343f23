#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "rclcpp/create_client.hpp"
#include "rclcpp/create_publisher.hpp"
#include "rclcpp/create_service.hpp"
#include "rclcpp/create_subscription.hpp"
#include "rclcpp/create_timer.hpp"
#include "rclcpp/detail/interface_of.hpp"
#include "rclcpp/generic_client.hpp"
#include "rclcpp/generic_publisher.hpp"
#include "rclcpp/generic_subscription.hpp"
#include "rclcpp/node_options.hpp"

namespace rclcpp {
namespace detail {

struct NodeParts;

/// What nodes of all classes can do; `Node` and `LifecycleNode` are this and little more.
class RCLCPP_PUBLIC NodeFunctions {
 public:
  using OnSetParametersCallbackHandle = node_interfaces::OnSetParametersCallbackHandle;
  using OnParametersSetCallbackType =
      node_interfaces::NodeParametersInterface::OnSetParametersCallbackType;
  using OnSetParametersCallbackType = OnParametersSetCallbackType;
  using PreSetParametersCallbackHandle = node_interfaces::PreSetParametersCallbackHandle;
  using PreSetParametersCallbackType =
      node_interfaces::NodeParametersInterface::PreSetParametersCallbackType;
  using PostSetParametersCallbackHandle = node_interfaces::PostSetParametersCallbackHandle;
  using PostSetParametersCallbackType =
      node_interfaces::NodeParametersInterface::PostSetParametersCallbackType;
  using Descriptor = rcl_interfaces::msg::ParameterDescriptor;
  using Result = rcl_interfaces::msg::SetParametersResult;
  using NamesAndTypes = node_interfaces::NodeGraphInterface::NamesAndTypes;

  const char* get_name() const { return base_->get_name(); }
  const char* get_namespace() const { return base_->get_namespace(); }
  const char* get_fully_qualified_name() const { return base_->get_fully_qualified_name(); }
  Logger get_logger() const { return logging_->get_logger(); }

  // ---- Callback groups and ends of the graph ---------------------------------------------------

  CallbackGroup::SharedPtr create_callback_group(
      CallbackGroupType type, bool automatically_add_to_executor_with_node = true) {
    return base_->create_callback_group(type, automatically_add_to_executor_with_node);
  }
  void for_each_callback_group(
      const node_interfaces::NodeBaseInterface::CallbackGroupFunction& function) {
    base_->for_each_callback_group(function);
  }

  template <typename MessageT, typename AllocatorT = std::allocator<void>,
            typename PublisherT = Publisher<MessageT, AllocatorT>>
  std::shared_ptr<PublisherT> create_publisher(
      const std::string& topic, const QoS& qos,
      const PublisherOptionsWithAllocator<AllocatorT>& options =
          PublisherOptionsWithAllocator<AllocatorT>()) {
    return rclcpp::create_publisher<MessageT, AllocatorT, PublisherT>(
        parameters_, topics_, extended(topic), qos, options);
  }

  template <typename MessageT, typename CallbackT, typename AllocatorT = std::allocator<void>,
            typename SubscriptionT = Subscription<MessageT, AllocatorT>,
            typename MessageMemoryStrategyT = typename SubscriptionT::MessageMemoryStrategyType>
  std::shared_ptr<SubscriptionT> create_subscription(
      const std::string& topic, const QoS& qos, CallbackT&& callback,
      const SubscriptionOptionsWithAllocator<AllocatorT>& options =
          SubscriptionOptionsWithAllocator<AllocatorT>(),
      typename MessageMemoryStrategyT::SharedPtr strategy = nullptr) {
    return rclcpp::create_subscription<MessageT, CallbackT, AllocatorT, SubscriptionT,
                                       MessageMemoryStrategyT>(
        parameters_, topics_, extended(topic), qos, std::forward<CallbackT>(callback), options,
        strategy);
  }

  template <typename DurationRepT = int64_t, typename DurationT = std::milli, typename CallbackT>
  std::shared_ptr<WallTimer<std::decay_t<CallbackT>>> create_wall_timer(
      std::chrono::duration<DurationRepT, DurationT> period, CallbackT callback,
      CallbackGroup::SharedPtr group = nullptr, bool autostart = true) {
    return std::static_pointer_cast<WallTimer<std::decay_t<CallbackT>>>(rclcpp::create_wall_timer(
        period, std::move(callback), group, base_.get(), timers_.get(), autostart));
  }
  template <typename DurationRepT = int64_t, typename DurationT = std::milli, typename CallbackT>
  std::shared_ptr<GenericTimer<std::decay_t<CallbackT>>> create_timer(
      std::chrono::duration<DurationRepT, DurationT> period, CallbackT callback,
      CallbackGroup::SharedPtr group = nullptr, bool autostart = true) {
    return std::static_pointer_cast<GenericTimer<std::decay_t<CallbackT>>>(rclcpp::create_timer(
        get_clock(), period, std::move(callback), group, base_.get(), timers_.get(), autostart));
  }

  template <typename ServiceT>
  typename Client<ServiceT>::SharedPtr create_client(const std::string& name,
                                                     const QoS& qos = ServicesQoS(),
                                                     CallbackGroup::SharedPtr group = nullptr) {
    return rclcpp::create_client<ServiceT>(base_, graph_, services_, extended(name), qos, group);
  }
  template <typename ServiceT>
  typename Client<ServiceT>::SharedPtr create_client(const std::string& name,
                                                     const rmw_qos_profile_t& profile,
                                                     CallbackGroup::SharedPtr group = nullptr) {
    return rclcpp::create_client<ServiceT>(base_, graph_, services_, extended(name), profile,
                                           group);
  }
  template <typename ServiceT, typename CallbackT>
  typename Service<ServiceT>::SharedPtr create_service(const std::string& name,
                                                       CallbackT&& callback,
                                                       const QoS& qos = ServicesQoS(),
                                                       CallbackGroup::SharedPtr group = nullptr) {
    return rclcpp::create_service<ServiceT>(base_, services_, extended(name),
                                            std::forward<CallbackT>(callback), qos, group);
  }
  template <typename ServiceT, typename CallbackT>
  typename Service<ServiceT>::SharedPtr create_service(const std::string& name,
                                                       CallbackT&& callback,
                                                       const rmw_qos_profile_t& profile,
                                                       CallbackGroup::SharedPtr group = nullptr) {
    return rclcpp::create_service<ServiceT>(base_, services_, extended(name),
                                            std::forward<CallbackT>(callback), profile, group);
  }

  GenericClient::SharedPtr create_generic_client(const std::string& service,
                                                 const std::string& type,
                                                 const QoS& qos = ServicesQoS(),
                                                 CallbackGroup::SharedPtr group = nullptr) {
    auto made = std::make_shared<GenericClient>(base_.get(), extended(service), type, qos);
    services_->add_client(made, group);
    return made;
  }
  template <typename AllocatorT = std::allocator<void>>
  GenericPublisher::SharedPtr create_generic_publisher(
      const std::string& topic, const std::string& type, const QoS& qos,
      const PublisherOptionsWithAllocator<AllocatorT>& options =
          PublisherOptionsWithAllocator<AllocatorT>()) {
    return rclcpp::create_generic_publisher(topics_, extended(topic), type, qos, options);
  }
  template <typename CallbackT, typename AllocatorT = std::allocator<void>>
  GenericSubscription::SharedPtr create_generic_subscription(
      const std::string& topic, const std::string& type, const QoS& qos, CallbackT&& callback,
      const SubscriptionOptionsWithAllocator<AllocatorT>& options =
          SubscriptionOptionsWithAllocator<AllocatorT>()) {
    return rclcpp::create_generic_subscription(topics_, extended(topic), type, qos,
                                               std::forward<CallbackT>(callback), options);
  }

  // ---- Parameters ------------------------------------------------------------------------------

  const ParameterValue& declare_parameter(const std::string& name,
                                          const ParameterValue& default_value,
                                          const Descriptor& descriptor = Descriptor(),
                                          bool ignore_override = false) {
    return parameters_->declare_parameter(in_sub(name), default_value, descriptor, ignore_override);
  }
  const ParameterValue& declare_parameter(const std::string& name, ParameterType type,
                                          const Descriptor& descriptor = Descriptor{},
                                          bool ignore_override = false) {
    return parameters_->declare_parameter(in_sub(name), type, descriptor, ignore_override);
  }
  /// Without a value: the parameter is not set and may become of any type (before Galactic).
  const ParameterValue& declare_parameter(const std::string& name) {
    Descriptor descriptor;
    descriptor.dynamic_typing = true;
    return parameters_->declare_parameter(in_sub(name), ParameterValue(), descriptor);
  }
  template <typename ParameterT>
  auto declare_parameter(const std::string& name, const ParameterT& default_value,
                         const Descriptor& descriptor = Descriptor(),
                         bool ignore_override = false) {
    try {
      return std::decay_t<decltype(std::declval<ParameterValue>().get<shown_as<ParameterT>>())>(
          declare_parameter(name, ParameterValue(default_value), descriptor, ignore_override)
              .template get<shown_as<ParameterT>>());
    } catch (const ParameterTypeException& error) {
      throw exceptions::InvalidParameterTypeException(name, error.what());
    }
  }
  template <typename ParameterT>
  auto declare_parameter(const std::string& name, const Descriptor& descriptor = Descriptor(),
                         bool ignore_override = false) {
    // The value has to come from outside: its type is the template's.
    const ParameterType type = ParameterValue(ParameterT{}).get_type();
    try {
      return std::decay_t<decltype(std::declval<ParameterValue>().get<ParameterT>())>(
          declare_parameter(name, type, descriptor, ignore_override).template get<ParameterT>());
    } catch (const ParameterTypeException&) {
      throw exceptions::UninitializedStaticallyTypedParameterException(name);
    }
  }
  template <typename ParameterT>
  std::vector<ParameterT> declare_parameters(const std::string& prefix,
                                             const std::map<std::string, ParameterT>& values,
                                             bool ignore_overrides = false) {
    std::vector<ParameterT> declared;
    for (const auto& one : values) {
      declared.push_back(static_cast<ParameterT>(
          declare_parameter(prefix.empty() ? one.first : prefix + "." + one.first, one.second,
                            Descriptor(), ignore_overrides)));
    }
    return declared;
  }
  template <typename ParameterT>
  std::vector<ParameterT> declare_parameters(
      const std::string& prefix,
      const std::map<std::string, std::pair<ParameterT, Descriptor>>& values,
      bool ignore_overrides = false) {
    std::vector<ParameterT> declared;
    for (const auto& one : values) {
      declared.push_back(static_cast<ParameterT>(
          declare_parameter(prefix.empty() ? one.first : prefix + "." + one.first, one.second.first,
                            one.second.second, ignore_overrides)));
    }
    return declared;
  }

  void undeclare_parameter(const std::string& name) {
    parameters_->undeclare_parameter(in_sub(name));
  }
  bool has_parameter(const std::string& name) const {
    return parameters_->has_parameter(in_sub(name));
  }
  Result set_parameter(const Parameter& parameter) {
    return set_parameters_atomically({parameter});
  }
  std::vector<Result> set_parameters(const std::vector<Parameter>& parameters) {
    return parameters_->set_parameters(parameters);
  }
  Result set_parameters_atomically(const std::vector<Parameter>& parameters) {
    return parameters_->set_parameters_atomically(parameters);
  }
  Parameter get_parameter(const std::string& name) const {
    return parameters_->get_parameter(in_sub(name));
  }
  bool get_parameter(const std::string& name, Parameter& parameter) const {
    return parameters_->get_parameter(in_sub(name), parameter);
  }
  template <typename ParameterT>
  bool get_parameter(const std::string& name, ParameterT& parameter) const {
    Parameter found;
    const bool is_there = get_parameter(name, found);
    if (is_there) parameter = static_cast<ParameterT>(found.get_value<ParameterT>());
    return is_there;
  }
  template <typename ParameterT>
  bool get_parameter_or(const std::string& name, ParameterT& parameter,
                        const ParameterT& alternative) const {
    const bool is_there = get_parameter(name, parameter);
    if (!is_there) parameter = alternative;
    return is_there;
  }
  template <typename ParameterT>
  ParameterT get_parameter_or(const std::string& name, const ParameterT& alternative) const {
    ParameterT parameter;
    get_parameter_or(name, parameter, alternative);
    return parameter;
  }
  std::vector<Parameter> get_parameters(const std::vector<std::string>& names) const {
    return parameters_->get_parameters(names);
  }
  template <typename ParameterT>
  bool get_parameters(const std::string& prefix, std::map<std::string, ParameterT>& values) const {
    std::map<std::string, Parameter> found;
    const bool any = parameters_->get_parameters_by_prefix(prefix, found);
    for (const auto& one : found) {
      values[one.first] = static_cast<ParameterT>(one.second.get_value<ParameterT>());
    }
    return any;
  }
  Descriptor describe_parameter(const std::string& name) const;
  std::vector<Descriptor> describe_parameters(const std::vector<std::string>& names) const {
    return parameters_->describe_parameters(names);
  }
  std::vector<uint8_t> get_parameter_types(const std::vector<std::string>& names) const {
    return parameters_->get_parameter_types(names);
  }
  rcl_interfaces::msg::ListParametersResult list_parameters(
      const std::vector<std::string>& prefixes, uint64_t depth) const {
    return parameters_->list_parameters(prefixes, depth);
  }

  PreSetParametersCallbackHandle::SharedPtr add_pre_set_parameters_callback(
      PreSetParametersCallbackType callback) {
    return parameters_->add_pre_set_parameters_callback(std::move(callback));
  }
  [[nodiscard]] OnSetParametersCallbackHandle::SharedPtr add_on_set_parameters_callback(
      OnSetParametersCallbackType callback) {
    return parameters_->add_on_set_parameters_callback(std::move(callback));
  }
  PostSetParametersCallbackHandle::SharedPtr add_post_set_parameters_callback(
      PostSetParametersCallbackType callback) {
    return parameters_->add_post_set_parameters_callback(std::move(callback));
  }
  void remove_pre_set_parameters_callback(const PreSetParametersCallbackHandle* handle) {
    parameters_->remove_pre_set_parameters_callback(handle);
  }
  void remove_on_set_parameters_callback(const OnSetParametersCallbackHandle* handle) {
    parameters_->remove_on_set_parameters_callback(handle);
  }
  void remove_post_set_parameters_callback(const PostSetParametersCallbackHandle* handle) {
    parameters_->remove_post_set_parameters_callback(handle);
  }
  /// The one callback of Foxy, replaced by `add_on_set_parameters_callback`; null takes it away.
  OnParametersSetCallbackType set_on_parameters_set_callback(OnParametersSetCallbackType callback);

  // ---- The graph -------------------------------------------------------------------------------

  std::vector<std::string> get_node_names() const { return graph_->get_node_names(); }
  NamesAndTypes get_topic_names_and_types() const { return graph_->get_topic_names_and_types(); }
  NamesAndTypes get_service_names_and_types() const {
    return graph_->get_service_names_and_types();
  }
  NamesAndTypes get_service_names_and_types_by_node(const std::string& name,
                                                    const std::string& space) const {
    return graph_->get_service_names_and_types_by_node(name, space);
  }
  std::size_t count_publishers(const std::string& topic) const {
    return graph_->count_publishers(topic);
  }
  std::size_t count_subscribers(const std::string& topic) const {
    return graph_->count_subscribers(topic);
  }
  std::size_t count_clients(const std::string& service) const {
    return graph_->count_clients(service);
  }
  std::size_t count_services(const std::string& service) const {
    return graph_->count_services(service);
  }
  std::vector<TopicEndpointInfo> get_publishers_info_by_topic(const std::string& topic,
                                                              bool no_mangle = false) const {
    return graph_->get_publishers_info_by_topic(topic, no_mangle);
  }
  std::vector<TopicEndpointInfo> get_subscriptions_info_by_topic(const std::string& topic,
                                                                 bool no_mangle = false) const {
    return graph_->get_subscriptions_info_by_topic(topic, no_mangle);
  }
  Event::SharedPtr get_graph_event() { return graph_->get_graph_event(); }
  void wait_for_graph_change(Event::SharedPtr event, std::chrono::nanoseconds timeout) {
    graph_->wait_for_graph_change(event, timeout);
  }

  // ---- Time and parts --------------------------------------------------------------------------

  Clock::SharedPtr get_clock() { return clock_->get_clock(); }
  Clock::ConstSharedPtr get_clock() const {
    return std::static_pointer_cast<const node_interfaces::NodeClockInterface>(clock_)->get_clock();
  }
  Time now() const { return get_clock()->now(); }

  node_interfaces::NodeBaseInterface::SharedPtr get_node_base_interface() { return base_; }
  node_interfaces::NodeClockInterface::SharedPtr get_node_clock_interface() { return clock_; }
  node_interfaces::NodeGraphInterface::SharedPtr get_node_graph_interface() { return graph_; }
  node_interfaces::NodeLoggingInterface::SharedPtr get_node_logging_interface() { return logging_; }
  node_interfaces::NodeTimersInterface::SharedPtr get_node_timers_interface() { return timers_; }
  node_interfaces::NodeTopicsInterface::SharedPtr get_node_topics_interface() { return topics_; }
  node_interfaces::NodeServicesInterface::SharedPtr get_node_services_interface() {
    return services_;
  }
  node_interfaces::NodeWaitablesInterface::SharedPtr get_node_waitables_interface() {
    return waitables_;
  }
  node_interfaces::NodeParametersInterface::SharedPtr get_node_parameters_interface() {
    return parameters_;
  }
  node_interfaces::NodeTimeSourceInterface::SharedPtr get_node_time_source_interface() {
    return time_source_;
  }
  node_interfaces::NodeTypeDescriptionsInterface::SharedPtr get_node_type_descriptions_interface() {
    return type_descriptions_;
  }
  const NodeOptions& get_node_options() const { return options_; }

 protected:
  NodeFunctions(const std::string& name, const std::string& namespace_, const NodeOptions& options);
  NodeFunctions(const NodeFunctions& other, const std::string& sub_namespace);
  NodeFunctions(const NodeFunctions&) = delete;
  NodeFunctions& operator=(const NodeFunctions&) = delete;
  ~NodeFunctions();

  /// A relative name below the sub-namespace of a sub-node.
  std::string extended(const std::string& name) const;
  std::string in_sub(const std::string& name) const;

  // What a parameter given by a short-hand type is returned as.
  template <typename T>
  using shown_as = std::conditional_t<std::is_convertible_v<T, const char*>, std::string, T>;

  NodeOptions options_;
  std::string sub_namespace_;
  std::string effective_namespace_;
  node_interfaces::NodeBaseInterface::SharedPtr base_;
  node_interfaces::NodeGraphInterface::SharedPtr graph_;
  node_interfaces::NodeLoggingInterface::SharedPtr logging_;
  node_interfaces::NodeTimersInterface::SharedPtr timers_;
  node_interfaces::NodeTopicsInterface::SharedPtr topics_;
  node_interfaces::NodeServicesInterface::SharedPtr services_;
  node_interfaces::NodeClockInterface::SharedPtr clock_;
  node_interfaces::NodeParametersInterface::SharedPtr parameters_;
  node_interfaces::NodeTimeSourceInterface::SharedPtr time_source_;
  node_interfaces::NodeTypeDescriptionsInterface::SharedPtr type_descriptions_;
  node_interfaces::NodeWaitablesInterface::SharedPtr waitables_;

 private:
  OnSetParametersCallbackHandle::SharedPtr single_callback_;
};

}  // namespace detail
}  // namespace rclcpp
