#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "rclcpp/clock.hpp"
#include "rclcpp/context.hpp"
#include "rclcpp/detail/executable.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// When a call of a timer was due and when it came.
struct TimerInfo {
  Time expected_call_time;
  Time actual_call_time;
};

/// What `TimerBase::call` found: true where a call was due. Newer code hands it to
/// `execute_callback`, older code takes it for a bool.
struct TimerCall {
  bool due = false;
  operator bool() const { return due; }                       // NOLINT(runtime/explicit)
  operator std::shared_ptr<void>() const { return nullptr; }  // NOLINT(runtime/explicit)
};

/// Something that is due again and again on a clock.
class RCLCPP_PUBLIC TimerBase : public detail::Executable {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(TimerBase)
  TimerBase(Clock::SharedPtr clock, std::chrono::nanoseconds period, Context::SharedPtr context,
            bool autostart = true);
  ~TimerBase() override;

  void cancel();
  bool is_canceled();
  void reset();
  /// Take a call that is due; false where the timer is cancelled.
  virtual TimerCall call();
  virtual void execute_callback() = 0;
  virtual void execute_callback(const std::shared_ptr<void>& data) {
    (void)data;
    execute_callback();
  }
  virtual bool is_steady();
  std::chrono::nanoseconds time_until_trigger();
  bool is_ready();
  Clock::SharedPtr get_clock() const;
  std::chrono::nanoseconds get_period() const;
  /// Have another period from the next call on.
  void exchange_period(std::chrono::nanoseconds period);
  void set_on_reset_callback(std::function<void(std::size_t)> callback);
  void clear_on_reset_callback();
  TimerInfo last_call() const;

  detail::WorkKind kind() const override { return detail::WorkKind::kTimer; }
  bool has_work() override { return is_ready(); }
  bool do_work() override;
  std::optional<std::chrono::nanoseconds> time_until_work() override;

  class Impl;

 private:
  std::shared_ptr<Impl> impl_;
};

using VoidCallbackType = std::function<void()>;
using TimerCallbackType = std::function<void(TimerBase&)>;
using TimerInfoCallbackType = std::function<void(const TimerInfo&)>;

template <typename FunctorT, typename = void>
class GenericTimer : public TimerBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(GenericTimer)
  GenericTimer(Clock::SharedPtr clock, std::chrono::nanoseconds period, FunctorT&& callback,
               Context::SharedPtr context, bool autostart = true)
      : TimerBase(std::move(clock), period, std::move(context), autostart),
        callback_(std::forward<FunctorT>(callback)) {}
  ~GenericTimer() override { cancel(); }

  void execute_callback() override {
    using F = std::decay_t<FunctorT>&;
    if constexpr (std::is_invocable_v<F, TimerBase&>) {
      callback_(*this);
    } else if constexpr (std::is_invocable_v<F, const TimerInfo&>) {
      callback_(last_call());
    } else {
      callback_();
    }
  }

 protected:
  std::decay_t<FunctorT> callback_;
};

template <typename FunctorT, typename = void>
class WallTimer : public GenericTimer<FunctorT> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(WallTimer)
  WallTimer(std::chrono::nanoseconds period, FunctorT&& callback, Context::SharedPtr context,
            bool autostart = true)
      : GenericTimer<FunctorT>(std::make_shared<Clock>(RCL_STEADY_TIME), period,
                               std::forward<FunctorT>(callback), std::move(context), autostart) {}
};

}  // namespace rclcpp
