#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <message_filters/connection.h>
#include <message_filters/simple_filter.h>

#include <mutex>

namespace message_filters {

/// What can be subscribed and unsubscribed, whatever its type.
class SubscriberBase {
 public:
  virtual ~SubscriberBase() {}
  virtual void subscribe(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size,
                         const ros::TransportHints& transport_hints = ros::TransportHints(),
                         ros::CallbackQueueInterface* callback_queue = 0) = 0;
  virtual void subscribe() = 0;
  virtual void unsubscribe() = 0;
};
typedef boost::shared_ptr<SubscriberBase> SubscriberBasePtr;

/// A subscription as a filter.
template <class M>
class Subscriber : public SubscriberBase, public SimpleFilter<M> {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  typedef ros::MessageEvent<M const> EventType;

  Subscriber() {}
  Subscriber(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size,
             const ros::TransportHints& transport_hints = ros::TransportHints(),
             ros::CallbackQueueInterface* callback_queue = 0) {
    subscribe(nh, topic, queue_size, transport_hints, callback_queue);
  }
  ~Subscriber() { unsubscribe(); }

  void subscribe(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size,
                 const ros::TransportHints& transport_hints = ros::TransportHints(),
                 ros::CallbackQueueInterface* callback_queue = 0) override {
    unsubscribe();
    if (topic.empty()) return;
    options_.template initByFullCallbackType<const EventType&>(
        topic, queue_size, boost::function<void(const EventType&)>([this](const EventType& event) {
          this->signalMessage(event);
        }));
    options_.callback_queue = callback_queue;
    options_.transport_hints = transport_hints;
    node_ = nh;
    subscriber_ = node_.subscribe(options_);
  }
  void subscribe() override {
    unsubscribe();
    if (!options_.topic.empty()) subscriber_ = node_.subscribe(options_);
  }
  void unsubscribe() override { subscriber_.shutdown(); }

  std::string getTopic() const { return options_.topic; }
  const ros::Subscriber& getSubscriber() const { return subscriber_; }

  /// At the front of a chain it takes nothing.
  template <typename F>
  void connectInput(F&) {}
  void add(const EventType&) {}

 private:
  ros::Subscriber subscriber_;
  ros::SubscribeOptions options_;
  ros::NodeHandle node_;
};

}  // namespace message_filters
