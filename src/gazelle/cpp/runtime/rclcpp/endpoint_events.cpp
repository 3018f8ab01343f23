#include "endpoint_events.hpp"

#include <utility>

namespace rclcpp {
namespace detail {

void EventWork::push(std::function<void()> call) {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    calls_.push_back(std::move(call));
  }
  announce_work();
}

bool EventWork::has_work() {
  std::lock_guard<std::mutex> lock(mutex_);
  return !calls_.empty();
}

bool EventWork::do_work() {
  std::function<void()> call;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (calls_.empty()) return false;
    call = std::move(calls_.front());
    calls_.pop_front();
  }
  call();
  return true;
}

EndpointEvents::EndpointEvents(const PublisherEventCallbacks& callbacks, const QoS& qos)
    : is_publisher_(true), publisher_(callbacks), qos_(qos), work_(std::make_shared<EventWork>()) {
  any_ = callbacks.deadline_callback || callbacks.liveliness_callback ||
         callbacks.incompatible_qos_callback || callbacks.matched_callback;
}

EndpointEvents::EndpointEvents(const SubscriptionEventCallbacks& callbacks, const QoS& qos)
    : is_publisher_(false),
      subscription_(callbacks),
      qos_(qos),
      work_(std::make_shared<EventWork>()) {
  any_ = callbacks.deadline_callback || callbacks.liveliness_callback ||
         callbacks.incompatible_qos_callback || callbacks.message_lost_callback ||
         callbacks.matched_callback;
}

EndpointEvents::~EndpointEvents() { stop(); }

std::unordered_map<int, std::shared_ptr<Waitable>> EndpointEvents::handlers() const {
  if (!any_) return {};
  return {{0, work_}};
}

void EndpointEvents::start() {
  if (!any_) return;
  std::weak_ptr<EndpointEvents> weak = weak_from_this();
  const auto graph = qos_.to_graph();
  on_activity();
  on_alive();
  if (graph.deadline_ns > 0 && is_publisher_ && publisher_.deadline_callback) {
    watch(last_activity_ns_, graph.deadline_ns, deadline_alarm_, [weak]() {
      const auto self = weak.lock();
      if (!self) return;
      QOSDeadlineOfferedInfo info{++self->deadline_misses_, 1};
      self->publisher_.deadline_callback(info);
    });
  }
  if (graph.deadline_ns > 0 && !is_publisher_ && subscription_.deadline_callback) {
    watch(last_activity_ns_, graph.deadline_ns, deadline_alarm_, [weak]() {
      const auto self = weak.lock();
      if (!self) return;
      QOSDeadlineRequestedInfo info{++self->deadline_misses_, 1};
      self->subscription_.deadline_callback(info);
    });
  }
  if (is_publisher_ && graph.manual_liveliness && graph.lease_ns > 0 &&
      publisher_.liveliness_callback) {
    watch(last_alive_ns_, graph.lease_ns, lease_alarm_, [weak]() {
      const auto self = weak.lock();
      if (!self) return;
      QOSLivelinessLostInfo info{++self->lease_misses_, 1};
      self->publisher_.liveliness_callback(info);
    });
  }
}

void EndpointEvents::stop() {
  std::lock_guard<std::mutex> lock(mutex_);
  stopped_ = true;
  if (deadline_alarm_) gazelle::Alarms::cancel(deadline_alarm_);
  if (lease_alarm_) gazelle::Alarms::cancel(lease_alarm_);
}

void EndpointEvents::watch(std::atomic<std::int64_t>& last, std::int64_t period_ns,
                           std::uint64_t& alarm, std::function<void()> missed) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (stopped_) return;
  std::weak_ptr<EndpointEvents> weak = weak_from_this();
  const std::int64_t due = last.load() + period_ns;
  alarm = gazelle::Alarms::at(gazelle::Alarms::Base::kSteady, due,
                              [weak, &last, period_ns, &alarm, missed](gazelle::clock::Wake how) {
                                const auto self = weak.lock();
                                if (!self || how == gazelle::clock::Wake::kStopped) return;
                                const std::int64_t now = gazelle::clock::steady_ns();
                                if (last.load() + period_ns <= now) {
                                  last.store(now);
                                  self->work_->push(missed);
                                }
                                self->watch(last, period_ns, alarm, missed);
                              });
}

