#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gazelle/core.hpp"
#include "rcl/handles.h"
#include "rclcpp/callback_group.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {
namespace node_interfaces {

/// Name, context and callback groups of a node.
class RCLCPP_PUBLIC NodeBaseInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeBaseInterface)
  virtual ~NodeBaseInterface() = default;
  virtual const char* get_name() const = 0;
  virtual const char* get_namespace() const = 0;
  virtual const char* get_fully_qualified_name() const = 0;
  virtual Context::SharedPtr get_context() = 0;
  virtual rcl_node_t* get_rcl_node_handle() = 0;
  virtual const rcl_node_t* get_rcl_node_handle() const = 0;
  virtual std::shared_ptr<rcl_node_t> get_shared_rcl_node_handle() = 0;
  virtual std::shared_ptr<const rcl_node_t> get_shared_rcl_node_handle() const = 0;
  virtual CallbackGroup::SharedPtr create_callback_group(
      CallbackGroupType type, bool automatically_add_to_executor_with_node = true) = 0;
  virtual CallbackGroup::SharedPtr get_default_callback_group() = 0;
  virtual bool callback_group_in_node(CallbackGroup::SharedPtr group) = 0;
  using CallbackGroupFunction = std::function<void(CallbackGroup::SharedPtr)>;
  virtual void for_each_callback_group(const CallbackGroupFunction& function) = 0;
  virtual std::atomic_bool& get_associated_with_executor_atomic() = 0;
  virtual GuardCondition& get_notify_guard_condition() = 0;
  virtual GuardCondition::SharedPtr get_shared_notify_guard_condition() = 0;
  virtual void trigger_notify_guard_condition() = 0;
  virtual bool get_use_intra_process_default() const = 0;
  virtual bool get_enable_topic_statistics_default() const = 0;
  virtual std::string resolve_topic_or_service_name(const std::string& name, bool is_service,
                                                    bool only_expand = false) const = 0;

  /// The node on the graph.
  virtual const std::shared_ptr<gazelle::GraphNode>& graph_node() const = 0;
  /// Executors that run this node hear of its new callback groups by this.
  virtual void add_waker(const std::shared_ptr<detail::Waker>& waker) = 0;
  virtual void remove_waker(const detail::Waker* waker) = 0;
};

}  // namespace node_interfaces
}  // namespace rclcpp
