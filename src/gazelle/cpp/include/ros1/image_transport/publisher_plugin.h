#pragma once

#include <image_transport/single_subscriber_publisher.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <boost/noncopyable.hpp>
#include <string>
#include <vector>

namespace image_transport {

/// A transport's side that publishes.
class PublisherPlugin : boost::noncopyable {
 public:
  virtual ~PublisherPlugin() {}
  virtual std::string getTransportName() const = 0;

  void advertise(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                 bool latch = true) {
    advertiseImpl(nh, base_topic, queue_size, SubscriberStatusCallback(),
                  SubscriberStatusCallback(), ros::VoidPtr(), latch);
  }
  void advertise(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                 const SubscriberStatusCallback& connect_cb,
                 const SubscriberStatusCallback& disconnect_cb = SubscriberStatusCallback(),
                 const ros::VoidPtr& tracked_object = ros::VoidPtr(), bool latch = true) {
    advertiseImpl(nh, base_topic, queue_size, connect_cb, disconnect_cb, tracked_object, latch);
  }
  virtual uint32_t getNumSubscribers() const = 0;
  virtual std::string getTopic() const = 0;
  virtual void publish(const sensor_msgs::Image& message) const = 0;
  virtual void publish(const sensor_msgs::ImageConstPtr& message) const { publish(*message); }
  virtual void publish(const sensor_msgs::Image& message, const uint8_t* data) const {
    sensor_msgs::Image copy;
    copy.header = message.header;
    copy.height = message.height;
    copy.width = message.width;
    copy.encoding = message.encoding;
    copy.is_bigendian = message.is_bigendian;
    copy.step = message.step;
    copy.data.assign(data, data + static_cast<std::size_t>(message.step) * message.height);
    publish(copy);
  }
  virtual void shutdown() = 0;
  static std::string getLookupName(const std::string& transport_name) {
    return "image_transport/" + transport_name + "_pub";
  }

 protected:
  virtual void advertiseImpl(ros::NodeHandle& nh, const std::string& base_topic,
                             uint32_t queue_size, const SubscriberStatusCallback& connect_cb,
                             const SubscriberStatusCallback& disconnect_cb,
                             const ros::VoidPtr& tracked_object, bool latch) = 0;
};

}  // namespace image_transport
