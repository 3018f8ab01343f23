#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/detail/node_functions.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/node.hpp"
#include "rclcpp/node_options.hpp"
#include "rclcpp_lifecycle/lifecycle_publisher.hpp"
#include "rclcpp_lifecycle/managed_entity.hpp"
#include "rclcpp_lifecycle/node_interfaces/lifecycle_node_interface.hpp"
#include "rclcpp_lifecycle/state.hpp"
#include "rclcpp_lifecycle/transition.hpp"
#include "rclcpp_lifecycle/visibility_control.h"

namespace rclcpp_lifecycle {

/// A node with states that others change: unconfigured, inactive, active, finalized.
class RCLCPP_LIFECYCLE_PUBLIC LifecycleNode : public node_interfaces::LifecycleNodeInterface,
                                              public std::enable_shared_from_this<LifecycleNode>,
                                              public rclcpp::detail::NodeFunctions {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(LifecycleNode)
  using CallbackReturn = node_interfaces::LifecycleNodeInterface::CallbackReturn;

  explicit LifecycleNode(const std::string& node_name,
                         const rclcpp::NodeOptions& options = rclcpp::NodeOptions(),
                         bool enable_communication_interface = true);
  LifecycleNode(const std::string& node_name, const std::string& namespace_,
                const rclcpp::NodeOptions& options = rclcpp::NodeOptions(),
                bool enable_communication_interface = true);
  virtual ~LifecycleNode();
  LifecycleNode(const LifecycleNode&) = delete;
  LifecycleNode& operator=(const LifecycleNode&) = delete;

  template <typename MessageT, typename AllocatorT = std::allocator<void>>
  std::shared_ptr<LifecyclePublisher<MessageT, AllocatorT>> create_publisher(
      const std::string& topic, const rclcpp::QoS& qos,
      const rclcpp::PublisherOptionsWithAllocator<AllocatorT>& options =
          rclcpp::PublisherOptionsWithAllocator<AllocatorT>()) {
    using PublisherT = LifecyclePublisher<MessageT, AllocatorT>;
    auto made = rclcpp::create_publisher<MessageT, AllocatorT, PublisherT>(parameters_, topics_,
                                                                           topic, qos, options);
    add_managed_entity(made);
    return made;
  }

  const State& get_current_state() const;
  std::vector<State> get_available_states() const;
  std::vector<Transition> get_available_transitions() const;
  std::vector<Transition> get_transition_graph() const;

  const State& trigger_transition(const Transition& transition);
  const State& trigger_transition(const Transition& transition, CallbackReturn& code);
  const State& trigger_transition(uint8_t transition_id);
  const State& trigger_transition(uint8_t transition_id, CallbackReturn& code);
  const State& configure();
  const State& configure(CallbackReturn& code);
  const State& cleanup();
  const State& cleanup(CallbackReturn& code);
  const State& activate();
  const State& activate(CallbackReturn& code);
  const State& deactivate();
  const State& deactivate(CallbackReturn& code);
  const State& shutdown();
  const State& shutdown(CallbackReturn& code);

  using Callback = std::function<CallbackReturn(const State&)>;
  bool register_on_configure(Callback callback);
  bool register_on_cleanup(Callback callback);
  bool register_on_shutdown(Callback callback);
  bool register_on_activate(Callback callback);
  bool register_on_deactivate(Callback callback);
  bool register_on_error(Callback callback);

  CallbackReturn on_activate(const State& previous_state) override;
  CallbackReturn on_deactivate(const State& previous_state) override;

  void add_managed_entity(std::weak_ptr<ManagedEntityInterface> entity);
  void add_timer_handle(std::shared_ptr<rclcpp::TimerBase> timer);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rclcpp_lifecycle
