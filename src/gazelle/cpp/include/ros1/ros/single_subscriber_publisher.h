#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/publisher.h>

namespace ros {

/// What a connect callback gets: who has come, and a way to publish. The graph has no way to one
/// subscriber alone, so what is published goes to all of the topic.
class ROSCPP_DECL SingleSubscriberPublisher {
 public:
  SingleSubscriberPublisher(const Publisher& publisher, const std::string& topic,
                            const std::string& subscriber)
      : publisher_(publisher), topic_(topic), subscriber_(subscriber) {}

  template <class M>
  void publish(const boost::shared_ptr<M const>& message) const {
    publisher_.publish(message);
  }
  template <class M>
  void publish(const boost::shared_ptr<M>& message) const {
    publisher_.publish(message);
  }
  template <class M>
  void publish(const M& message) const {
    publisher_.publish(message);
  }
  std::string getTopic() const { return topic_; }
  std::string getSubscriberName() const { return subscriber_; }

 private:
  Publisher publisher_;
  std::string topic_, subscriber_;
};

}  // namespace ros
