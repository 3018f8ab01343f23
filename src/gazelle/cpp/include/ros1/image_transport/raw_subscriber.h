#pragma once

#include <image_transport/simple_subscriber_plugin.h>

namespace image_transport {

/// The image itself, on the base topic.
class RawSubscriber : public SimpleSubscriberPlugin<sensor_msgs::Image> {
 public:
  virtual ~RawSubscriber() {}
  virtual std::string getTransportName() const { return "raw"; }

 protected:
  virtual void internalCallback(const sensor_msgs::ImageConstPtr& message,
                                const Callback& user_cb) {
    user_cb(message);
  }
  virtual std::string getTopicToSubscribe(const std::string& base_topic) const {
    return base_topic;
  }
};

}  // namespace image_transport
