#include "topic_statistics.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include "gazelle/message.hpp"
#include "rclcpp/create_publisher.hpp"
#include "rclcpp/create_timer.hpp"
#include "statistics_msgs/msg/metrics_message.hpp"

namespace rclcpp {
namespace detail {
namespace {

using statistics_msgs::msg::MetricsMessage;

/// Mean, least, greatest and deviation of numbers as they come (Welford).
struct Numbers {
  double mean = 0.0, squares = 0.0;
  double least = std::numeric_limits<double>::max();
  double greatest = std::numeric_limits<double>::lowest();
  std::uint64_t count = 0;

  void add(double value) {
    ++count;
    const double before = value - mean;
    mean += before / static_cast<double>(count);
    squares += before * (value - mean);
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
};

/// Nanoseconds of `header.stamp` of a message, or -1 where it has none.
std::int64_t stamp_of(const void* message, const gazelle::Layout& layout) {
  for (std::uint32_t i = 0; i < layout.count; ++i) {
    const auto& member = layout.members[i];
    if (std::strcmp(member.name, "header") != 0 || member.kind != gazelle::Kind::message ||
        member.repeat != gazelle::Repeat::one) {
      continue;
    }
    const gazelle::Layout& header = member.child();
    for (std::uint32_t k = 0; k < header.count; ++k) {
      const auto& inner = header.members[k];
      if (std::strcmp(inner.name, "stamp") != 0) continue;
      const char* at = static_cast<const char*>(message) + member.offset + inner.offset;
      std::int32_t sec;
      std::uint32_t nanosec;
      std::memcpy(&sec, at, sizeof(sec));
      std::memcpy(&nanosec, at + sizeof(sec), sizeof(nanosec));
      return static_cast<std::int64_t>(sec) * 1000000000LL + nanosec;
    }
  }
  return -1;
}

class Measured : public TopicStatistics {
 public:
  Measured(node_interfaces::NodeTopicsInterface* topics, const SubscriptionOptionsBase& options)
      : node_name_(topics->get_node_base_interface()->get_name()),
        window_start_ns_(gazelle::clock::wall_ns()) {
    const auto& wanted = options.topic_stats_options;
    if (wanted.publish_period <= std::chrono::milliseconds(0)) {
      throw std::invalid_argument("topic_stats_options.publish_period must be greater than 0");
    }
    auto* base = topics->get_node_base_interface();
    publisher_ = std::make_shared<Publisher<MetricsMessage>>(base, wanted.publish_topic, wanted.qos,
                                                             PublisherOptions());
    topics->add_publisher(publisher_, options.callback_group);
    period_ = wanted.publish_period;
    group_ = options.callback_group;
    topics_ = topics;
  }

  void start(const std::shared_ptr<Measured>& self) {
    std::weak_ptr<Measured> weak = self;
    timer_ = create_wall_timer(
        period_,
        [weak]() {
          if (const auto strong = weak.lock()) strong->publish();
        },
        group_, topics_->get_node_base_interface(), topics_->get_node_timers_interface());
  }

  void take(const gazelle::Delivered& delivered, const gazelle::MessageType* type) override {
    const std::int64_t now = gazelle::clock::wall_ns();
    std::lock_guard<std::mutex> lock(mutex_);
    if (last_ns_) period_numbers_.add(static_cast<double>(now - last_ns_) / 1e6);
    last_ns_ = now;
    if (!type || !type->layout) return;
    const auto object = delivered.object(*type);
    const std::int64_t stamp = stamp_of(object.get(), *type->layout);
    if (stamp > 0) age_numbers_.add(static_cast<double>(now - stamp) / 1e6);
  }

 private:
  void publish() {
    const std::int64_t now = gazelle::clock::wall_ns();
    std::lock_guard<std::mutex> lock(mutex_);
    publish_one("message_age", age_numbers_, now);
    publish_one("message_period", period_numbers_, now);
    age_numbers_ = Numbers();
    period_numbers_ = Numbers();
    window_start_ns_ = now;
  }

  void publish_one(const char* what, const Numbers& numbers, std::int64_t now) {
    auto message = std::make_unique<MetricsMessage>();
    message->measurement_source_name = node_name_;
    message->metrics_source = what;
    message->unit = "ms";
    message->window_start = Time(window_start_ns_);
    message->window_stop = Time(now);
    const double none = std::nan("");
    const auto count = static_cast<double>(numbers.count);
    const bool any = numbers.count > 0;
    const double rows[] = {any ? numbers.mean : none, any ? numbers.greatest : none,
                           any ? numbers.least : none, count,
                           any ? std::sqrt(numbers.squares / count) : none};
    const std::uint8_t kinds[] = {1, 3, 2, 5, 4};  // average, maximum, minimum, count, deviation
    for (int i = 0; i < 5; ++i) {
      statistics_msgs::msg::StatisticDataPoint point;
      point.data_type = kinds[i];
      point.data = rows[i];
      message->statistics.push_back(point);
    }
    publisher_->publish(std::move(message));
  }

  std::string node_name_;
  std::shared_ptr<Publisher<MetricsMessage>> publisher_;
  std::chrono::milliseconds period_;
  CallbackGroup::SharedPtr group_;
  node_interfaces::NodeTopicsInterface* topics_;
  TimerBase::SharedPtr timer_;
  std::mutex mutex_;
  Numbers age_numbers_, period_numbers_;
  std::int64_t last_ns_ = 0;
  std::int64_t window_start_ns_;
};

}  // namespace

std::shared_ptr<TopicStatistics> TopicStatistics::create(
    node_interfaces::NodeTopicsInterface* topics, const SubscriptionOptionsBase& options) {
  auto made = std::make_shared<Measured>(topics, options);
  made->start(made);
  return made;
}

}  // namespace detail
}  // namespace rclcpp
