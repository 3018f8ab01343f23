#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "rclcpp/client.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/service.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/subscription_wait_set_mask.hpp"
#include "rclcpp/timer.hpp"
#include "rclcpp/wait_result_kind.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {
namespace detail {

/// What wait sets of all kinds do.
class RCLCPP_PUBLIC WaitSetCore {
 public:
  struct Entry {
    std::weak_ptr<Executable> weak;
    std::shared_ptr<Executable> strong;  // while one waits and looks at what came
    bool ready = false;
  };
  WaitSetCore();
  ~WaitSetCore();
  void add(const std::shared_ptr<Executable>& executable);
  void remove(const std::shared_ptr<Executable>& executable);
  void prune();
  WaitResultKind wait(std::chrono::nanoseconds timeout, Context& context);
  /// Let go of what the last wait held.
  void release();
  std::vector<Entry>& entries() { return entries_; }
  std::mutex& mutex() { return mutex_; }

 private:
  std::shared_ptr<Waker> waker_;
  std::vector<Entry> entries_;
  std::mutex mutex_;
};

/// The view of one kind of entries that C code would have: null where it is not ready.
class RCLCPP_PUBLIC ReadyView {
 public:
  ReadyView(WaitSetCore& core, WorkKind kind) : core_(&core), kind_(kind) {}
  const void* operator[](std::size_t index) const;

 private:
  WaitSetCore* core_;
  WorkKind kind_;
};

struct ReadyViews {
  ReadyView subscriptions, timers, services, clients, guard_conditions;
  std::size_t size_of_subscriptions = 0, size_of_timers = 0, size_of_services = 0,
              size_of_clients = 0, size_of_guard_conditions = 0;
};

RCLCPP_PUBLIC ReadyViews views_of(WaitSetCore& core);

}  // namespace detail

template <class WaitSetT>
class WaitResult;

/// Waits for several things at once, without callbacks.
class RCLCPP_PUBLIC WaitSet {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(WaitSet)

  /// A subscription with the parts that are waited for.
  struct SubscriptionEntry {
    std::shared_ptr<SubscriptionBase> subscription;
    SubscriptionWaitSetMask mask;
    SubscriptionEntry(std::shared_ptr<SubscriptionBase> given = nullptr,  // NOLINT
                      const SubscriptionWaitSetMask& mask_in = {})
        : subscription(std::move(given)), mask(mask_in) {}
    template <typename T>
    SubscriptionEntry(std::shared_ptr<T> given)  // NOLINT(runtime/explicit)
        : subscription(std::move(given)) {}
  };
  /// Other work, with what owns it.
  struct WaitableEntry {
    std::shared_ptr<Waitable> waitable;
    std::shared_ptr<void> associated_entity;
    WaitableEntry(std::shared_ptr<Waitable> given = nullptr,  // NOLINT
                  std::shared_ptr<void> entity = nullptr)
        : waitable(std::move(given)), associated_entity(std::move(entity)) {}
  };
  using SubscriptionsIterable = std::vector<SubscriptionEntry>;
  using GuardConditionsIterable = std::vector<std::shared_ptr<GuardCondition>>;
  using TimersIterable = std::vector<std::shared_ptr<TimerBase>>;
  using ClientsIterable = std::vector<std::shared_ptr<ClientBase>>;
  using ServicesIterable = std::vector<std::shared_ptr<ServiceBase>>;
  using WaitablesIterable = std::vector<WaitableEntry>;

  explicit WaitSet(const SubscriptionsIterable& subscriptions = {},
                   const GuardConditionsIterable& guard_conditions = {},
                   const TimersIterable& timers = {}, const ClientsIterable& clients = {},
                   const ServicesIterable& services = {}, const WaitablesIterable& waitables = {},
                   Context::SharedPtr context = contexts::get_global_default_context());
  virtual ~WaitSet() = default;

  void add_subscription(std::shared_ptr<SubscriptionBase> subscription,
                        SubscriptionWaitSetMask mask = {});
  void remove_subscription(std::shared_ptr<SubscriptionBase> subscription,
                           SubscriptionWaitSetMask mask = {});
  void add_guard_condition(std::shared_ptr<GuardCondition> guard_condition);
  void remove_guard_condition(std::shared_ptr<GuardCondition> guard_condition);
  void add_timer(std::shared_ptr<TimerBase> timer);
  void remove_timer(std::shared_ptr<TimerBase> timer);
  void add_client(std::shared_ptr<ClientBase> client);
  void remove_client(std::shared_ptr<ClientBase> client);
  void add_service(std::shared_ptr<ServiceBase> service);
  void remove_service(std::shared_ptr<ServiceBase> service);
  void add_waitable(std::shared_ptr<Waitable> waitable,
                    std::shared_ptr<void> associated_entity = nullptr);
  void remove_waitable(std::shared_ptr<Waitable> waitable);
  void prune_deleted_entities() { core_->prune(); }

  template <class Rep = int64_t, class Period = std::milli>
  WaitResult<WaitSet> wait(
      std::chrono::duration<Rep, Period> time_to_wait = std::chrono::duration<Rep, Period>(-1));

