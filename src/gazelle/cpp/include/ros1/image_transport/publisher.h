#pragma once

#include <image_transport/exports.h>
#include <image_transport/single_subscriber_publisher.h>
#include <sensor_msgs/Image.h>

#include <boost/shared_ptr.hpp>
#include <string>

namespace image_transport {

class ImageTransport;

/// Publishes images by all transports that are there.
class IMAGE_TRANSPORT_DECL Publisher {
 public:
  Publisher() {}

  uint32_t getNumSubscribers() const;
  std::string getTopic() const;
  void publish(const sensor_msgs::Image& message) const;
  void publish(const sensor_msgs::ImageConstPtr& message) const;
  void shutdown();

  operator void*() const { return isValid() ? reinterpret_cast<void*>(1) : 0; }
  bool operator<(const Publisher& other) const { return impl_ < other.impl_; }
  bool operator!=(const Publisher& other) const { return impl_ != other.impl_; }
  bool operator==(const Publisher& other) const { return impl_ == other.impl_; }

 private:
  friend class ImageTransport;
  bool isValid() const;

  struct Impl;
  boost::shared_ptr<Impl> impl_;
};

}  // namespace image_transport
