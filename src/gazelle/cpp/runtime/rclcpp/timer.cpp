// Timers: when the next call is due, on steady, system or simulated time.
#include "rclcpp/timer.hpp"

#include <algorithm>
#include <utility>

#include "clock_impl.hpp"
#include "gazelle/core.hpp"

namespace rclcpp {

class TimerBase::Impl : public std::enable_shared_from_this<TimerBase::Impl> {
 public:
  Impl(TimerBase* timer, Clock::SharedPtr given, std::int64_t period, Context::SharedPtr of)
      : owner(timer), clock(std::move(given)), context(std::move(of)), period_ns(period) {}

  std::int64_t now() const { return clock->impl().now_ns(); }

  /// Simulated time tells nobody how long it will take: an alarm of the core wakes executors.
  void arm() {
    disarm();
    if (canceled || !clock->impl().is_simulated()) return;
    std::weak_ptr<Impl> weak = weak_from_this();
    const std::uint64_t number = gazelle::Alarms::at(gazelle::Alarms::Base::kClock, next_ns,
                                                     [weak](gazelle::clock::Wake how) {
                                                       if (const auto self = weak.lock())
                                                         self->woken(how);
                                                     });
    alarm = number;
  }

  void disarm() {
    if (const std::uint64_t number = alarm.exchange(0)) gazelle::Alarms::cancel(number);
  }

  void woken(gazelle::clock::Wake how) {
    if (how == gazelle::clock::Wake::kStopped) return;
    std::lock_guard<std::mutex> lock(mutex);
    if (how == gazelle::clock::Wake::kJumped) {
      restart_after_jump();
      arm();
    }
    if (owner) owner->announce_work();
  }

  void restart_after_jump() {
    const std::int64_t time = now();
    if (time < last_ns || next_ns - time > period_ns) {
      last_ns = time;
      next_ns = time + period_ns;
    }
  }

  void clock_changed() {
    std::lock_guard<std::mutex> lock(mutex);
    last_ns = now();
    next_ns = last_ns + period_ns;
    arm();
    if (owner) owner->announce_work();
  }

  TimerBase* owner;  // null once it is being destroyed
  std::mutex mutex;  // of owner and of what a jump changes
  const Clock::SharedPtr clock;
  const Context::SharedPtr context;
  std::atomic<std::int64_t> period_ns;
  std::atomic<std::int64_t> next_ns{0};
  std::atomic<std::int64_t> last_ns{0};
  std::atomic<bool> canceled{false};
  std::atomic<std::uint64_t> alarm{0};
  TimerInfo info{Time(0, 0), Time(0, 0)};
  std::function<void(std::size_t)> on_reset;
  JumpHandler::SharedPtr jump;
};

TimerBase::TimerBase(Clock::SharedPtr clock, std::chrono::nanoseconds period,
                     Context::SharedPtr context, bool autostart)
    : impl_(std::make_shared<Impl>(this, clock ? clock : std::make_shared<Clock>(RCL_STEADY_TIME),
                                   period.count(),
                                   context ? context : contexts::get_global_default_context())) {
  impl_->last_ns = impl_->now();
  impl_->next_ns = impl_->last_ns + impl_->period_ns;
  impl_->canceled = !autostart;
  if (impl_->clock->get_clock_type() == RCL_ROS_TIME) {
    std::weak_ptr<Impl> weak = impl_;
    impl_->jump = impl_->clock->create_jump_callback(nullptr,
                                                     [weak](const rcl_time_jump_t&) {
                                                       if (const auto self = weak.lock())
                                                         self->clock_changed();
                                                     },
                                                     {true, {0}, {-1}});
  }
  impl_->arm();
}

TimerBase::~TimerBase() {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->canceled = true;
  impl_->owner = nullptr;
  // An alarm that rings now finds no owner.
  if (const std::uint64_t number = impl_->alarm.exchange(0)) gazelle::Alarms::cancel(number);
}

void TimerBase::cancel() {
  impl_->canceled = true;
  impl_->disarm();
}

bool TimerBase::is_canceled() { return impl_->canceled; }

void TimerBase::reset() {
  std::function<void(std::size_t)> told;
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    impl_->last_ns = impl_->now();
    impl_->next_ns = impl_->last_ns + impl_->period_ns;
    impl_->canceled = false;
    impl_->arm();
    told = impl_->on_reset;
  }
  announce_work();
  if (told) told(1);
}

TimerCall TimerBase::call() {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  if (impl_->canceled) return {false};
  const std::int64_t now = impl_->now();
  const std::int64_t due = impl_->next_ns;
  const auto type = impl_->clock->get_clock_type();
  impl_->info = TimerInfo{Time(due, type), Time(now, type)};
  impl_->last_ns = now;
  const std::int64_t period = impl_->period_ns;
  std::int64_t next = due + period;
  // Calls that were missed are left out, in step with the first.
  if (next < now) next = period ? next + (1 + (now - next - 1) / period) * period : now;
  impl_->next_ns = next;
  impl_->arm();
  return {true};
}

bool TimerBase::do_work() {
  if (!is_ready() || !call()) return false;
  execute_callback();
  return true;
}

bool TimerBase::is_steady() { return impl_->clock->get_clock_type() == RCL_STEADY_TIME; }

bool TimerBase::is_ready() { return !impl_->canceled && impl_->now() >= impl_->next_ns; }

std::chrono::nanoseconds TimerBase::time_until_trigger() {
  if (impl_->canceled) return std::chrono::nanoseconds::max();
  return std::chrono::nanoseconds(impl_->next_ns - impl_->now());
}

std::optional<std::chrono::nanoseconds> TimerBase::time_until_work() {
  if (impl_->canceled || impl_->clock->impl().is_simulated()) return std::nullopt;
  return std::max(std::chrono::nanoseconds(0), time_until_trigger());
}

Clock::SharedPtr TimerBase::get_clock() const { return impl_->clock; }

std::chrono::nanoseconds TimerBase::get_period() const {
  return std::chrono::nanoseconds(impl_->period_ns.load());
}

void TimerBase::exchange_period(std::chrono::nanoseconds period) {
  impl_->period_ns = period.count();
}

void TimerBase::set_on_reset_callback(std::function<void(std::size_t)> callback) {
  std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->on_reset = std::move(callback);
}

void TimerBase::clear_on_reset_callback() { set_on_reset_callback(nullptr); }

TimerInfo TimerBase::last_call() const { return impl_->info; }

}  // namespace rclcpp
