#pragma once

#include <functional>
#include <memory>

#include "rcl/handles.h"
#include "rclcpp/detail/executable.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// Work of a user's own kind: executors ask `is_ready` once a guard condition that
/// `add_to_wait_set` adds was triggered.
class RCLCPP_PUBLIC Waitable : public detail::Executable {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Waitable)
  Waitable() = default;
  ~Waitable() override = default;

  virtual std::size_t get_number_of_ready_subscriptions() { return 0; }
  virtual std::size_t get_number_of_ready_timers() { return 0; }
  virtual std::size_t get_number_of_ready_clients() { return 0; }
  virtual std::size_t get_number_of_ready_events() { return 0; }
  virtual std::size_t get_number_of_ready_services() { return 0; }
  virtual std::size_t get_number_of_ready_guard_conditions() { return 0; }

  // Both forms of each: older code takes pointers, newer code references.
  virtual void add_to_wait_set(rcl_wait_set_t* wait_set) { (void)wait_set; }
  virtual void add_to_wait_set(rcl_wait_set_t& wait_set) { add_to_wait_set(&wait_set); }
  virtual bool is_ready(rcl_wait_set_t* wait_set) {
    (void)wait_set;
    return false;
  }
  virtual bool is_ready(const rcl_wait_set_t& wait_set) {
    return is_ready(const_cast<rcl_wait_set_t*>(&wait_set));
  }
  virtual std::shared_ptr<void> take_data() { return nullptr; }
  virtual std::shared_ptr<void> take_data_by_entity_id(std::size_t id) {
    (void)id;
    return take_data();
  }
  virtual void execute(std::shared_ptr<void>& data) { (void)data; }
  virtual void execute(const std::shared_ptr<void>& data) {
    std::shared_ptr<void> own = data;
    execute(own);
  }
  virtual void set_on_ready_callback(std::function<void(std::size_t, int)> callback);
  virtual void clear_on_ready_callback() { set_on_new_work(nullptr); }

  detail::WorkKind kind() const override { return detail::WorkKind::kWaitable; }
  bool has_work() override;
  bool do_work() override;
  void add_waker(const std::shared_ptr<detail::Waker>& waker) override;
};

}  // namespace rclcpp
