// A buffer of transforms that can be waited for.
#pragma once

#include <string>

#include "ros/ros.h"
#include "tf2/buffer_core.h"
#include "tf2_ros/buffer_interface.h"

namespace tf2_ros {

class __attribute__((visibility("default"))) Buffer : public BufferInterface,
                                                      public tf2::BufferCore {
 public:
  using tf2::BufferCore::canTransform;
  using tf2::BufferCore::lookupTransform;

  // With `debug`, the service ~tf2_frames tells all frames.
  explicit Buffer(ros::Duration cache_time = ros::Duration(BufferCore::DEFAULT_CACHE_TIME),
                  bool debug = false);

  geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame,
                                                  const std::string& source_frame,
                                                  const ros::Time& time,
                                                  const ros::Duration timeout) const override;
  geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame,
                                                  const ros::Time& target_time,
                                                  const std::string& source_frame,
                                                  const ros::Time& source_time,
                                                  const std::string& fixed_frame,
                                                  const ros::Duration timeout) const override;
  bool canTransform(const std::string& target_frame, const std::string& source_frame,
                    const ros::Time& target_time, const ros::Duration timeout,
                    std::string* errstr = nullptr) const override;
  bool canTransform(const std::string& target_frame, const ros::Time& target_time,
                    const std::string& source_frame, const ros::Time& source_time,
                    const std::string& fixed_frame, const ros::Duration timeout,
                    std::string* errstr = nullptr) const override;

 private:
  ros::ServiceServer frames_server_;
};

static const std::string threading_error =
    "Do not call canTransform or lookupTransform with a timeout unless you are using another "
    "thread for populating data. Without a dedicated thread it will always timeout.  If you have "
    "a separate thread servicing tf messages, call setUsingDedicatedThread(true) on your Buffer "
    "instance.";

}  // namespace tf2_ros
