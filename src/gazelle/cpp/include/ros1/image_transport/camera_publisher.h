#pragma once

#include <image_transport/exports.h>
#include <image_transport/single_subscriber_publisher.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <boost/shared_ptr.hpp>
#include <string>

namespace image_transport {

class ImageTransport;

/// Publishes images with what their camera is.
class IMAGE_TRANSPORT_DECL CameraPublisher {
 public:
  CameraPublisher() {}

  uint32_t getNumSubscribers() const;
  std::string getTopic() const;
  std::string getInfoTopic() const;
  void publish(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& info) const;
  void publish(const sensor_msgs::ImageConstPtr& image,
               const sensor_msgs::CameraInfoConstPtr& info) const;
  /// With a stamp for both.
  void publish(sensor_msgs::Image& image, sensor_msgs::CameraInfo& info, ros::Time stamp) const;
  void shutdown();

  operator void*() const { return isValid() ? reinterpret_cast<void*>(1) : 0; }
  bool operator<(const CameraPublisher& other) const { return impl_ < other.impl_; }
  bool operator!=(const CameraPublisher& other) const { return impl_ != other.impl_; }
  bool operator==(const CameraPublisher& other) const { return impl_ == other.impl_; }

 private:
  friend class ImageTransport;
  bool isValid() const;

  struct Impl;
  boost::shared_ptr<Impl> impl_;
};

}  // namespace image_transport
