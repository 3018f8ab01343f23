#pragma once

#include <image_transport/exports.h>
#include <image_transport/transport_hints.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>
#include <string>

namespace image_transport {

class ImageTransport;

/// Images with what their camera is, of equal stamps.
class IMAGE_TRANSPORT_DECL CameraSubscriber {
 public:
  typedef boost::function<void(const sensor_msgs::ImageConstPtr&,
                               const sensor_msgs::CameraInfoConstPtr&)>
      Callback;
  CameraSubscriber() {}

  std::string getTopic() const;
  std::string getInfoTopic() const;
  uint32_t getNumPublishers() const;
  std::string getTransport() const;
  void shutdown();

  operator void*() const { return isValid() ? reinterpret_cast<void*>(1) : 0; }
  bool operator<(const CameraSubscriber& other) const { return impl_ < other.impl_; }
  bool operator!=(const CameraSubscriber& other) const { return impl_ != other.impl_; }
  bool operator==(const CameraSubscriber& other) const { return impl_ == other.impl_; }

 private:
  friend class ImageTransport;
  bool isValid() const;

  struct Impl;
  boost::shared_ptr<Impl> impl_;
};

}  // namespace image_transport
