// What executors and wait sets wait for: wakers, guard conditions, waitables, callback groups.
#include "rclcpp/detail/executable.hpp"

#include <algorithm>
#include <condition_variable>
#include <utility>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/client.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/service.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {
namespace detail {

struct Waker::Impl {
  std::mutex mutex;
  std::condition_variable condition;
  std::atomic<std::uint64_t> count{0};
  std::atomic<int> waiting{0};
};

Waker::Waker() : impl_(std::make_unique<Impl>()) {}
Waker::~Waker() = default;

void Waker::ring() {
  impl_->count.fetch_add(1);
  // Who is about to wait has counted itself before it looks at the count, so it sees this ring.
  if (impl_->waiting.load() == 0) return;
  { std::lock_guard<std::mutex> lock(impl_->mutex); }
  impl_->condition.notify_all();
}

std::uint64_t Waker::count() const { return impl_->count.load(); }

void Waker::wait(std::uint64_t seen, std::optional<std::chrono::steady_clock::time_point> until) {
  std::unique_lock<std::mutex> lock(impl_->mutex);
  impl_->waiting.fetch_add(1);
  const auto rung = [this, seen]() { return impl_->count.load() != seen; };
  if (until) {
    impl_->condition.wait_until(lock, *until, rung);
  } else {
    impl_->condition.wait(lock, rung);
  }
  impl_->waiting.fetch_sub(1);
}

namespace {
std::atomic<std::uint64_t>& version() {
  static std::atomic<std::uint64_t> count{1};
  return count;
}
}  // namespace

std::uint64_t entities_changed() { return version().fetch_add(1) + 1; }
std::uint64_t entities_version() { return version().load(); }

Executable::Executable() = default;
Executable::~Executable() = default;

void Executable::add_waker(const std::shared_ptr<Waker>& waker) {
  std::lock_guard<std::mutex> lock(wakers_mutex_);
  for (const auto& one : wakers_) {
    if (one.lock() == waker) return;
  }
  wakers_.erase(
      std::remove_if(wakers_.begin(), wakers_.end(), [](const auto& one) { return one.expired(); }),
      wakers_.end());
  wakers_.push_back(waker);
}

void Executable::remove_waker(const Waker* waker) {
  std::lock_guard<std::mutex> lock(wakers_mutex_);
  wakers_.erase(std::remove_if(wakers_.begin(), wakers_.end(),
                               [waker](const auto& one) {
                                 const auto strong = one.lock();
                                 return !strong || strong.get() == waker;
                               }),
                wakers_.end());
}

void Executable::set_on_new_work(std::function<void(std::size_t)> listener) {
  std::size_t untold = 0;
  std::function<void(std::size_t)> told;
  {
    std::lock_guard<std::mutex> lock(wakers_mutex_);
    on_new_work_ = std::move(listener);
    if (on_new_work_) {
      std::swap(untold, untold_);
      told = on_new_work_;
    }
  }
  if (told && untold) told(untold);
}

void Executable::announce_work() {
  std::function<void(std::size_t)> told;
  {
    std::lock_guard<std::mutex> lock(wakers_mutex_);
    for (const auto& one : wakers_) {
      if (const auto waker = one.lock()) waker->ring();
    }
    if (on_new_work_) {
      told = on_new_work_;
    } else {
      ++untold_;
    }
  }
  if (told) told(1);
}

void add_guard_condition_to_rcl_wait_set(rcl_wait_set_t& wait_set,
                                         const GuardCondition& guard_condition) {
  const_cast<GuardCondition&>(guard_condition).add_to_wait_set(wait_set);
}

}  // namespace detail

// ---- Guard conditions ---------------------------------------------------------------------------

GuardCondition::GuardCondition(Context::SharedPtr context) : context_(std::move(context)) {
  if (!context_) throw std::invalid_argument("context argument unexpectedly nullptr");
  handle_.impl = this;
}

GuardCondition::~GuardCondition() = default;

void GuardCondition::trigger() {
  triggered_ = true;
  announce_work();
}

void GuardCondition::add_to_wait_set(rcl_wait_set_t& wait_set) {
  rcl_wait_set_add_guard_condition(&wait_set, &handle_, nullptr);
}

// ---- Waitables ----------------------------------------------------------------------------------

namespace {

/// What a waitable's `add_to_wait_set` fills.
struct Conditions {
  std::vector<const rcl_guard_condition_t*> list;
  rcl_wait_set_t set{};
  Conditions() { set.impl = this; }
};

}  // namespace

}  // namespace rclcpp

extern "C" rcl_ret_t rcl_wait_set_add_guard_condition(rcl_wait_set_t* wait_set,
                                                      const rcl_guard_condition_t* guard_condition,
                                                      size_t* index) {
  auto* conditions = static_cast<rclcpp::Conditions*>(wait_set->impl);
  if (!conditions) return RCL_RET_WAIT_SET_INVALID;
  if (index) *index = conditions->list.size();
  conditions->list.push_back(guard_condition);
  wait_set->guard_conditions = conditions->list.data();
  wait_set->size_of_guard_conditions = conditions->list.size();
  return RCL_RET_OK;
}

