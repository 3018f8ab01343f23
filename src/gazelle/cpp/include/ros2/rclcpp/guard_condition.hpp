#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "rcl/handles.h"
#include "rclcpp/context.hpp"
#include "rclcpp/detail/executable.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// A flag that wakes whoever waits for it.
class RCLCPP_PUBLIC GuardCondition : public detail::Executable {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(GuardCondition)
  explicit GuardCondition(Context::SharedPtr context = contexts::get_global_default_context());
  ~GuardCondition() override;

  Context::SharedPtr get_context() const { return context_; }
  rcl_guard_condition_t& get_rcl_guard_condition() { return handle_; }
  const rcl_guard_condition_t& get_rcl_guard_condition() const { return handle_; }
  void trigger();
  void add_to_wait_set(rcl_wait_set_t& wait_set);
  void set_on_trigger_callback(std::function<void(std::size_t)> callback) {
    set_on_new_work(std::move(callback));
  }

  detail::WorkKind kind() const override { return detail::WorkKind::kGuardCondition; }
  bool has_work() override { return triggered_; }
  bool do_work() override { return triggered_.exchange(false); }

 private:
  Context::SharedPtr context_;
  rcl_guard_condition_t handle_{};
  std::atomic<bool> triggered_{false};
};

namespace detail {
RCLCPP_PUBLIC void add_guard_condition_to_rcl_wait_set(rcl_wait_set_t& wait_set,
                                                       const GuardCondition& guard_condition);
}

}  // namespace rclcpp
