// Wait sets: several things waited for without callbacks.
#include "rclcpp/wait_set.hpp"

#include <algorithm>
#include <utility>

namespace rclcpp {
namespace detail {

WaitSetCore::WaitSetCore() : waker_(std::make_shared<Waker>()) {}
WaitSetCore::~WaitSetCore() {
  for (const auto& one : entries_) {
    if (const auto strong = one.weak.lock()) {
      strong->remove_waker(waker_.get());
      strong->exchange_in_use_by_wait_set_state(false);
    }
  }
}

void WaitSetCore::add(const std::shared_ptr<Executable>& executable) {
  if (!executable) throw std::invalid_argument("what is added to a wait set is null");
  if (executable->exchange_in_use_by_wait_set_state(true)) {
    throw std::runtime_error("it is already in use by another wait set");
  }
  std::lock_guard<std::mutex> lock(mutex_);
  executable->add_waker(waker_);
  entries_.push_back({executable, nullptr, false});
  waker_->ring();
}

void WaitSetCore::remove(const std::shared_ptr<Executable>& executable) {
  if (!executable) throw std::invalid_argument("what is removed from a wait set is null");
  std::lock_guard<std::mutex> lock(mutex_);
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& one) { return one.weak.lock() == executable; });
  if (found == entries_.end()) throw std::runtime_error("it is not in the wait set");
  entries_.erase(found);
  executable->remove_waker(waker_.get());
  executable->exchange_in_use_by_wait_set_state(false);
  waker_->ring();
}

void WaitSetCore::prune() {
  std::lock_guard<std::mutex> lock(mutex_);
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(),
                                [](const Entry& one) { return one.weak.expired(); }),
                 entries_.end());
}

void WaitSetCore::release() {
  std::lock_guard<std::mutex> lock(mutex_);
  for (auto& one : entries_) one.strong.reset();
}

WaitResultKind WaitSetCore::wait(std::chrono::nanoseconds timeout, Context& context) {
  using Steady = std::chrono::steady_clock;
  const bool endless = timeout < std::chrono::nanoseconds(0);
  const auto end = Steady::now() + (endless ? std::chrono::nanoseconds(0) : timeout);
  std::weak_ptr<Waker> weak = waker_;
  const auto handle = context.add_on_shutdown_callback([weak]() {
    if (const auto strong = weak.lock()) strong->ring();
  });
  const std::shared_ptr<void> unhook(nullptr,
                                     [&](void*) { context.remove_on_shutdown_callback(handle); });
  for (;;) {
    const std::uint64_t seen = waker_->count();
    std::optional<Steady::time_point> until;
    if (!endless) until = end;
    bool any = false;
    {
      std::lock_guard<std::mutex> lock(mutex_);
      if (entries_.empty()) return WaitResultKind::Empty;
      const auto now = Steady::now();
      for (auto& one : entries_) {
        one.strong = one.weak.lock();
        one.ready = one.strong && one.strong->has_work();
        // A guard condition is spent by the wait that it ends.
        if (one.ready && one.strong->kind() == WorkKind::kGuardCondition) one.strong->do_work();
        any = any || one.ready;
        if (one.strong && !one.ready) {
          if (const auto left = one.strong->time_until_work()) {
            if (!until || now + *left < *until) until = now + *left;
          }
        }
      }
    }
    if (any) return WaitResultKind::Ready;
    if (!context.is_valid()) return WaitResultKind::Timeout;
    if (!endless && Steady::now() >= end) return WaitResultKind::Timeout;
    waker_->wait(seen, until);
  }
}

const void* ReadyView::operator[](std::size_t index) const {
  for (const auto& one : core_->entries()) {
    if (!one.strong || one.strong->kind() != kind_) continue;
    if (index-- == 0) return one.ready ? one.strong.get() : nullptr;
  }
  return nullptr;
}

ReadyViews views_of(WaitSetCore& core) {
  ReadyViews views{{core, WorkKind::kSubscription},
                   {core, WorkKind::kTimer},
                   {core, WorkKind::kService},
                   {core, WorkKind::kClient},
                   {core, WorkKind::kGuardCondition}};
  for (const auto& one : core.entries()) {
    if (!one.strong) continue;
    switch (one.strong->kind()) {
      case WorkKind::kSubscription:
        ++views.size_of_subscriptions;
        break;
      case WorkKind::kTimer:
        ++views.size_of_timers;
        break;
      case WorkKind::kService:
        ++views.size_of_services;
        break;
      case WorkKind::kClient:
        ++views.size_of_clients;
        break;
      case WorkKind::kGuardCondition:
        ++views.size_of_guard_conditions;
        break;
      case WorkKind::kWaitable:
        break;
    }
  }
  return views;
}

}  // namespace detail

WaitSet::WaitSet(const SubscriptionsIterable& subscriptions,
                 const GuardConditionsIterable& guard_conditions, const TimersIterable& timers,
                 const ClientsIterable& clients, const ServicesIterable& services,
                 const WaitablesIterable& waitables, Context::SharedPtr context)
    : core_(std::make_shared<detail::WaitSetCore>()),
      context_(std::move(context)),
      views_(detail::views_of(*core_)) {
  for (const auto& one : subscriptions) add_subscription(one.subscription, one.mask);
  for (const auto& one : guard_conditions) add_guard_condition(one);
  for (const auto& one : timers) add_timer(one);
  for (const auto& one : clients) add_client(one);
  for (const auto& one : services) add_service(one);
  for (const auto& one : waitables) add_waitable(one.waitable, one.associated_entity);
}

void WaitSet::add_subscription(std::shared_ptr<SubscriptionBase> subscription,
                               SubscriptionWaitSetMask mask) {
  if (!subscription) throw std::invalid_argument("subscription is nullptr");
  if (mask.include_subscription) core_->add(subscription);
  if (mask.include_events) {
    for (const auto& one : subscription->get_event_handlers()) core_->add(one.second);
  }
}
void WaitSet::remove_subscription(std::shared_ptr<SubscriptionBase> subscription,
                                  SubscriptionWaitSetMask mask) {
  if (!subscription) throw std::invalid_argument("subscription is nullptr");
  if (mask.include_subscription) core_->remove(subscription);
  if (mask.include_events) {
    for (const auto& one : subscription->get_event_handlers()) core_->remove(one.second);
  }
}
void WaitSet::add_guard_condition(std::shared_ptr<GuardCondition> one) { core_->add(one); }
void WaitSet::remove_guard_condition(std::shared_ptr<GuardCondition> one) { core_->remove(one); }
void WaitSet::add_timer(std::shared_ptr<TimerBase> one) { core_->add(one); }
void WaitSet::remove_timer(std::shared_ptr<TimerBase> one) { core_->remove(one); }
void WaitSet::add_client(std::shared_ptr<ClientBase> one) { core_->add(one); }
void WaitSet::remove_client(std::shared_ptr<ClientBase> one) { core_->remove(one); }
void WaitSet::add_service(std::shared_ptr<ServiceBase> one) { core_->add(one); }
void WaitSet::remove_service(std::shared_ptr<ServiceBase> one) { core_->remove(one); }
void WaitSet::add_waitable(std::shared_ptr<Waitable> one, std::shared_ptr<void>) {
  core_->add(one);
}
void WaitSet::remove_waitable(std::shared_ptr<Waitable> one) { core_->remove(one); }

}  // namespace rclcpp