extern "C" rcl_ret_t rcl_trigger_guard_condition(rcl_guard_condition_t* guard_condition) {
  if (!guard_condition || !guard_condition->impl) return RCL_RET_INVALID_ARGUMENT;
  static_cast<rclcpp::GuardCondition*>(guard_condition->impl)->trigger();
  return RCL_RET_OK;
}

namespace rclcpp {

bool Waitable::has_work() {
  Conditions conditions;
  add_to_wait_set(conditions.set);
  for (auto& one : conditions.list) {
    auto* condition = one ? static_cast<GuardCondition*>(one->impl) : nullptr;
    // A guard condition is spent by looking at it, as rcl_wait does.
    if (!condition || !condition->do_work()) one = nullptr;
  }
  return is_ready(static_cast<const rcl_wait_set_t&>(conditions.set));
}

bool Waitable::do_work() {
  std::shared_ptr<void> data = take_data();
  execute(static_cast<const std::shared_ptr<void>&>(data));
  return true;
}

void Waitable::add_waker(const std::shared_ptr<detail::Waker>& waker) {
  Executable::add_waker(waker);
  Conditions conditions;
  add_to_wait_set(conditions.set);
  for (const auto* one : conditions.list) {
    if (one && one->impl) static_cast<GuardCondition*>(one->impl)->add_waker(waker);
  }
}

void Waitable::set_on_ready_callback(std::function<void(std::size_t, int)> callback) {
  set_on_new_work([callback](std::size_t count) { callback(count, 0); });
}

// ---- Callback groups ----------------------------------------------------------------------------

CallbackGroup::CallbackGroup(CallbackGroupType type, bool automatically_add_to_executor_with_node)
    : type_(type), automatic_(automatically_add_to_executor_with_node) {}

CallbackGroup::CallbackGroup(CallbackGroupType type, std::function<Context::SharedPtr()>,
                             bool automatically_add_to_executor_with_node)
    : CallbackGroup(type, automatically_add_to_executor_with_node) {}

CallbackGroup::~CallbackGroup() { detail::entities_changed(); }

std::vector<std::shared_ptr<detail::Executable>> CallbackGroup::executables() const {
  std::vector<std::shared_ptr<detail::Executable>> strong;
  std::lock_guard<std::mutex> lock(mutex_);
  strong.reserve(executables_.size());
  for (const auto& one : executables_) {
    if (auto found = one.lock()) strong.push_back(std::move(found));
  }
  if (strong.size() != executables_.size()) {
    executables_.assign(strong.begin(), strong.end());
  }
  return strong;
}

std::size_t CallbackGroup::size() const { return executables().size(); }

void CallbackGroup::add(const std::shared_ptr<detail::Executable>& executable) {
  std::vector<std::weak_ptr<detail::Waker>> wakers;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    executables_.push_back(executable);
    wakers = wakers_;
  }
  detail::entities_changed();
  for (const auto& one : wakers) {
    if (const auto waker = one.lock()) waker->ring();
  }
}

void CallbackGroup::remove(const detail::Executable* executable) {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    executables_.erase(std::remove_if(executables_.begin(), executables_.end(),
                                      [executable](const auto& one) {
                                        const auto strong = one.lock();
                                        return !strong || strong.get() == executable;
                                      }),
                       executables_.end());
  }
  detail::entities_changed();
}

void CallbackGroup::add_waker(const std::shared_ptr<detail::Waker>& waker) {
  std::lock_guard<std::mutex> lock(mutex_);
  for (const auto& one : wakers_) {
    if (one.lock() == waker) return;
  }
  wakers_.push_back(waker);
}

void CallbackGroup::remove_waker(const detail::Waker* waker) {
  std::lock_guard<std::mutex> lock(mutex_);
  wakers_.erase(std::remove_if(wakers_.begin(), wakers_.end(),
                               [waker](const auto& one) {
                                 const auto strong = one.lock();
                                 return !strong || strong.get() == waker;
                               }),
                wakers_.end());
}

void CallbackGroup::collect_all_ptrs(
    std::function<void(const std::shared_ptr<SubscriptionBase>&)> subscription,
    std::function<void(const std::shared_ptr<ServiceBase>&)> service,
    std::function<void(const std::shared_ptr<ClientBase>&)> client,
    std::function<void(const std::shared_ptr<TimerBase>&)> timer,
    std::function<void(const std::shared_ptr<Waitable>&)> waitable) const {
  for (const auto& one : executables()) {
    switch (one->kind()) {
      case detail::WorkKind::kTimer:
        timer(std::static_pointer_cast<TimerBase>(one));
        break;
      case detail::WorkKind::kSubscription:
        subscription(std::static_pointer_cast<SubscriptionBase>(one));
        break;
      case detail::WorkKind::kService:
        service(std::static_pointer_cast<ServiceBase>(one));
        break;
      case detail::WorkKind::kClient:
        client(std::static_pointer_cast<ClientBase>(one));
        break;
      case detail::WorkKind::kWaitable:
        if (auto found = std::dynamic_pointer_cast<Waitable>(one)) waitable(found);
        break;
      case detail::WorkKind::kGuardCondition:
        break;
    }
  }
}

}  // namespace rclcpp