  /// What C code would see after a wait: what is not ready is null.
  const detail::ReadyViews& get_rcl_wait_set() const { return views_; }
  detail::WaitSetCore& core() { return *core_; }

 protected:
  std::shared_ptr<detail::WaitSetCore> core_;
  Context::SharedPtr context_;
  detail::ReadyViews views_;
  std::vector<std::shared_ptr<detail::Executable>> kept_;
  bool keeps_ = false;
};

/// What a wait came to; looks at the wait set as long as it lives.
template <class WaitSetT>
class WaitResult {
 public:
  WaitResult(WaitResultKind kind, WaitSetT* wait_set) : kind_(kind), wait_set_(wait_set) {}
  WaitResult(WaitResult&& other) noexcept : kind_(other.kind_), wait_set_(other.wait_set_) {
    other.wait_set_ = nullptr;
  }
  ~WaitResult() {
    if (wait_set_) wait_set_->core().release();
  }
  WaitResultKind kind() const { return kind_; }
  const WaitSetT& get_wait_set() const {
    if (kind_ != WaitResultKind::Ready) {
      throw std::runtime_error("cannot access wait set when the result was not ready");
    }
    return *wait_set_;
  }
  WaitSetT& get_wait_set() {
    return const_cast<WaitSetT&>(static_cast<const WaitResult&>(*this).get_wait_set());
  }
  std::shared_ptr<TimerBase> peek_next_ready_timer(std::size_t start = 0) {
    return next<TimerBase>(detail::WorkKind::kTimer, start, false);
  }
  std::shared_ptr<TimerBase> next_ready_timer() {
    return next<TimerBase>(detail::WorkKind::kTimer, 0, true);
  }
  std::shared_ptr<SubscriptionBase> next_ready_subscription() {
    return next<SubscriptionBase>(detail::WorkKind::kSubscription, 0, true);
  }
  std::shared_ptr<ServiceBase> next_ready_service() {
    return next<ServiceBase>(detail::WorkKind::kService, 0, true);
  }
  std::shared_ptr<ClientBase> next_ready_client() {
    return next<ClientBase>(detail::WorkKind::kClient, 0, true);
  }
  std::shared_ptr<Waitable> next_ready_waitable() {
    return next<Waitable>(detail::WorkKind::kWaitable, 0, true);
  }

 private:
  template <class T>
  std::shared_ptr<T> next(detail::WorkKind kind, std::size_t start, bool take) {
    std::size_t index = 0;
    for (auto& entry : wait_set_->core().entries()) {
      if (!entry.strong || entry.strong->kind() != kind || index++ < start || !entry.ready)
        continue;
      if (take) entry.ready = false;
      return std::dynamic_pointer_cast<T>(entry.strong);
    }
    return nullptr;
  }
  WaitResultKind kind_;
  WaitSetT* wait_set_;
};

template <class Rep, class Period>
WaitResult<WaitSet> WaitSet::wait(std::chrono::duration<Rep, Period> time_to_wait) {
  const auto kind =
      core_->wait(std::chrono::duration_cast<std::chrono::nanoseconds>(time_to_wait), *context_);
  views_ = detail::views_of(*core_);
  return WaitResult<WaitSet>(kind, this);
}

/// The same; all wait sets here may be used by several threads.
class RCLCPP_PUBLIC ThreadSafeWaitSet : public WaitSet {
 public:
  using WaitSet::WaitSet;
};

/// A wait set whose numbers of things are known beforehand; it keeps them alive.
template <std::size_t NumberOfSubscriptions, std::size_t NumberOfGuardConditions,
          std::size_t NumberOfTimers, std::size_t NumberOfClients, std::size_t NumberOfServices,
          std::size_t NumberOfWaitables>
class StaticWaitSet : public WaitSet {
 public:
  template <class T, std::size_t N>
  using Some = std::array<T, N>;
  StaticWaitSet(const Some<SubscriptionEntry, NumberOfSubscriptions>& subscriptions = {},
                const Some<std::shared_ptr<GuardCondition>, NumberOfGuardConditions>& guards = {},
                const Some<std::shared_ptr<TimerBase>, NumberOfTimers>& timers = {},
                const Some<std::shared_ptr<ClientBase>, NumberOfClients>& clients = {},
                const Some<std::shared_ptr<ServiceBase>, NumberOfServices>& services = {},
                const Some<WaitableEntry, NumberOfWaitables>& waitables = {},
                Context::SharedPtr context = contexts::get_global_default_context())
      : WaitSet({subscriptions.begin(), subscriptions.end()}, {guards.begin(), guards.end()},
                {timers.begin(), timers.end()}, {clients.begin(), clients.end()},
                {services.begin(), services.end()}, {waitables.begin(), waitables.end()},
                std::move(context)) {
    for (auto& entry : core_->entries()) {
      if (auto strong = entry.weak.lock()) kept_.push_back(strong);
    }
  }
};

}  // namespace rclcpp
