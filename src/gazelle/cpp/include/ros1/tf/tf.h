// The transformer: a buffer of tf2 with tf's functions.
#pragma once

#include <boost/function.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "geometry_msgs/TwistStamped.h"
#include "tf/exceptions.h"
#include "tf/transform_datatypes.h"
#include "tf2_ros/buffer.h"

namespace tf {

// A frame's name with the prefix of its robot; one with a slash in front has it already.
__attribute__((visibility("default"))) std::string resolve(const std::string& prefix,
                                                           const std::string& frame_name);
__attribute__((visibility("default"))) std::string strip_leading_slash(
    const std::string& frame_name);
inline std::string remap(const std::string& prefix, const std::string& frame_name) {
  return tf::resolve(prefix, frame_name);
}

enum ErrorValues { NO_ERROR = 0, LOOKUP_ERROR, CONNECTIVITY_ERROR, EXTRAPOLATION_ERROR };

class __attribute__((visibility("default"))) Transformer {
 public:
  static const unsigned int MAX_GRAPH_DEPTH = 100UL;
  static constexpr double DEFAULT_CACHE_TIME = 10.0;  // seconds
  static const int64_t DEFAULT_MAX_EXTRAPOLATION_DISTANCE = 0;

  explicit Transformer(bool interpolating = true,
                       ros::Duration cache_time = ros::Duration(DEFAULT_CACHE_TIME));
  virtual ~Transformer();

  void clear();
  bool setTransform(const StampedTransform& transform,
                    const std::string& authority = "default_authority");

  void lookupTransform(const std::string& target_frame, const std::string& source_frame,
                       const ros::Time& time, StampedTransform& transform) const;
  void lookupTransform(const std::string& target_frame, const ros::Time& target_time,
                       const std::string& source_frame, const ros::Time& source_time,
                       const std::string& fixed_frame, StampedTransform& transform) const;

  // The velocity of the tracking frame seen from the observation frame, averaged over an interval
  // about the time, at a point and along the axes of the reference frame.
  void lookupTwist(const std::string& tracking_frame, const std::string& observation_frame,
                   const std::string& reference_frame, const tf::Point& reference_point,
                   const std::string& reference_point_frame, const ros::Time& time,
                   const ros::Duration& averaging_interval, geometry_msgs::Twist& twist) const;
  void lookupTwist(const std::string& tracking_frame, const std::string& observation_frame,
                   const ros::Time& time, const ros::Duration& averaging_interval,
                   geometry_msgs::Twist& twist) const;

  bool waitForTransform(const std::string& target_frame, const std::string& source_frame,
                        const ros::Time& time, const ros::Duration& timeout,
                        const ros::Duration& polling_sleep_duration = ros::Duration(0.01),
                        std::string* error_msg = nullptr) const;
  bool waitForTransform(const std::string& target_frame, const ros::Time& target_time,
                        const std::string& source_frame, const ros::Time& source_time,
                        const std::string& fixed_frame, const ros::Duration& timeout,
                        const ros::Duration& polling_sleep_duration = ros::Duration(0.01),
                        std::string* error_msg = nullptr) const;
  bool canTransform(const std::string& target_frame, const std::string& source_frame,
                    const ros::Time& time, std::string* error_msg = nullptr) const;
  bool canTransform(const std::string& target_frame, const ros::Time& target_time,
                    const std::string& source_frame, const ros::Time& source_time,
                    const std::string& fixed_frame, std::string* error_msg = nullptr) const;
  int getLatestCommonTime(const std::string& source_frame, const std::string& target_frame,
                          ros::Time& time, std::string* error_string) const;

  void transformQuaternion(const std::string& target_frame, const Stamped<Quaternion>& stamped_in,
                           Stamped<Quaternion>& stamped_out) const;
  void transformVector(const std::string& target_frame, const Stamped<Vector3>& stamped_in,
                       Stamped<Vector3>& stamped_out) const;
  void transformPoint(const std::string& target_frame, const Stamped<Point>& stamped_in,
                      Stamped<Point>& stamped_out) const;
  void transformPose(const std::string& target_frame, const Stamped<Pose>& stamped_in,
                     Stamped<Pose>& stamped_out) const;
  void transformQuaternion(const std::string& target_frame, const ros::Time& target_time,
                           const Stamped<Quaternion>& stamped_in, const std::string& fixed_frame,
                           Stamped<Quaternion>& stamped_out) const;
  void transformVector(const std::string& target_frame, const ros::Time& target_time,
                       const Stamped<Vector3>& stamped_in, const std::string& fixed_frame,
                       Stamped<Vector3>& stamped_out) const;
  void transformPoint(const std::string& target_frame, const ros::Time& target_time,
                      const Stamped<Point>& stamped_in, const std::string& fixed_frame,
                      Stamped<Point>& stamped_out) const;
  void transformPose(const std::string& target_frame, const ros::Time& target_time,
                     const Stamped<Pose>& stamped_in, const std::string& fixed_frame,
                     Stamped<Pose>& stamped_out) const;

  void chainAsVector(const std::string& target_frame, ros::Time target_time,
                     const std::string& source_frame, ros::Time source_time,
                     const std::string& fixed_frame, std::vector<std::string>& output) const;
  std::string allFramesAsString() const;
  std::string allFramesAsDot(double current_time = 0) const;
  void getFrameStrings(std::vector<std::string>& ids) const;
  bool getParent(const std::string& frame_id, ros::Time time, std::string& parent) const;
  bool frameExists(const std::string& frame_id_str) const;
  // Kept for old programs: nothing is extrapolated.
  void setExtrapolationLimit(const ros::Duration& distance);
  ros::Duration getCacheLength() { return tf2_buffer_ptr_->getCacheLength(); }

  tf2::ChangeConnection addTransformsChangedListener(boost::function<void(void)> callback) {
    return tf2_buffer_ptr_->_addTransformsChangedListener(callback);
  }
  void removeTransformsChangedListener(tf2::ChangeConnection c) {
    tf2_buffer_ptr_->_removeTransformsChangedListener(c);
  }

  std::string getTFPrefix() const { return tf_prefix_; }
  void setUsingDedicatedThread(bool value) { tf2_buffer_ptr_->setUsingDedicatedThread(value); }
  bool isUsingDedicatedThread() { return tf2_buffer_ptr_->isUsingDedicatedThread(); }
  std::shared_ptr<tf2_ros::Buffer> getTF2BufferPtr() { return tf2_buffer_ptr_; }

  bool fall_back_to_wall_time_ = false;

 protected:
  ros::Time now() const {
    if (!fall_back_to_wall_time_) return ros::Time::now();
    const ros::WallTime wall = ros::WallTime::now();
    return ros::Time(wall.sec, wall.nsec);
  }
  virtual bool ok() const;

  std::string tf_prefix_;
  std::shared_ptr<tf2_ros::Buffer> tf2_buffer_ptr_;
};

// Throw InvalidArgument for what is no rotation.
inline void assertQuaternionValid(const tf::Quaternion& q) {
  const double size = q.length2();
  if (std::isnan(size)) throw tf::InvalidArgument("Quaternion contains a NaN\n");
  if (std::fabs(size - 1.0) <= 0.01) return;
  std::ostringstream text;
  text << "Quaternion malformed, magnitude: " << size << " should be 1.0\n";
  throw tf::InvalidArgument(text.str());
}
inline void assertQuaternionValid(const geometry_msgs::Quaternion& q) {
  assertQuaternionValid(tf::Quaternion(q.x, q.y, q.z, q.w));
}

}  // namespace tf
