#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "rclcpp/any_executable.hpp"
#include "rclcpp/callback_group.hpp"
#include "rclcpp/client.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/executor_options.hpp"
#include "rclcpp/future_return_code.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/memory_strategy.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/service.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {

class Node;

/// Runs the callbacks of nodes and callback groups that were added to it.
class RCLCPP_PUBLIC Executor {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Executor)
  explicit Executor(const ExecutorOptions& options = ExecutorOptions());
  virtual ~Executor();
  RCLCPP_DISABLE_COPY(Executor)

  virtual void spin() = 0;
  virtual void add_callback_group(CallbackGroup::SharedPtr group,
                                  node_interfaces::NodeBaseInterface::SharedPtr node,
                                  bool notify = true);
  virtual void remove_callback_group(CallbackGroup::SharedPtr group, bool notify = true);
  virtual std::vector<CallbackGroup::WeakPtr> get_all_callback_groups();
  virtual std::vector<CallbackGroup::WeakPtr> get_manually_added_callback_groups();
  virtual std::vector<CallbackGroup::WeakPtr> get_automatically_added_callback_groups_from_nodes();
  virtual void add_node(node_interfaces::NodeBaseInterface::SharedPtr node, bool notify = true);
  virtual void add_node(std::shared_ptr<Node> node, bool notify = true);
  virtual void remove_node(node_interfaces::NodeBaseInterface::SharedPtr node, bool notify = true);
  virtual void remove_node(std::shared_ptr<Node> node, bool notify = true);

  template <typename RepT = int64_t, typename T = std::milli>
  void spin_node_once(node_interfaces::NodeBaseInterface::SharedPtr node,
                      std::chrono::duration<RepT, T> timeout = std::chrono::duration<RepT, T>(-1)) {
    spin_node_once_nanoseconds(node, std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }
  template <typename NodeT = Node, typename RepT = int64_t, typename T = std::milli>
  void spin_node_once(std::shared_ptr<NodeT> node,
                      std::chrono::duration<RepT, T> timeout = std::chrono::duration<RepT, T>(-1)) {
    spin_node_once_nanoseconds(node->get_node_base_interface(),
                               std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }
  void spin_node_some(node_interfaces::NodeBaseInterface::SharedPtr node);
  void spin_node_some(std::shared_ptr<Node> node);
  void spin_node_all(node_interfaces::NodeBaseInterface::SharedPtr node,
                     std::chrono::nanoseconds max_duration);
  virtual void spin_some(std::chrono::nanoseconds max_duration = std::chrono::nanoseconds(0));
  virtual void spin_all(std::chrono::nanoseconds max_duration);
  virtual void spin_once(std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));

  template <typename FutureT, typename TimeRepT = int64_t, typename TimeT = std::milli>
  FutureReturnCode spin_until_future_complete(
      const FutureT& future,
      std::chrono::duration<TimeRepT, TimeT> timeout = std::chrono::duration<TimeRepT, TimeT>(-1)) {
    return spin_until_future_complete_impl(
        std::chrono::duration_cast<std::chrono::nanoseconds>(timeout), [&future]() {
          return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        });
  }
  template <typename TimeRepT = int64_t, typename TimeT = std::milli>
  FutureReturnCode spin_for(std::chrono::duration<TimeRepT, TimeT> timeout) {
    return spin_until_future_complete_impl(
        std::chrono::duration_cast<std::chrono::nanoseconds>(timeout), []() { return false; });
  }

  virtual void cancel();
  void set_memory_strategy(memory_strategy::MemoryStrategy::SharedPtr strategy) { (void)strategy; }
  bool is_spinning() { return spinning; }

 protected:
  /// Add a node, do one piece of work, and remove the node again.
  void spin_node_once_nanoseconds(node_interfaces::NodeBaseInterface::SharedPtr node,
                                  std::chrono::nanoseconds timeout);
  virtual FutureReturnCode spin_until_future_complete_impl(std::chrono::nanoseconds timeout,
                                                           const std::function<bool()>& is_ready);
  void spin_some_impl(std::chrono::nanoseconds max_duration, bool exhaustive);
  virtual void spin_once_impl(std::chrono::nanoseconds timeout);
  void execute_any_executable(AnyExecutable& executable);
  /// Look what is ready, and wait until something is.
  void wait_for_work(std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));
  bool get_next_ready_executable(AnyExecutable& executable);
  bool get_next_executable(AnyExecutable& executable,
                           std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));
  /// Throws where another thread spins already; the guard ends the spinning.
  std::shared_ptr<void> begin_spinning(const char* function);
  bool has_context() const;

  std::atomic_bool spinning{false};
  Context::SharedPtr context_;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rclcpp
