#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "rcl/time.h"
#include "rclcpp/context.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/time.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

class TimeSource;

/// Hears of jumps while it lives.
class RCLCPP_PUBLIC JumpHandler {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(JumpHandler)
  using pre_callback_t = std::function<void()>;
  using post_callback_t = std::function<void(const rcl_time_jump_t&)>;
  JumpHandler(pre_callback_t before, post_callback_t after, const rcl_jump_threshold_t& threshold)
      : pre_callback(std::move(before)),
        post_callback(std::move(after)),
        notice_threshold(threshold) {}

  pre_callback_t pre_callback;
  post_callback_t post_callback;
  rcl_jump_threshold_t notice_threshold;
};

/// Steady, system or ROS time; ROS time is simulated where a time source makes it so.
class RCLCPP_PUBLIC Clock {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(Clock)
  explicit Clock(rcl_clock_type_t clock_type = RCL_SYSTEM_TIME);
  ~Clock();
  RCLCPP_DISABLE_COPY(Clock)

  Time now() const;
  /// False where the context ended first, or time jumped from one source to the other.
  bool sleep_until(Time until, Context::SharedPtr context = contexts::get_global_default_context());
  bool sleep_for(Duration duration,
                 Context::SharedPtr context = contexts::get_global_default_context());
  bool started();
  bool wait_until_started(Context::SharedPtr context = contexts::get_global_default_context());
  bool wait_until_started(const Duration& timeout,
                          Context::SharedPtr context = contexts::get_global_default_context(),
                          const Duration& wait_tick_ns = Duration(0, static_cast<uint32_t>(1e7)));
  void cancel_sleep_or_wait();
  bool ros_time_is_active();
  rcl_clock_t* get_clock_handle() noexcept;
  rcl_clock_type_t get_clock_type() const noexcept;
  std::mutex& get_clock_mutex() noexcept;
  JumpHandler::SharedPtr create_jump_callback(JumpHandler::pre_callback_t before,
                                              JumpHandler::post_callback_t after,
                                              const rcl_jump_threshold_t& threshold);

  class Impl;
  Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<Impl> impl_;
};

}  // namespace rclcpp
