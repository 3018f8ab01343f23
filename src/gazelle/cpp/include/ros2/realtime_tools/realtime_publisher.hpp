#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "rclcpp/publisher.hpp"

namespace realtime_tools {

// Publishes from a control loop. In ROS a thread of its own sends the message, as sending may take
// long; here it never waits for anybody, so the message goes out at once and in order.
template <class MessageT>
class RealtimePublisher {
 public:
  using PublisherType = rclcpp::Publisher<MessageT>;
  using PublisherSharedPtr = typename PublisherType::SharedPtr;
  using UniquePtr = std::unique_ptr<RealtimePublisher<MessageT>>;
  using SharedPtr = std::shared_ptr<RealtimePublisher<MessageT>>;
  using ConstSharedPtr = std::shared_ptr<const RealtimePublisher<MessageT>>;

  MessageT msg_;

  explicit RealtimePublisher(PublisherSharedPtr publisher) : publisher_(std::move(publisher)) {}
  RealtimePublisher(const RealtimePublisher&) = delete;
  RealtimePublisher& operator=(const RealtimePublisher&) = delete;

  void stop() {}

  void lock() { mutex_.lock(); }
  bool trylock() { return mutex_.try_lock(); }
  bool try_lock() { return trylock(); }
  void unlock() { mutex_.unlock(); }
  void unlockAndPublish() {
    publisher_->publish(msg_);
    mutex_.unlock();
  }

  // Later versions hand over the message; false while another thread is at it.
  bool can_publish() const {
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    return lock.owns_lock();
  }
  bool try_publish(const MessageT& message) {
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) publisher_->publish(message);
    return lock.owns_lock();
  }
  bool tryPublish(const MessageT& message) { return try_publish(message); }

 private:
  PublisherSharedPtr publisher_;
  mutable std::mutex mutex_;
};

template <class MessageT>
using RealtimePublisherSharedPtr = std::shared_ptr<RealtimePublisher<MessageT>>;

}  // namespace realtime_tools
