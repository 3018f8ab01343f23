#include <algorithm>

#include "tf/tf.h"

namespace tf {

std::string strip_leading_slash(const std::string& frame_name) {
  return !frame_name.empty() && frame_name[0] == '/' ? frame_name.substr(1) : frame_name;
}

std::string resolve(const std::string& prefix, const std::string& frame_name) {
  if (!frame_name.empty() && frame_name[0] == '/') return strip_leading_slash(frame_name);
  if (prefix.empty()) return frame_name;
  return strip_leading_slash(prefix) + "/" + frame_name;
}

Transformer::Transformer(bool, ros::Duration cache_time)
    : tf2_buffer_ptr_(std::make_shared<tf2_ros::Buffer>(cache_time)) {
  if (!ros::isInitialized()) return;
  ros::NodeHandle own("~");
  std::string parameter;
  if (own.searchParam("tf_prefix", parameter)) own.getParam(parameter, tf_prefix_);
}

Transformer::~Transformer() = default;

bool Transformer::ok() const { return true; }

void Transformer::clear() { tf2_buffer_ptr_->clear(); }

bool Transformer::setTransform(const StampedTransform& transform, const std::string& authority) {
  geometry_msgs::TransformStamped message;
  transformStampedTFToMsg(transform, message);
  return tf2_buffer_ptr_->setTransform(message, authority);
}

void Transformer::lookupTransform(const std::string& target_frame, const std::string& source_frame,
                                  const ros::Time& time, StampedTransform& transform) const {
  transformStampedMsgToTF(tf2_buffer_ptr_->lookupTransform(strip_leading_slash(target_frame),
                                                           strip_leading_slash(source_frame), time),
                          transform);
}

void Transformer::lookupTransform(const std::string& target_frame, const ros::Time& target_time,
                                  const std::string& source_frame, const ros::Time& source_time,
                                  const std::string& fixed_frame,
                                  StampedTransform& transform) const {
  transformStampedMsgToTF(
      tf2_buffer_ptr_->lookupTransform(strip_leading_slash(target_frame), target_time,
                                       strip_leading_slash(source_frame), source_time,
                                       strip_leading_slash(fixed_frame)),
      transform);
}

void Transformer::lookupTwist(const std::string& tracking_frame,
                              const std::string& observation_frame, const ros::Time& time,
                              const ros::Duration& averaging_interval,
                              geometry_msgs::Twist& twist) const {
  lookupTwist(tracking_frame, observation_frame, observation_frame, Point(0.0, 0.0, 0.0),
              tracking_frame, time, averaging_interval, twist);
}

void Transformer::lookupTwist(const std::string& tracking_frame,
                              const std::string& observation_frame,
                              const std::string& reference_frame, const Point& reference_point,
                              const std::string& reference_point_frame, const ros::Time& time,
                              const ros::Duration& averaging_interval,
                              geometry_msgs::Twist& twist) const {
  ros::Time latest;
  getLatestCommonTime(observation_frame, tracking_frame, latest, nullptr);
  const ros::Time target = time.isZero() ? latest : time;
  // About the time, but not beyond what is known, nor before time begins.
  const ros::Time last = std::min(target + averaging_interval * 0.5, latest);
  const ros::Time first =
      std::max(ros::Time(0.00001) + averaging_interval, last) - averaging_interval;
  const double length_s = (last - first).toSec();

  StampedTransform start, end, axes;
  lookupTransform(observation_frame, tracking_frame, first, start);
  lookupTransform(observation_frame, tracking_frame, last, end);
  Quaternion turned = end.getRotation() * start.getRotation().inverse();
  if (turned.w() < 0.0) turned = -turned;
  Vector3 angular = turned.getAxis() * (turned.getAngle() / length_s);
  Vector3 linear = (end.getOrigin() - start.getOrigin()) / length_s;

  lookupTransform(reference_frame, observation_frame, target, axes);
  angular = axes.getBasis() * angular;
  linear = axes.getBasis() * linear;

  Stamped<Point> tracked(Point(0.0, 0.0, 0.0), target, tracking_frame);
  Stamped<Point> wanted(reference_point, target, reference_point_frame);
  transformPoint(reference_frame, tracked, tracked);
  transformPoint(reference_frame, wanted, wanted);
  linear += angular.cross(wanted - tracked);

  vector3TFToMsg(linear, twist.linear);
  vector3TFToMsg(angular, twist.angular);
}

bool Transformer::waitForTransform(const std::string& target_frame, const std::string& source_frame,
                                   const ros::Time& time, const ros::Duration& timeout,
                                   const ros::Duration&, std::string* error_msg) const {
  return tf2_buffer_ptr_->canTransform(strip_leading_slash(target_frame),
                                       strip_leading_slash(source_frame), time, timeout, error_msg);
}

bool Transformer::waitForTransform(const std::string& target_frame, const ros::Time& target_time,
                                   const std::string& source_frame, const ros::Time& source_time,
                                   const std::string& fixed_frame, const ros::Duration& timeout,
                                   const ros::Duration&, std::string* error_msg) const {
  return tf2_buffer_ptr_->canTransform(strip_leading_slash(target_frame), target_time,
                                       strip_leading_slash(source_frame), source_time,
                                       strip_leading_slash(fixed_frame), timeout, error_msg);
}

bool Transformer::canTransform(const std::string& target_frame, const std::string& source_frame,
                               const ros::Time& time, std::string* error_msg) const {
  return tf2_buffer_ptr_->canTransform(strip_leading_slash(target_frame),
                                       strip_leading_slash(source_frame), time, error_msg);
}

bool Transformer::canTransform(const std::string& target_frame, const ros::Time& target_time,
                               const std::string& source_frame, const ros::Time& source_time,
                               const std::string& fixed_frame, std::string* error_msg) const {
  return tf2_buffer_ptr_->canTransform(strip_leading_slash(target_frame), target_time,
                                       strip_leading_slash(source_frame), source_time,
                                       strip_leading_slash(fixed_frame), error_msg);
}

int Transformer::getLatestCommonTime(const std::string& source_frame,
                                     const std::string& target_frame, ros::Time& time,
                                     std::string* error_string) const {
  const tf2::CompactFrameID target =
      tf2_buffer_ptr_->_lookupFrameNumber(strip_leading_slash(target_frame));
  const tf2::CompactFrameID source =
      tf2_buffer_ptr_->_lookupFrameNumber(strip_leading_slash(source_frame));
  return tf2_buffer_ptr_->_getLatestCommonTime(source, target, time, error_string);
}

void Transformer::chainAsVector(const std::string& target_frame, ros::Time target_time,
                                const std::string& source_frame, ros::Time source_time,
                                const std::string& fixed_frame,
                                std::vector<std::string>& output) const {
  tf2_buffer_ptr_->_chainAsVector(target_frame, target_time, source_frame, source_time, fixed_frame,
                                  output);
}

std::string Transformer::allFramesAsString() const { return tf2_buffer_ptr_->allFramesAsString(); }

std::string Transformer::allFramesAsDot(double current_time) const {
  return tf2_buffer_ptr_->_allFramesAsDot(current_time);
}

void Transformer::getFrameStrings(std::vector<std::string>& ids) const {
  tf2_buffer_ptr_->_getFrameStrings(ids);
}

bool Transformer::getParent(const std::string& frame_id, ros::Time time,
                            std::string& parent) const {
  return tf2_buffer_ptr_->_getParent(strip_leading_slash(frame_id), time, parent);
}

bool Transformer::frameExists(const std::string& frame_id_str) const {
  return tf2_buffer_ptr_->_frameExists(strip_leading_slash(frame_id_str));
}

void Transformer::setExtrapolationLimit(const ros::Duration&) {
  ROS_WARN("Transformer::setExtrapolationLimit is deprecated and does not do anything");
}

namespace {

template <class T>
void stamp(const StampedTransform& transform, const std::string& frame, Stamped<T>& out) {
  out.stamp_ = transform.stamp_;
  out.frame_id_ = frame;
}

}  // namespace

void Transformer::transformQuaternion(const std::string& target_frame,
                                      const Stamped<Quaternion>& stamped_in,
                                      Stamped<Quaternion>& stamped_out) const {
  assertQuaternionValid(stamped_in);
  StampedTransform transform;
  lookupTransform(target_frame, stamped_in.frame_id_, stamped_in.stamp_, transform);
  stamped_out.setData(transform * static_cast<const Quaternion&>(stamped_in));
  stamp(transform, target_frame, stamped_out);
}

void Transformer::transformVector(const std::string& target_frame,
                                  const Stamped<Vector3>& stamped_in,
                                  Stamped<Vector3>& stamped_out) const {
  StampedTransform transform;
  lookupTransform(target_frame, stamped_in.frame_id_, stamped_in.stamp_, transform);
  // A direction: it turns, but does not move.
  stamped_out.setData(transform.getBasis() * static_cast<const Vector3&>(stamped_in));
  stamp(transform, target_frame, stamped_out);
}

void Transformer::transformPoint(const std::string& target_frame, const Stamped<Point>& stamped_in,
                                 Stamped<Point>& stamped_out) const {
  StampedTransform transform;
  lookupTransform(target_frame, stamped_in.frame_id_, stamped_in.stamp_, transform);
  stamped_out.setData(transform * static_cast<const Point&>(stamped_in));
  stamp(transform, target_frame, stamped_out);
}

void Transformer::transformPose(const std::string& target_frame, const Stamped<Pose>& stamped_in,
                                Stamped<Pose>& stamped_out) const {
  StampedTransform transform;
  lookupTransform(target_frame, stamped_in.frame_id_, stamped_in.stamp_, transform);
  stamped_out.setData(transform * static_cast<const Pose&>(stamped_in));
  stamp(transform, target_frame, stamped_out);
}

void Transformer::transformQuaternion(const std::string& target_frame, const ros::Time& target_time,
                                      const Stamped<Quaternion>& stamped_in,
                                      const std::string& fixed_frame,
                                      Stamped<Quaternion>& stamped_out) const {
  assertQuaternionValid(stamped_in);
  StampedTransform transform;
  lookupTransform(target_frame, target_time, stamped_in.frame_id_, stamped_in.stamp_, fixed_frame,
                  transform);
  stamped_out.setData(transform * static_cast<const Quaternion&>(stamped_in));
  stamp(transform, target_frame, stamped_out);
}

void Transformer::transformVector(const std::string& target_frame, const ros::Time& target_time,
                                  const Stamped<Vector3>& stamped_in,
                                  const std::string& fixed_frame,
                                  Stamped<Vector3>& stamped_out) const {
  StampedTransform transform;
  lookupTransform(target_frame, target_time, stamped_in.frame_id_, stamped_in.stamp_, fixed_frame,
                  transform);
  stamped_out.setData(transform.getBasis() * static_cast<const Vector3&>(stamped_in));
  stamp(transform, target_frame, stamped_out);
}

void Transformer::transformPoint(const std::string& target_frame, const ros::Time& target_time,
                                 const Stamped<Point>& stamped_in, const std::string& fixed_frame,
                                 Stamped<Point>& stamped_out) const {
  StampedTransform transform;
  lookupTransform(target_frame, target_time, stamped_in.frame_id_, stamped_in.stamp_, fixed_frame,
                  transform);
  stamped_out.setData(transform * static_cast<const Point&>(stamped_in));
  stamp(transform, target_frame, stamped_out);
}

void Transformer::transformPose(const std::string& target_frame, const ros::Time& target_time,
                                const Stamped<Pose>& stamped_in, const std::string& fixed_frame,
                                Stamped<Pose>& stamped_out) const {
  StampedTransform transform;
  lookupTransform(target_frame, target_time, stamped_in.frame_id_, stamped_in.stamp_, fixed_frame,
                  transform);
  stamped_out.setData(transform * static_cast<const Pose&>(stamped_in));
  stamp(transform, target_frame, stamped_out);
}

}  // namespace tf
