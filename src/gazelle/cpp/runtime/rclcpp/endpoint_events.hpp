// Events of publishers and subscriptions: partners that come and go, deadlines, lost messages.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "gazelle/core.hpp"
#include "rclcpp/detail/endpoint_options.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp {
namespace detail {

/// Calls that wait for the executor.
class EventWork : public Waitable {
 public:
  void push(std::function<void()> call);
  bool has_work() override;
  bool do_work() override;

 private:
  std::mutex mutex_;
  std::deque<std::function<void()>> calls_;
};

/// What happens to one end of a topic.
class EndpointEvents : public std::enable_shared_from_this<EndpointEvents> {
 public:
  EndpointEvents(const PublisherEventCallbacks& callbacks, const QoS& qos);
  EndpointEvents(const SubscriptionEventCallbacks& callbacks, const QoS& qos);
  ~EndpointEvents();

  /// Whether anybody wants to know anything.
  bool any() const { return any_; }
  void start();
  void stop();
  void on_matched(std::size_t count);
  /// A message was sent, or came.
  void on_activity() { last_activity_ns_.store(gazelle::clock::steady_ns()); }
  void on_alive() { last_alive_ns_.store(gazelle::clock::steady_ns()); }
  void on_sequence(const gazelle::MessageInfo& info);
  bool counts_lost() const { return static_cast<bool>(subscription_.message_lost_callback); }
  std::unordered_map<int, std::shared_ptr<Waitable>> handlers() const;

  std::function<std::string()> topic;  // its name, once it is known

 private:
  void watch(std::atomic<std::int64_t>& last, std::int64_t period_ns, std::uint64_t& alarm,
             std::function<void()> missed);
  void look_for_clashes();

  const bool is_publisher_;
  PublisherEventCallbacks publisher_;
  SubscriptionEventCallbacks subscription_;
  const QoS qos_;
  bool any_ = false;
  std::shared_ptr<EventWork> work_;
  std::mutex mutex_;
  std::size_t matched_ = 0;
  std::size_t matched_total_ = 0;
  std::size_t lost_total_ = 0;
  std::map<std::array<std::uint8_t, 16>, std::uint64_t> sequences_;
  std::map<std::string, bool> clashing_;
  std::int32_t clashes_ = 0;
  std::atomic<std::int64_t> last_activity_ns_{0};
  std::atomic<std::int64_t> last_alive_ns_{0};
  std::uint64_t deadline_alarm_ = 0;
  std::uint64_t lease_alarm_ = 0;
  std::int32_t deadline_misses_ = 0;
  std::int32_t lease_misses_ = 0;
  bool stopped_ = false;
};

/// The first policy in which a publisher offers less than a subscription wants, invalid for none.
rmw_qos_policy_kind_t clashing_policy(const QoS& offered, const QoS& wanted);

/// What the graph says of an end's quality of service.
QoS qos_of_end(const gazelle::Json& qos);

}  // namespace detail
}  // namespace rclcpp
