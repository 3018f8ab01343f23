#pragma once

#include <ros/node_handle.h>

#include <boost/shared_ptr.hpp>
#include <mutex>
#include <string>

namespace realtime_tools {

// Publishes from a control loop. In ROS a thread of its own sends the message, as sending may take
// long; here it never waits for anybody, so the message goes out at once and in order.
template <class Msg>
class RealtimePublisher {
 public:
  Msg msg_;

  RealtimePublisher() = default;
  RealtimePublisher(const ros::NodeHandle& node, const std::string& topic, int queue_size,
                    bool latched = false) {
    init(node, topic, queue_size, latched);
  }
  RealtimePublisher(const RealtimePublisher&) = delete;
  RealtimePublisher& operator=(const RealtimePublisher&) = delete;

  void init(const ros::NodeHandle& node, const std::string& topic, int queue_size,
            bool latched = false) {
    node_ = node;
    publisher_ = node_.advertise<Msg>(topic, queue_size, latched);
  }
  void stop() {}

  void lock() { mutex_.lock(); }
  bool trylock() { return mutex_.try_lock(); }
  void unlock() { mutex_.unlock(); }
  void unlockAndPublish() {
    publisher_.publish(msg_);
    mutex_.unlock();
  }

 private:
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  std::mutex mutex_;
};

template <class Msg>
using RealtimePublisherSharedPtr = boost::shared_ptr<RealtimePublisher<Msg>>;

}  // namespace realtime_tools