void EndpointEvents::on_matched(std::size_t count) {
  if (!any_) return;
  const bool wants_clashes = is_publisher_
                                 ? static_cast<bool>(publisher_.incompatible_qos_callback)
                                 : static_cast<bool>(subscription_.incompatible_qos_callback);
  MatchedInfo info{};
  QOSLivelinessChangedInfo alive{};
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_ || count == matched_) return;
    const auto change = static_cast<std::int32_t>(count) - static_cast<std::int32_t>(matched_);
    info.total_count_change = change > 0 ? static_cast<std::size_t>(change) : 0;
    matched_total_ += info.total_count_change;
    info.total_count = matched_total_;
    info.current_count = count;
    info.current_count_change = change;
    matched_ = count;
    alive.alive_count = static_cast<std::int32_t>(count);
    alive.alive_count_change = change;
  }
  const auto& told = is_publisher_ ? publisher_.matched_callback : subscription_.matched_callback;
  if (told) {
    work_->push([told, info]() {
      MatchedInfo copy = info;
      told(copy);
    });
  }
  if (!is_publisher_ && subscription_.liveliness_callback) {
    auto callback = subscription_.liveliness_callback;
    work_->push([callback, alive]() {
      QOSLivelinessChangedInfo copy = alive;
      callback(copy);
    });
  }
  if (wants_clashes) {
    std::weak_ptr<EndpointEvents> weak = weak_from_this();
    work_->push([weak]() {
      if (const auto self = weak.lock()) self->look_for_clashes();
    });
  }
}

void EndpointEvents::look_for_clashes() {
  const auto ends = gazelle::call(
      "graph/ends", gazelle::Json::object({{"kind", is_publisher_ ? "subscription" : "publisher"},
                                           {"name", topic ? topic() : std::string()},
                                           {"known", true}}));
  std::map<std::string, bool> found;
  for (const auto& end : ends.items()) {
    const QoS other = qos_of_end(end["qos"]);
    const auto policy = is_publisher_ ? clashing_policy(qos_, other) : clashing_policy(other, qos_);
    if (policy == RMW_QOS_POLICY_INVALID) continue;
    const std::string gid = end["gid"].as_string();
    found[gid] = true;
    if (clashing_.count(gid)) continue;
    rmw_qos_incompatible_event_status_t info{++clashes_, 1, policy};
    if (is_publisher_) {
      publisher_.incompatible_qos_callback(info);
    } else {
      subscription_.incompatible_qos_callback(info);
    }
  }
  clashing_ = std::move(found);
}

void EndpointEvents::on_sequence(const gazelle::MessageInfo& info) {
  if (!info.sequence) return;
  std::lock_guard<std::mutex> lock(mutex_);
  std::uint64_t& last = sequences_[info.gid];
  const std::uint64_t missed = last && info.sequence > last + 1 ? info.sequence - last - 1 : 0;
  last = info.sequence;
  if (!missed) return;
  lost_total_ += missed;
  const QOSMessageLostInfo lost{lost_total_, missed};
  auto callback = subscription_.message_lost_callback;
  work_->push([callback, lost]() {
    QOSMessageLostInfo copy = lost;
    callback(copy);
  });
}

rmw_qos_policy_kind_t clashing_policy(const QoS& offered, const QoS& wanted) {
  const auto a = offered.to_graph();
  const auto b = wanted.to_graph();
  if (!a.transient_local && b.transient_local) return RMW_QOS_POLICY_DURABILITY;
  if (b.deadline_ns && (!a.deadline_ns || a.deadline_ns > b.deadline_ns)) {
    return RMW_QOS_POLICY_DEADLINE;
  }
  if (!a.manual_liveliness && b.manual_liveliness) return RMW_QOS_POLICY_LIVELINESS;
  if (b.lease_ns && (!a.lease_ns || a.lease_ns > b.lease_ns)) return RMW_QOS_POLICY_LIVELINESS;
  if (!a.reliable && b.reliable) return RMW_QOS_POLICY_RELIABILITY;
  return RMW_QOS_POLICY_INVALID;
}

QoS qos_of_end(const gazelle::Json& json) {
  QoS qos(KeepLast(static_cast<std::size_t>(json["depth"].as_int(10))));
  if (json["depth"].as_int(10) <= 0) qos.keep_all();
  if (!json["reliable"].as_bool(true)) qos.best_effort();
  if (json["latched"].as_bool()) qos.transient_local();
  const auto limit = [](const gazelle::Json& ns) {
    return ns.as_int() > 0 ? rmw_time_from_nsec(ns.as_int()) : rmw_time_t RMW_DURATION_INFINITE;
  };
  qos.deadline(limit(json["deadline_ns"]));
  qos.lifespan(limit(json["lifespan_ns"]));
  qos.liveliness(json["manual"].as_bool() ? LivelinessPolicy::ManualByTopic
                                          : LivelinessPolicy::Automatic);
  qos.liveliness_lease_duration(limit(json["lease_ns"]));
  return qos;
}

}  // namespace detail
}  // namespace rclcpp
