// Synchronizers: sets of messages of up to nine topics, by a policy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <gazelle/message_filters/calls.hpp>
#include <gazelle/message_filters/filters.hpp>
#include <gazelle/message_filters/matching.hpp>

namespace message_filters {

// The types of a policy.
template <typename M0, typename M1, typename M2, typename M3, typename M4, typename M5, typename M6,
          typename M7, typename M8>
struct PolicyBase {
  using Messages = std::tuple<M0, M1, M2, M3, M4, M5, M6, M7, M8>;
  using Events =
      std::tuple<platform::Event<M0 const>, platform::Event<M1 const>, platform::Event<M2 const>,
                 platform::Event<M3 const>, platform::Event<M4 const>, platform::Event<M5 const>,
                 platform::Event<M6 const>, platform::Event<M7 const>, platform::Event<M8 const>>;
  template <class M>
  static constexpr std::size_t is_real = std::is_same_v<M, NullType> ? 0 : 1;
  using RealTypeCount =
      std::integral_constant<std::size_t, is_real<M0> + is_real<M1> + is_real<M2> + is_real<M3> +
                                              is_real<M4> + is_real<M5> + is_real<M6> +
                                              is_real<M7> + is_real<M8>>;
  using M0Event = std::tuple_element_t<0, Events>;
  using M1Event = std::tuple_element_t<1, Events>;
  using M2Event = std::tuple_element_t<2, Events>;
  using M3Event = std::tuple_element_t<3, Events>;
  using M4Event = std::tuple_element_t<4, Events>;
  using M5Event = std::tuple_element_t<5, Events>;
  using M6Event = std::tuple_element_t<6, Events>;
  using M7Event = std::tuple_element_t<7, Events>;
  using M8Event = std::tuple_element_t<8, Events>;
};

namespace detail {

// Back from a matcher's set to events with types.
template <class Events, std::size_t... I>
Events events_of(const std::vector<std::shared_ptr<const void>>& found, std::index_sequence<I...>) {
  Events events;
  ((I < found.size() && found[I]
        ? void(std::get<I>(events) =
                   *static_cast<const std::tuple_element_t<I, Events>*>(found[I].get()))
        : void()),
   ...);
  return events;
}
template <class Events>
Events events_of(const std::vector<std::shared_ptr<const void>>& found) {
  return events_of<Events>(found, std::make_index_sequence<std::tuple_size_v<Events>>{});
}

template <class A, class...>
struct FirstOf {
  using type = std::remove_cv_t<A>;
};
template <class... A>
using First = typename FirstOf<A...>::type;

// A matcher with the sets that it has found; they are told without its lock.
template <class Matcher>
struct Locked {
  std::mutex mutex;
  std::unique_ptr<Matcher> matcher;
  std::vector<std::vector<std::shared_ptr<const void>>> found, dropped;
};

}  // namespace detail

template <class Policy>
class Synchronizer
    : public Policy,
      public detail::Registers<typename Policy::Events, Policy::RealTypeCount::value> {
 public:
  using Messages = typename Policy::Messages;
  using Events = typename Policy::Events;
  static constexpr std::size_t kCount = Policy::RealTypeCount::value;

  Synchronizer() { this->initParent(this); }
  Synchronizer(const Policy& policy) : Policy(policy) { this->initParent(this); }  // NOLINT
  template <class... F, class = std::enable_if_t<(sizeof...(F) >= 2) &&
                                                 !std::is_base_of_v<Policy, detail::First<F...>>>>
  explicit Synchronizer(F&... filters) {
    this->initParent(this);
    connectInput(filters...);
  }
  template <class... F, class = std::enable_if_t<(sizeof...(F) >= 2)>>
  Synchronizer(const Policy& policy, F&... filters) : Policy(policy) {
    this->initParent(this);
    connectInput(filters...);
  }
  ~Synchronizer() { disconnectAll(); }
  Synchronizer(const Synchronizer&) = delete;
  Synchronizer& operator=(const Synchronizer&) = delete;

  template <class... F>
  void connectInput(F&... filters) {
    static_assert(sizeof...(F) >= kCount, "a filter for each topic of the policy");
    disconnectAll();
    connect(std::make_index_sequence<kCount>{}, std::tie(filters...));
  }

  using detail::Registers<Events, kCount>::registerCallback;

  void setName(const std::string& name) { name_ = name; }
  const std::string& getName() { return name_; }
  Policy* getPolicy() { return this; }

  void signal(const typename Policy::M0Event& e0, const typename Policy::M1Event& e1,
              const typename Policy::M2Event& e2, const typename Policy::M3Event& e3,
              const typename Policy::M4Event& e4, const typename Policy::M5Event& e5,
              const typename Policy::M6Event& e6, const typename Policy::M7Event& e7,
              const typename Policy::M8Event& e8) {
    this->tell(Events(e0, e1, e2, e3, e4, e5, e6, e7, e8));
  }
  void signal(const Events& events) { this->tell(events); }

  using Policy::add;
  // A message without a filter.
  template <int i>
  void add(const platform::Ptr<std::tuple_element_t<i, Messages> const>& message) {
    this->template add<i>(std::tuple_element_t<i, Events>(message));
  }

 private:
  template <std::size_t... I, class Filters>
  void connect(std::index_sequence<I...>, const Filters& filters) {
    ((connections_[I] = connect_events<std::tuple_element_t<I, Messages>>(
          std::get<I>(filters),
          [this](const std::tuple_element_t<I, Events>& event) {
            this->template add<static_cast<int>(I)>(event);
          })),
     ...);
  }
  void disconnectAll() {
    for (Connection& connection : connections_) connection.disconnect();
  }

  std::array<Connection, 9> connections_;
  std::string name_;
};

namespace sync_policies {

// Sets of equal stamps.
template <typename M0, typename M1, typename M2 = NullType, typename M3 = NullType,
          typename M4 = NullType, typename M5 = NullType, typename M6 = NullType,
          typename M7 = NullType, typename M8 = NullType>
struct ExactTime : public PolicyBase<M0, M1, M2, M3, M4, M5, M6, M7, M8> {
  using Sync = Synchronizer<ExactTime>;
  using Super = PolicyBase<M0, M1, M2, M3, M4, M5, M6, M7, M8>;
  using Events = typename Super::Events;

