// Clocks, rates, and where ROS time comes from.
#include "rclcpp/clock.hpp"

#include <algorithm>
#include <utility>

#include "clock_impl.hpp"
#include "gazelle/core.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/node.hpp"
#include "rclcpp/rate.hpp"
#include "rclcpp/time_source.hpp"

namespace rclcpp {
namespace {

constexpr std::int64_t kLookEvery_ns = 50000000;

// Simulated time is the process' own: it goes on while any clock follows it.
void count_simulated(int change) {
  static std::mutex mutex;
  static int clocks = 0;
  std::lock_guard<std::mutex> lock(mutex);
  const int before = clocks;
  clocks += change;
  if ((before > 0) != (clocks > 0)) gazelle::clock::use_sim_time(clocks > 0 ? 1 : 0);
}

}  // namespace

Clock::Impl::Impl(rcl_clock_type_t given) : type(given) {
  handle.type = given;
  handle.data = this;
}

Clock::Impl::~Impl() {
  if (jump_listener_) gazelle::clock::remove_listener(jump_listener_);
  if (sim) count_simulated(-1);
}

std::int64_t Clock::Impl::now_ns() const {
  switch (type) {
    case RCL_STEADY_TIME:
      return gazelle::clock::steady_ns();
    case RCL_ROS_TIME:
      return sim ? gazelle::clock::now_ns() : gazelle::clock::wall_ns();
    default:
      return gazelle::clock::wall_ns();
  }
}

void Clock::Impl::use_sim_time(bool use) {
  if (type != RCL_ROS_TIME || sim.exchange(use) == use) return;
  count_simulated(use ? 1 : -1);
  if (use && !jump_listener_) {
    std::weak_ptr<Impl> weak = weak_from_this();
    jump_listener_ = gazelle::clock::on_jump([weak](const gazelle::clock::Jump& jump) {
      const auto self = weak.lock();
      if (!self || !self->sim || jump.clock_changed) return;
      self->tell_jump({RCL_ROS_TIME_NO_CHANGE, {jump.delta_ns}});
    });
  }
  tell_jump({use ? RCL_ROS_TIME_ACTIVATED : RCL_ROS_TIME_DEACTIVATED, {0}});
  gazelle::clock::notify_waiters();
}

void Clock::Impl::tell_jump(const rcl_time_jump_t& jump) {
  std::vector<std::shared_ptr<JumpHandler>> strong;
  {
    std::lock_guard<std::mutex> lock(handlers_mutex);
    for (const auto& one : handlers) {
      if (auto found = one.lock()) strong.push_back(std::move(found));
    }
    handlers.assign(strong.begin(), strong.end());
  }
  const bool changed =
      jump.clock_change == RCL_ROS_TIME_ACTIVATED || jump.clock_change == RCL_ROS_TIME_DEACTIVATED;
  for (const auto& one : strong) {
    const auto& threshold = one->notice_threshold;
    const auto delta = jump.delta.nanoseconds;
    const bool forward =
        threshold.min_forward.nanoseconds > 0 && delta >= threshold.min_forward.nanoseconds;
    const bool backward =
        threshold.min_backward.nanoseconds < 0 && delta <= threshold.min_backward.nanoseconds;
    if (!((threshold.on_clock_change && changed) || forward || backward)) continue;
    if (one->pre_callback) one->pre_callback();
    if (one->post_callback) one->post_callback(jump);
  }
}

bool Clock::Impl::wait(std::int64_t until_ns, const std::function<bool()>& stop) {
  const std::uint64_t count = cancelled;
  const bool simulated = is_simulated();
  const auto ended = [&]() { return stop() || cancelled != count || is_simulated() != simulated; };
  while (!ended()) {
    const std::int64_t left = until_ns - now_ns();
    if (left <= 0) return true;
    if (simulated) {
      gazelle::clock::wait_until(until_ns, ended);
      if (!gazelle::ok()) break;
    } else {
      gazelle::clock::wait_wall(std::min(left, kLookEvery_ns), ended);
    }
  }
  return false;
}

Clock::Clock(rcl_clock_type_t clock_type) : impl_(std::make_shared<Impl>(clock_type)) {}
Clock::~Clock() = default;

Time Clock::now() const { return Time(impl_->now_ns(), impl_->type); }

bool Clock::sleep_until(Time until, Context::SharedPtr context) {
  if (!context || !context->is_valid()) {
    throw std::runtime_error("context cannot be slept with because it's invalid");
  }
  if (until.get_clock_type() != impl_->type) {
    throw std::runtime_error("until's clock type does not match this clock's type");
  }
  return impl_->wait(until.nanoseconds(), [&context]() { return !context->is_valid(); });
}

bool Clock::sleep_for(Duration duration, Context::SharedPtr context) {
  return sleep_until(now() + duration, std::move(context));
}

bool Clock::started() { return impl_->type != RCL_ROS_TIME || impl_->now_ns() > 0; }

bool Clock::wait_until_started(Context::SharedPtr context) {
  return wait_until_started(Duration::max(), std::move(context));
}

bool Clock::wait_until_started(const Duration& timeout, Context::SharedPtr context,
                               const Duration& wait_tick_ns) {
  if (!context || !context->is_valid()) {
    throw std::runtime_error("context cannot be slept with because it's invalid");
  }
  const std::int64_t begin = gazelle::clock::steady_ns();
  while (!started()) {
    if (!context->is_valid() || gazelle::clock::steady_ns() - begin >= timeout.nanoseconds()) {
      return started();
    }
    gazelle::clock::wait_wall(wait_tick_ns.nanoseconds(),
                              [&context]() { return !context->is_valid(); });
  }
  return true;
}

void Clock::cancel_sleep_or_wait() {
  impl_->cancelled.fetch_add(1);
  gazelle::clock::notify_waiters();
}

bool Clock::ros_time_is_active() { return impl_->is_simulated(); }
rcl_clock_t* Clock::get_clock_handle() noexcept { return &impl_->handle; }
rcl_clock_type_t Clock::get_clock_type() const noexcept { return impl_->type; }
std::mutex& Clock::get_clock_mutex() noexcept { return impl_->mutex; }

JumpHandler::SharedPtr Clock::create_jump_callback(JumpHandler::pre_callback_t before,
                                                   JumpHandler::post_callback_t after,
                                                   const rcl_jump_threshold_t& threshold) {
  auto handler = std::make_shared<JumpHandler>(std::move(before), std::move(after), threshold);
  std::lock_guard<std::mutex> lock(impl_->handlers_mutex);
  impl_->handlers.push_back(handler);
  return handler;
}

// ---- Rates --------------------------------------------------------------------------------------

Rate::Rate(double rate, Clock::SharedPtr clock)
    : clock_(std::move(clock)), last_interval_(clock_->now()) {
  if (rate <= 0.0) throw std::invalid_argument("rate must be greater than 0");
  period_ = Duration::from_seconds(1.0 / rate);
}

Rate::Rate(const Duration& period, Clock::SharedPtr clock)
    : clock_(std::move(clock)), period_(period), last_interval_(clock_->now()) {
  if (period <= Duration(0, 0)) throw std::invalid_argument("period must be greater than 0");
}

bool Rate::sleep() {
  const Time now = clock_->now();
  // Time that went back begins a new interval.
  Time next = now < last_interval_ ? now + period_ : last_interval_ + period_;
  const bool late = next <= now;
  if (late) {
    // Who is more than a turn late begins anew.
    last_interval_ = now > next + period_ ? now : next;
    return false;
  }
  last_interval_ = next;
  clock_->sleep_until(next);
  return true;
}

rcl_clock_type_t Rate::get_type() const { return clock_->get_clock_type(); }
void Rate::reset() { last_interval_ = clock_->now(); }
std::chrono::nanoseconds Rate::period() const {
  return std::chrono::nanoseconds(period_.nanoseconds());
}

// ---- Time sources -------------------------------------------------------------------------------

class TimeSource::Impl : public std::enable_shared_from_this<TimeSource::Impl> {
 public:
  void attach(const std::shared_ptr<Node>& node) {
    node_ = node;
    if (!node->has_parameter("use_sim_time")) node->declare_parameter("use_sim_time", false);
    bool use = false;
    node->get_parameter("use_sim_time", use);
    std::weak_ptr<Impl> weak = shared_from_this();
    handle_ = node->add_post_set_parameters_callback([weak](const std::vector<Parameter>& changed) {
      for (const auto& one : changed) {
        if (one.get_name() != "use_sim_time" || one.get_type() != PARAMETER_BOOL) continue;
        if (const auto self = weak.lock()) self->use(one.as_bool());
      }
    });
    this->use(use);
  }
  void detach() {
    if (const auto node = node_.lock()) {
      if (handle_) node->remove_post_set_parameters_callback(handle_.get());
    }
    handle_.reset();
    node_.reset();
    use(false);
  }
  void add(const Clock::SharedPtr& clock) {
    if (clock->get_clock_type() != RCL_ROS_TIME) {
      throw std::invalid_argument("Cannot attach a clock that's not ROS_TIME to a time source");
    }
    std::lock_guard<std::mutex> lock(mutex_);
    clocks_.push_back(clock);
    clock->impl().use_sim_time(use_);
  }
  void remove(const Clock::SharedPtr& clock) {
    std::lock_guard<std::mutex> lock(mutex_);
    const auto found = std::find(clocks_.begin(), clocks_.end(), clock);
    if (found != clocks_.end()) clocks_.erase(found);
  }
  void use(bool sim) {
    std::lock_guard<std::mutex> lock(mutex_);
    use_ = sim;
    for (const auto& one : clocks_) one->impl().use_sim_time(sim);
  }
  bool use_clock_thread = true;

