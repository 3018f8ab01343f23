#pragma once

#include <image_transport/simple_publisher_plugin.h>

namespace image_transport {

/// The image itself, on the base topic.
class RawPublisher : public SimplePublisherPlugin<sensor_msgs::Image> {
 public:
  virtual ~RawPublisher() {}
  virtual std::string getTransportName() const { return "raw"; }
  using SimplePublisherPlugin<sensor_msgs::Image>::publish;
  /// Subscribers of this process get the very object.
  virtual void publish(const sensor_msgs::ImageConstPtr& message) const {
    getPublisher().publish(message);
  }

 protected:
  virtual void publish(const sensor_msgs::Image& message, const PublishFn& publish_fn) const {
    publish_fn(message);
  }
  virtual std::string getTopicToAdvertise(const std::string& base_topic) const {
    return base_topic;
  }
};

}  // namespace image_transport