  explicit ExactTime(std::uint32_t queue_size) : queue_size_(queue_size) {}
  ExactTime(const ExactTime& other) : Super(other), queue_size_(other.queue_size_) {}

  void initParent(Sync* parent) {
    parent_ = parent;
    auto* locked = locked_.get();
    locked->matcher = std::make_unique<gazelle::ExactMatcher>(
        Super::RealTypeCount::value, queue_size_,
        [locked](const auto& events) { locked->found.push_back(events); });
    locked->matcher->on_drop([locked](const auto& events) { locked->dropped.push_back(events); });
  }
  template <int i>
  void add(const std::tuple_element_t<i, Events>& event) {
    decltype(locked_->found) found, dropped;
    {
      const std::lock_guard<std::mutex> lock(locked_->mutex);
      locked_->matcher->add(i, {platform::ns_of(platform::stamp(*event.getConstMessage())),
                                std::make_shared<std::tuple_element_t<i, Events>>(event)});
      found.swap(locked_->found);
      dropped.swap(locked_->dropped);
    }
    for (const auto& events : found) parent_->signal(detail::events_of<Events>(events));
    for (const auto& events : dropped) drops_.drop(detail::events_of<Events>(events));
  }
  // Called with the messages of sets that never became whole; places without one are null.
  template <class... C>
  Connection registerDropCallback(C&&... callback) {
    return drops_.registerCallback(std::forward<C>(callback)...);
  }

 private:
  struct Drops : detail::Registers<Events, Super::RealTypeCount::value> {
    void drop(const Events& events) { this->tell(events); }
  };
  std::uint32_t queue_size_;
  Sync* parent_ = nullptr;
  std::unique_ptr<detail::Locked<gazelle::ExactMatcher>> locked_ =
      std::make_unique<detail::Locked<gazelle::ExactMatcher>>();
  Drops drops_;
};

// Sets of stamps near each other.
template <typename M0, typename M1, typename M2 = NullType, typename M3 = NullType,
          typename M4 = NullType, typename M5 = NullType, typename M6 = NullType,
          typename M7 = NullType, typename M8 = NullType>
struct ApproximateTime : public PolicyBase<M0, M1, M2, M3, M4, M5, M6, M7, M8> {
  using Sync = Synchronizer<ApproximateTime>;
  using Super = PolicyBase<M0, M1, M2, M3, M4, M5, M6, M7, M8>;
  using Events = typename Super::Events;

  explicit ApproximateTime(std::uint32_t queue_size) : queue_size_(queue_size) {}
  ApproximateTime(const ApproximateTime& other)
      : Super(other),
        queue_size_(other.queue_size_),
        age_penalty_(other.age_penalty_),
        max_interval_ns_(other.max_interval_ns_),
        bounds_ns_(other.bounds_ns_) {}

