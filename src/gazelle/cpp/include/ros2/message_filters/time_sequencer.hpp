// Messages in the order of their stamps, each when it is old enough.
#pragma once

#include <message_filters/connection.hpp>
#include <message_filters/simple_filter.hpp>
#include <rclcpp/rclcpp.hpp>

#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace message_filters {

template <class M>
class TimeSequencer : public SimpleFilter<M> {
 public:
  using MConstPtr = std::shared_ptr<M const>;
  using EventType = MessageEvent<M const>;

  template <class F>
  TimeSequencer(F& filter, rclcpp::Duration delay, rclcpp::Duration update_rate,
                std::uint32_t queue_size, std::shared_ptr<rclcpp::Node> node)
      : TimeSequencer(delay, update_rate, queue_size, node) {
    connectInput(filter);
  }
  TimeSequencer(rclcpp::Duration delay, rclcpp::Duration update_rate, std::uint32_t queue_size,
                std::shared_ptr<rclcpp::Node> node)
      : delay_ns_(delay.nanoseconds()), queue_size_(queue_size), node_(node) {
    timer_ = node->create_wall_timer(std::chrono::nanoseconds(update_rate.nanoseconds()),
                                     [this] { dispatch(); });
  }
  ~TimeSequencer() {
    timer_->cancel();
    incoming_.disconnect();
  }

  template <class F>
  void connectInput(F& filter) {
    incoming_.disconnect();
    incoming_ = connect_events<M>(filter, [this](const EventType& event) { add(event); });
  }
  void add(const EventType& event) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::int64_t stamp_ns = platform::ns_of(platform::stamp(*event.getConstMessage()));
    if (stamp_ns < last_ns_) return;  // its turn is over
    waiting_.emplace(stamp_ns, event);
    if (queue_size_ != 0 && waiting_.size() > queue_size_) waiting_.erase(waiting_.begin());
  }
  void add(const MConstPtr& message) { add(EventType(message)); }

 private:
  void dispatch() {
    std::vector<EventType> due;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const std::int64_t now_ns = node_->get_clock()->now().nanoseconds();
      while (!waiting_.empty() && waiting_.begin()->first + delay_ns_ <= now_ns) {
        last_ns_ = waiting_.begin()->first;
        due.push_back(waiting_.begin()->second);
        waiting_.erase(waiting_.begin());
      }
    }
    for (const EventType& event : due) this->signalMessage(event);
  }

  std::int64_t delay_ns_;
  std::uint32_t queue_size_;
  std::shared_ptr<rclcpp::Node> node_;
  rclcpp::TimerBase::SharedPtr timer_;
  std::mutex mutex_;
  std::multimap<std::int64_t, EventType> waiting_;
  std::int64_t last_ns_ = 0;
  Connection incoming_;
};

}  // namespace message_filters
