#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "rclcpp/context.hpp"
#include "rclcpp/detail/executable.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

class ClientBase;
class GuardCondition;
class ServiceBase;
class SubscriptionBase;
class TimerBase;
class Waitable;

enum class CallbackGroupType { MutuallyExclusive, Reentrant };

/// Things whose callbacks run one at a time, or whenever there is a thread.
class RCLCPP_PUBLIC CallbackGroup {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(CallbackGroup)
  explicit CallbackGroup(CallbackGroupType type,
                         bool automatically_add_to_executor_with_node = true);
  CallbackGroup(CallbackGroupType type, std::function<Context::SharedPtr()> get_node_context,
                bool automatically_add_to_executor_with_node = true);
  ~CallbackGroup();

  template <typename Function>
  std::shared_ptr<SubscriptionBase> find_subscription_ptrs_if(Function function) const {
    return find_if<SubscriptionBase>(function);
  }
  template <typename Function>
  std::shared_ptr<TimerBase> find_timer_ptrs_if(Function function) const {
    return find_if<TimerBase>(function);
  }
  template <typename Function>
  std::shared_ptr<ServiceBase> find_service_ptrs_if(Function function) const {
    return find_if<ServiceBase>(function);
  }
  template <typename Function>
  std::shared_ptr<ClientBase> find_client_ptrs_if(Function function) const {
    return find_if<ClientBase>(function);
  }
  template <typename Function>
  std::shared_ptr<Waitable> find_waitable_ptrs_if(Function function) const {
    return find_if<Waitable>(function);
  }
  void collect_all_ptrs(std::function<void(const std::shared_ptr<SubscriptionBase>&)> subscription,
                        std::function<void(const std::shared_ptr<ServiceBase>&)> service,
                        std::function<void(const std::shared_ptr<ClientBase>&)> client,
                        std::function<void(const std::shared_ptr<TimerBase>&)> timer,
                        std::function<void(const std::shared_ptr<Waitable>&)> waitable) const;

  std::size_t size() const;
  std::atomic_bool& can_be_taken_from() { return can_be_taken_from_; }
  const CallbackGroupType& type() const { return type_; }
  std::atomic_bool& get_associated_with_executor_atomic() { return associated_; }
  bool automatically_add_to_executor_with_node() const { return automatic_; }

  // For the runtime.
  void add(const std::shared_ptr<detail::Executable>& executable);
  void remove(const detail::Executable* executable);
  std::vector<std::shared_ptr<detail::Executable>> executables() const;
  void add_waker(const std::shared_ptr<detail::Waker>& waker);
  void remove_waker(const detail::Waker* waker);

 private:
  template <typename T, typename Function>
  std::shared_ptr<T> find_if(Function function) const {
    for (const auto& one : executables()) {
      auto found = std::dynamic_pointer_cast<T>(one);
      if (found && function(found)) return found;
    }
    return nullptr;
  }

  CallbackGroupType type_;
  mutable std::mutex mutex_;
  mutable std::vector<std::weak_ptr<detail::Executable>> executables_;
  std::vector<std::weak_ptr<detail::Waker>> wakers_;
  std::atomic_bool associated_{false};
  std::atomic_bool can_be_taken_from_{true};
  const bool automatic_;
};

}  // namespace rclcpp
