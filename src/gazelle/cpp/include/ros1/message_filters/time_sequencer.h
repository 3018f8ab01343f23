#pragma once

#include <ros/node_handle.h>

#include <message_filters/connection.h>
#include <message_filters/simple_filter.h>

#include <map>
#include <mutex>
#include <vector>

namespace message_filters {

/// Tells messages in the order of their stamps, each when it is `delay` old.
template <class M>
class TimeSequencer : public SimpleFilter<M> {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  typedef ros::MessageEvent<M const> EventType;

  template <class F>
  TimeSequencer(F& filter, ros::Duration delay, ros::Duration update_rate, uint32_t queue_size,
                ros::NodeHandle nh = ros::NodeHandle())
      : TimeSequencer(delay, update_rate, queue_size, nh) {
    connectInput(filter);
  }
  TimeSequencer(ros::Duration delay, ros::Duration update_rate, uint32_t queue_size,
                ros::NodeHandle nh = ros::NodeHandle())
      : delay_(delay), queue_size_(queue_size), node_(nh) {
    timer_ = node_.createTimer(update_rate,
                               ros::TimerCallback([this](const ros::TimerEvent&) { dispatch(); }));
  }
  ~TimeSequencer() {
    timer_.stop();
    incoming_.disconnect();
  }

  template <class F>
  void connectInput(F& filter) {
    incoming_.disconnect();
    incoming_ = connect_events<M>(filter, [this](const EventType& event) { add(event); });
  }
  void add(const EventType& event) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ros::Time stamp = platform::stamp(*event.getConstMessage());
    if (stamp < last_) return;  // its turn is over
    waiting_.emplace(stamp, event);
    if (queue_size_ != 0 && waiting_.size() > queue_size_) waiting_.erase(waiting_.begin());
  }
  void add(const MConstPtr& message) { add(EventType(message)); }

 private:
  void dispatch() {
    std::vector<EventType> due;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const ros::Time now = ros::Time::now();
      while (!waiting_.empty() && waiting_.begin()->first + delay_ <= now) {
        last_ = waiting_.begin()->first;
        due.push_back(waiting_.begin()->second);
        waiting_.erase(waiting_.begin());
      }
    }
    for (const EventType& event : due) this->signalMessage(event);
  }

  ros::Duration delay_;
  uint32_t queue_size_;
  ros::NodeHandle node_;
  ros::Timer timer_;
  std::mutex mutex_;
  std::multimap<ros::Time, EventType> waiting_;
  ros::Time last_;
  Connection incoming_;
};

}  // namespace message_filters
