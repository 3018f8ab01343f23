// Timers of all three clocks.

#include <ros/console.h>
#include <ros/node_handle.h>
#include <gazelle/core.hpp>

#include <atomic>
#include <mutex>

#include "node_state.hpp"

namespace ros {

namespace {

using gazelle::Alarms;

template <class C>
struct Clock;
template <>
struct Clock<Timer> {
  typedef ros::Time Time;
  typedef ros::Duration Span;
  typedef TimerOptions Options;
  typedef TimerEvent Event;
  static constexpr Alarms::Base base = Alarms::Base::kClock;
};
template <>
struct Clock<WallTimer> {
  typedef ros::WallTime Time;
  typedef ros::WallDuration Span;
  typedef WallTimerOptions Options;
  typedef WallTimerEvent Event;
  static constexpr Alarms::Base base = Alarms::Base::kWall;
};
template <>
struct Clock<SteadyTimer> {
  typedef ros::SteadyTime Time;
  typedef ros::WallDuration Span;
  typedef SteadyTimerOptions Options;
  typedef SteadyTimerEvent Event;
  static constexpr Alarms::Base base = Alarms::Base::kSteady;
};

// One timer: an alarm puts it into its queue, and the call of it sets the next alarm. So calls of
// one timer never run beside each other, and none piles up.
template <class C>
class Ticking : public detail::End,
                public CallbackInterface,
                public boost::enable_shared_from_this<Ticking<C> > {
 public:
  typedef Clock<C> K;

  explicit Ticking(const typename K::Options& options)
      : options_(options),
        is_tracked_(static_cast<bool>(options.tracked_object)),
        tracked_(options.tracked_object) {
    options_.tracked_object.reset();
  }
  ~Ticking() override { stop(); }

  void start() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_started_) return;
    is_started_ = true;
    const typename K::Time now = K::Time::now();
    last_expected_ = last_real_ = last_expired_ = typename K::Time();
    next_ = now + options_.period;
    arm();
  }

  void stop() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!is_started_) return;
      is_started_ = false;
      disarm();
    }
    options_.callback_queue->removeByID(owner_);
  }

  void close(bool waiting) override {
    if (waiting) {
      stop();
    } else {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_started_ = false;
      disarm();
    }
  }

  bool isStarted() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_started_;
  }
  bool isPending() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_started_ && (alarm_ != 0 || is_waiting_);
  }

  void setPeriod(const typename K::Span& period, bool reset) {
    const std::lock_guard<std::mutex> lock(mutex_);
    options_.period = period;
    if (!is_started_) return;
    const typename K::Time now = K::Time::now();
    // Without a reset the new period counts from the last call.
    next_ = (reset || last_real_.isZero() ? now : last_real_) + period;
    if (next_ < now) next_ = now;
    if (!is_waiting_) {
      disarm();
      arm();
    }
  }

  CallResult call() override {
    typename K::Event event;
    VoidConstPtr tracked;
    if (is_tracked_) {
      tracked = tracked_.lock();
      if (!tracked) return Invalid;
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      is_waiting_ = false;
      if (!is_started_) return Invalid;
      event.last_expected = last_expected_;
      event.last_expired = last_expired_;
      event.last_real = last_real_;
      event.current_expected = next_;
      event.current_expired = expired_;
      event.current_real = K::Time::now();
      event.profile.last_duration = last_duration_;
      last_expected_ = next_;
      last_expired_ = expired_;
      last_real_ = event.current_real;
    }
    struct Done {  // also where the callback throws
      Ticking& ticking;
      const SteadyTime begin = SteadyTime::now();
      ~Done() { ticking.finish(SteadyTime::now() - begin); }
    } done{*this};
    options_.callback(event);
    return Success;
  }

 private:
  void finish(const WallDuration& took) {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_duration_ = took;
    if (!is_started_ || alarm_ != 0) return;
    if (options_.oneshot) {
      is_started_ = false;
      return;
    }
    const typename K::Time now = K::Time::now();
    if (next_ <= last_expected_) next_ = last_expected_ + options_.period;
    // Time went on in a jump, or callbacks are too slow: no running after what was missed.
    if (next_ + options_.period < now) next_ = now;
    arm();
  }

  void arm() {
    boost::weak_ptr<Ticking> weak = this->shared_from_this();
    alarm_ = Alarms::at(K::base, static_cast<int64_t>(next_.toNSec()),
                        [weak](gazelle::clock::Wake wake) {
                          if (const boost::shared_ptr<Ticking> self = weak.lock()) self->wake(wake);
                        });
  }
  void disarm() {
    if (alarm_ != 0) Alarms::cancel(alarm_);
    alarm_ = 0;
  }

  void wake(gazelle::clock::Wake wake) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!is_started_ || alarm_ == 0 || is_waiting_) return;
      alarm_ = 0;
      if (wake == gazelle::clock::Wake::kStopped) return;
      const typename K::Time now = K::Time::now();
      if (now < next_) {
        // Time went back: not longer than a period from now.
        if (now + options_.period < next_) next_ = now + options_.period;
        arm();
        return;
      }
      expired_ = now;
      is_waiting_ = true;
    }
    options_.callback_queue->addCallback(this->shared_from_this(), owner_);
  }

  typename K::Options options_;
  const bool is_tracked_;
  const boost::weak_ptr<void const> tracked_;
  const uint64_t owner_ = detail::newOwner();
  std::mutex mutex_;
  bool is_started_ = false;
  bool is_waiting_ = false;  // among the callbacks of the queue
  uint64_t alarm_ = 0;
  typename K::Time next_, expired_, last_expected_, last_expired_, last_real_;
  WallDuration last_duration_;
};

}  // namespace

// Copies of a timer share it; with the last one it stops.
#define GAZELLE_ROS_TIMER(C)                                                                \
  class C::Impl : public Ticking<C> {                                                       \
   public:                                                                                  \
    explicit Impl(const C##Options& options) : Ticking<C>(options) {}                       \
  };                                                                                        \
  C::C(const C##Options& options) : impl_(boost::make_shared<Impl>(options)) {              \
    detail::keep(boost::shared_ptr<detail::End>(impl_));                                    \
  }                                                                                         \
  void C::start() {                                                                         \
    if (impl_) impl_->start();                                                              \
  }                                                                                         \
  void C::stop() {                                                                          \
    if (impl_) impl_->stop();                                                               \
  }                                                                                         \
  bool C::hasPending() { return impl_ && impl_->isPending(); }                              \
  bool C::hasStarted() const { return impl_ && impl_->isStarted(); }                        \
  bool C::isValid() const { return static_cast<bool>(impl_); }                              \
  void C::setPeriod(const Clock<C>::Span& period, bool reset) {                             \
    if (impl_) impl_->setPeriod(period, reset);                                             \
  }                                                                                         \
  C NodeHandle::create##C(C##Options& options) const {                                      \
    if (options.callback_queue == 0) options.callback_queue = getCallbackQueue();           \
    C timer(options);                                                                       \
    if (options.autostart) timer.start();                                                   \
    return timer;                                                                           \
  }                                                                                         \
  C NodeHandle::create##C(Clock<C>::Span period, const C##Callback& callback, bool oneshot, \
                          bool autostart) const {                                           \
    C##Options options(period, callback, 0, oneshot, autostart);                            \
    return create##C(options);                                                              \
  }

GAZELLE_ROS_TIMER(Timer)
GAZELLE_ROS_TIMER(WallTimer)
GAZELLE_ROS_TIMER(SteadyTimer)

}  // namespace ros