 private:
  std::mutex mutex_;
  std::vector<Clock::SharedPtr> clocks_;
  std::weak_ptr<Node> node_;
  node_interfaces::PostSetParametersCallbackHandle::SharedPtr handle_;
  bool use_ = false;
};

TimeSource::TimeSource(std::shared_ptr<Node> node, const QoS& qos, bool use_clock_thread)
    : TimeSource(qos, use_clock_thread) {
  attachNode(std::move(node));
}

TimeSource::TimeSource(const QoS&, bool use_clock_thread) : impl_(std::make_shared<Impl>()) {
  impl_->use_clock_thread = use_clock_thread;
}

TimeSource::~TimeSource() = default;
void TimeSource::attachNode(std::shared_ptr<Node> node) { impl_->attach(node); }
void TimeSource::detachNode() { impl_->detach(); }
void TimeSource::attachClock(Clock::SharedPtr clock) { impl_->add(clock); }
void TimeSource::detachClock(Clock::SharedPtr clock) { impl_->remove(clock); }
bool TimeSource::get_use_clock_thread() { return impl_->use_clock_thread; }
void TimeSource::set_use_clock_thread(bool use) { impl_->use_clock_thread = use; }
bool TimeSource::clock_thread_is_joinable() { return false; }

namespace detail {

bool ThrottledPlace::is_first() { return !seen.exchange(true); }

bool ThrottledPlace::may_speak(const Clock& clock, double duration_ms) {
  const std::int64_t now = clock.impl().now_ns();
  std::int64_t last = last_ns.load();
  const bool first = !spoken.exchange(true);
  const auto wait = static_cast<std::int64_t>(duration_ms * 1e6);
  if (!first && now >= last && now - last < wait) return false;
  return last_ns.compare_exchange_strong(last, now);
}

}  // namespace detail
}  // namespace rclcpp

extern "C" rcl_ret_t rcl_clock_get_now(rcl_clock_t* clock, rcl_time_point_value_t* now) {
  if (!clock || !clock->data || !now) return RCL_RET_INVALID_ARGUMENT;
  *now = static_cast<rclcpp::Clock::Impl*>(clock->data)->now_ns();
  return RCL_RET_OK;
}
