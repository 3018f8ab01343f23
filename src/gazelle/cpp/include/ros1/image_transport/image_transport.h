#pragma once

#include <image_transport/camera_common.h>
#include <image_transport/camera_publisher.h>
#include <image_transport/camera_subscriber.h>
#include <image_transport/exception.h>
#include <image_transport/exports.h>
#include <image_transport/publisher.h>
#include <image_transport/subscriber.h>
#include <image_transport/transport_hints.h>
#include <ros/ros.h>

#include <boost/bind/bind.hpp>
#include <vector>

namespace image_transport {

/// Advertises and subscribes images as NodeHandle does messages.
class IMAGE_TRANSPORT_DECL ImageTransport {
 public:
  typedef boost::function<void(const sensor_msgs::ImageConstPtr&)> ImageCallback;

  explicit ImageTransport(const ros::NodeHandle& nh) : nh_(nh) {}

  Publisher advertise(const std::string& base_topic, uint32_t queue_size, bool latch = false) {
    return advertise(base_topic, queue_size, SubscriberStatusCallback(), SubscriberStatusCallback(),
                     ros::VoidPtr(), latch);
  }
  Publisher advertise(const std::string& base_topic, uint32_t queue_size,
                      const SubscriberStatusCallback& connect_cb,
                      const SubscriberStatusCallback& disconnect_cb = SubscriberStatusCallback(),
                      const ros::VoidPtr& tracked_object = ros::VoidPtr(), bool latch = false);

  Subscriber subscribe(const std::string& base_topic, uint32_t queue_size,
                       const ImageCallback& callback,
                       const ros::VoidPtr& tracked_object = ros::VoidPtr(),
                       const TransportHints& transport_hints = TransportHints());
  Subscriber subscribe(const std::string& base_topic, uint32_t queue_size,
                       void (*fp)(const sensor_msgs::ImageConstPtr&),
                       const TransportHints& transport_hints = TransportHints()) {
    return subscribe(base_topic, queue_size, ImageCallback(fp), ros::VoidPtr(), transport_hints);
  }
  template <class T>
  Subscriber subscribe(const std::string& base_topic, uint32_t queue_size,
                       void (T::*fp)(const sensor_msgs::ImageConstPtr&), T* obj,
                       const TransportHints& transport_hints = TransportHints()) {
    return subscribe(base_topic, queue_size, boost::bind(fp, obj, boost::placeholders::_1),
                     ros::VoidPtr(), transport_hints);
  }
  template <class T>
  Subscriber subscribe(const std::string& base_topic, uint32_t queue_size,
                       void (T::*fp)(const sensor_msgs::ImageConstPtr&),
                       const boost::shared_ptr<T>& obj,
                       const TransportHints& transport_hints = TransportHints()) {
    return subscribe(base_topic, queue_size, boost::bind(fp, obj.get(), boost::placeholders::_1),
                     obj, transport_hints);
  }

  CameraPublisher advertiseCamera(const std::string& base_topic, uint32_t queue_size,
                                  bool latch = false) {
    return advertiseCamera(base_topic, queue_size, SubscriberStatusCallback(),
                           SubscriberStatusCallback(), ros::SubscriberStatusCallback(),
                           ros::SubscriberStatusCallback(), ros::VoidPtr(), latch);
  }
  CameraPublisher advertiseCamera(
      const std::string& base_topic, uint32_t queue_size,
      const SubscriberStatusCallback& image_connect_cb,
      const SubscriberStatusCallback& image_disconnect_cb = SubscriberStatusCallback(),
      const ros::SubscriberStatusCallback& info_connect_cb = ros::SubscriberStatusCallback(),
      const ros::SubscriberStatusCallback& info_disconnect_cb = ros::SubscriberStatusCallback(),
      const ros::VoidPtr& tracked_object = ros::VoidPtr(), bool latch = false);

  CameraSubscriber subscribeCamera(const std::string& base_topic, uint32_t queue_size,
                                   const CameraSubscriber::Callback& callback,
                                   const ros::VoidPtr& tracked_object = ros::VoidPtr(),
                                   const TransportHints& transport_hints = TransportHints());
  CameraSubscriber subscribeCamera(const std::string& base_topic, uint32_t queue_size,
                                   void (*fp)(const sensor_msgs::ImageConstPtr&,
                                              const sensor_msgs::CameraInfoConstPtr&),
                                   const TransportHints& transport_hints = TransportHints()) {
    return subscribeCamera(base_topic, queue_size, CameraSubscriber::Callback(fp), ros::VoidPtr(),
                           transport_hints);
  }
  template <class T>
  CameraSubscriber subscribeCamera(const std::string& base_topic, uint32_t queue_size,
                                   void (T::*fp)(const sensor_msgs::ImageConstPtr&,
                                                 const sensor_msgs::CameraInfoConstPtr&),
                                   T* obj,
                                   const TransportHints& transport_hints = TransportHints()) {
    return subscribeCamera(base_topic, queue_size,
                           boost::bind(fp, obj, boost::placeholders::_1, boost::placeholders::_2),
                           ros::VoidPtr(), transport_hints);
  }
  template <class T>
  CameraSubscriber subscribeCamera(const std::string& base_topic, uint32_t queue_size,
                                   void (T::*fp)(const sensor_msgs::ImageConstPtr&,
                                                 const sensor_msgs::CameraInfoConstPtr&),
                                   const boost::shared_ptr<T>& obj,
                                   const TransportHints& transport_hints = TransportHints()) {
    return subscribeCamera(
        base_topic, queue_size,
        boost::bind(fp, obj.get(), boost::placeholders::_1, boost::placeholders::_2), obj,
        transport_hints);
  }

  /// "image_transport/raw" and those of plugins.
  std::vector<std::string> getDeclaredTransports() const;
  std::vector<std::string> getLoadableTransports() const;

 private:
  ros::NodeHandle nh_;
};

}  // namespace image_transport