  void initParent(Sync* parent) {
    parent_ = parent;
    auto* locked = locked_.get();
    locked->matcher = std::make_unique<gazelle::ApproximateMatcher>(
        Super::RealTypeCount::value, queue_size_,
        [locked](const auto& events) { locked->found.push_back(events); });
    locked->matcher->broken_bound = [](std::size_t topic, bool goes_back) {
      platform::warn_of_bound(static_cast<int>(topic), goes_back);
    };
    configure();
  }
  template <int i>
  void add(const std::tuple_element_t<i, Events>& event) {
    decltype(locked_->found) found;
    {
      const std::lock_guard<std::mutex> lock(locked_->mutex);
      locked_->matcher->add(i, {platform::ns_of(platform::stamp(*event.getConstMessage())),
                                std::make_shared<std::tuple_element_t<i, Events>>(event)});
      found.swap(locked_->found);
    }
    for (const auto& events : found) parent_->signal(detail::events_of<Events>(events));
  }

  void setAgePenalty(double age_penalty) {
    age_penalty_ = age_penalty;
    configure();
  }
  void setInterMessageLowerBound(int i, platform::Duration lower_bound) {
    bounds_ns_.at(static_cast<std::size_t>(i)) = platform::ns_of(lower_bound);
    configure();
  }
  void setInterMessageLowerBound(platform::Duration lower_bound) {
    bounds_ns_.fill(platform::ns_of(lower_bound));
    configure();
  }
  void setMaxIntervalDuration(platform::Duration max_interval_duration) {
    max_interval_ns_ = platform::ns_of(max_interval_duration);
    configure();
  }

 private:
  void configure() {
    const std::lock_guard<std::mutex> lock(locked_->mutex);
    if (!locked_->matcher) return;
    locked_->matcher->age_penalty = age_penalty_;
    locked_->matcher->max_interval_ns = max_interval_ns_;
    for (std::size_t i = 0; i < Super::RealTypeCount::value; ++i)
      locked_->matcher->set_lower_bound(i, bounds_ns_[i]);
  }

  std::uint32_t queue_size_;
  double age_penalty_ = 0.1;
  std::int64_t max_interval_ns_ = INT64_MAX;
  std::array<std::int64_t, 9> bounds_ns_{};
  Sync* parent_ = nullptr;
  std::unique_ptr<detail::Locked<gazelle::ApproximateMatcher>> locked_ =
      std::make_unique<detail::Locked<gazelle::ApproximateMatcher>>();
};

}  // namespace sync_policies

// A synchronizer of equal stamps that takes its filters at once.
template <class M0, class M1, class M2 = NullType, class M3 = NullType, class M4 = NullType,
          class M5 = NullType, class M6 = NullType, class M7 = NullType, class M8 = NullType>
class TimeSynchronizer
    : public Synchronizer<sync_policies::ExactTime<M0, M1, M2, M3, M4, M5, M6, M7, M8>> {
 public:
  using Policy = sync_policies::ExactTime<M0, M1, M2, M3, M4, M5, M6, M7, M8>;
  using Base = Synchronizer<Policy>;
  using M0ConstPtr = platform::Ptr<M0 const>;
  using M1ConstPtr = platform::Ptr<M1 const>;
  using M2ConstPtr = platform::Ptr<M2 const>;
  using M3ConstPtr = platform::Ptr<M3 const>;
  using M4ConstPtr = platform::Ptr<M4 const>;
  using M5ConstPtr = platform::Ptr<M5 const>;
  using M6ConstPtr = platform::Ptr<M6 const>;
  using M7ConstPtr = platform::Ptr<M7 const>;
  using M8ConstPtr = platform::Ptr<M8 const>;

  explicit TimeSynchronizer(std::uint32_t queue_size) : Base(Policy(queue_size)) {}
  // The filters, and behind them the size of the queue.
  template <class F0, class F1, class... More>
  TimeSynchronizer(F0& f0, F1& f1, const More&... more) : Base(Policy(last(more...))) {
    take(std::tie(f0, f1, const_cast<More&>(more)...),
         std::make_index_sequence<sizeof...(More) + 1>{});
  }

  void add0(const M0ConstPtr& message) { Base::template add<0>(message); }
  void add1(const M1ConstPtr& message) { Base::template add<1>(message); }
  void add2(const M2ConstPtr& message) { Base::template add<2>(message); }
  void add3(const M3ConstPtr& message) { Base::template add<3>(message); }
  void add4(const M4ConstPtr& message) { Base::template add<4>(message); }
  void add5(const M5ConstPtr& message) { Base::template add<5>(message); }
  void add6(const M6ConstPtr& message) { Base::template add<6>(message); }
  void add7(const M7ConstPtr& message) { Base::template add<7>(message); }
  void add8(const M8ConstPtr& message) { Base::template add<8>(message); }

 private:
  template <class... More>
  static std::uint32_t last(const More&... more) {
    return static_cast<std::uint32_t>(std::get<sizeof...(More) - 1>(std::tie(more...)));
  }
  template <class All, std::size_t... I>
  void take(const All& all, std::index_sequence<I...>) {
    this->connectInput(std::get<I>(all)...);
  }
};

}  // namespace message_filters
