#pragma once

#include <image_transport/transport_hints.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <boost/function.hpp>
#include <boost/noncopyable.hpp>
#include <string>

namespace image_transport {

/// A transport's side that subscribes.
class SubscriberPlugin : boost::noncopyable {
 public:
  typedef boost::function<void(const sensor_msgs::ImageConstPtr&)> Callback;

  virtual ~SubscriberPlugin() {}
  virtual std::string getTransportName() const = 0;
  void subscribe(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                 const Callback& callback, const ros::VoidPtr& tracked_object = ros::VoidPtr(),
                 const TransportHints& transport_hints = TransportHints()) {
    subscribeImpl(nh, base_topic, queue_size, callback, tracked_object, transport_hints);
  }
  void subscribe(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                 void (*fp)(const sensor_msgs::ImageConstPtr&),
                 const TransportHints& transport_hints = TransportHints()) {
    subscribe(nh, base_topic, queue_size, Callback(fp), ros::VoidPtr(), transport_hints);
  }
  template <class T>
  void subscribe(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                 void (T::*fp)(const sensor_msgs::ImageConstPtr&), T* obj,
                 const TransportHints& transport_hints = TransportHints()) {
    subscribe(nh, base_topic, queue_size, boost::bind(fp, obj, boost::placeholders::_1),
              ros::VoidPtr(), transport_hints);
  }
  template <class T>
  void subscribe(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                 void (T::*fp)(const sensor_msgs::ImageConstPtr&), const boost::shared_ptr<T>& obj,
                 const TransportHints& transport_hints = TransportHints()) {
    subscribe(nh, base_topic, queue_size, boost::bind(fp, obj.get(), boost::placeholders::_1), obj,
              transport_hints);
  }
  virtual std::string getTopic() const = 0;
  virtual uint32_t getNumPublishers() const = 0;
  virtual void shutdown() = 0;
  static std::string getLookupName(const std::string& transport_type) {
    return "image_transport/" + transport_type + "_sub";
  }

 protected:
  virtual void subscribeImpl(ros::NodeHandle& nh, const std::string& base_topic,
                             uint32_t queue_size, const Callback& callback,
                             const ros::VoidPtr& tracked_object,
                             const TransportHints& transport_hints) = 0;
};

}  // namespace image_transport
