#include "tf/transform_broadcaster.h"
#include "tf/transform_listener.h"

namespace tf {

std::string remap(const std::string& frame_id) {
  ros::NodeHandle own("~");
  return tf::resolve(getPrefixParam(own), frame_id);
}

TransformListener::TransformListener(ros::Duration max_cache_time, bool spin_thread)
    : Transformer(true, max_cache_time), tf2_listener_(*tf2_buffer_ptr_, node_, spin_thread) {}

TransformListener::TransformListener(const ros::NodeHandle& nh, ros::Duration max_cache_time,
                                     bool spin_thread)
    : Transformer(true, max_cache_time),
      node_(nh),
      tf2_listener_(*tf2_buffer_ptr_, nh, spin_thread) {}

TransformListener::~TransformListener() = default;

bool TransformListener::ok() const { return ros::ok(); }

void TransformListener::transformQuaternion(const std::string& target_frame,
                                            const geometry_msgs::QuaternionStamped& stamped_in,
                                            geometry_msgs::QuaternionStamped& stamped_out) const {
  assertQuaternionValid(stamped_in.quaternion);
  Stamped<Quaternion> in, out;
  quaternionStampedMsgToTF(stamped_in, in);
  transformQuaternion(target_frame, in, out);
  quaternionStampedTFToMsg(out, stamped_out);
}

void TransformListener::transformVector(const std::string& target_frame,
                                        const geometry_msgs::Vector3Stamped& stamped_in,
                                        geometry_msgs::Vector3Stamped& stamped_out) const {
  Stamped<Vector3> in, out;
  vector3StampedMsgToTF(stamped_in, in);
  transformVector(target_frame, in, out);
  vector3StampedTFToMsg(out, stamped_out);
}

void TransformListener::transformPoint(const std::string& target_frame,
                                       const geometry_msgs::PointStamped& stamped_in,
                                       geometry_msgs::PointStamped& stamped_out) const {
  Stamped<Point> in, out;
  pointStampedMsgToTF(stamped_in, in);
  transformPoint(target_frame, in, out);
  pointStampedTFToMsg(out, stamped_out);
}

void TransformListener::transformPose(const std::string& target_frame,
                                      const geometry_msgs::PoseStamped& stamped_in,
                                      geometry_msgs::PoseStamped& stamped_out) const {
  assertQuaternionValid(stamped_in.pose.orientation);
  Stamped<Pose> in, out;
  poseStampedMsgToTF(stamped_in, in);
  transformPose(target_frame, in, out);
  poseStampedTFToMsg(out, stamped_out);
}

void TransformListener::transformQuaternion(const std::string& target_frame,
                                            const ros::Time& target_time,
                                            const geometry_msgs::QuaternionStamped& qin,
                                            const std::string& fixed_frame,
                                            geometry_msgs::QuaternionStamped& qout) const {
  assertQuaternionValid(qin.quaternion);
  Stamped<Quaternion> in, out;
  quaternionStampedMsgToTF(qin, in);
  transformQuaternion(target_frame, target_time, in, fixed_frame, out);
  quaternionStampedTFToMsg(out, qout);
}

void TransformListener::transformVector(const std::string& target_frame,
                                        const ros::Time& target_time,
                                        const geometry_msgs::Vector3Stamped& vin,
                                        const std::string& fixed_frame,
                                        geometry_msgs::Vector3Stamped& vout) const {
  Stamped<Vector3> in, out;
  vector3StampedMsgToTF(vin, in);
  transformVector(target_frame, target_time, in, fixed_frame, out);
  vector3StampedTFToMsg(out, vout);
}

void TransformListener::transformPoint(const std::string& target_frame,
                                       const ros::Time& target_time,
                                       const geometry_msgs::PointStamped& pin,
                                       const std::string& fixed_frame,
                                       geometry_msgs::PointStamped& pout) const {
  Stamped<Point> in, out;
  pointStampedMsgToTF(pin, in);
  transformPoint(target_frame, target_time, in, fixed_frame, out);
  pointStampedTFToMsg(out, pout);
}

void TransformListener::transformPose(const std::string& target_frame, const ros::Time& target_time,
                                      const geometry_msgs::PoseStamped& pin,
                                      const std::string& fixed_frame,
                                      geometry_msgs::PoseStamped& pout) const {
  assertQuaternionValid(pin.pose.orientation);
  Stamped<Pose> in, out;
  poseStampedMsgToTF(pin, in);
  transformPose(target_frame, target_time, in, fixed_frame, out);
  poseStampedTFToMsg(out, pout);
}

namespace {

void transform_points(const std::string& frame, const ros::Time& time, const Transform& transform,
                      const sensor_msgs::PointCloud& in, sensor_msgs::PointCloud& out) {
  if (&in != &out) out = in;
  out.header.stamp = time;
  out.header.frame_id = frame;
  for (geometry_msgs::Point32& point : out.points) {
    const Vector3 moved = transform * Vector3(point.x, point.y, point.z);
    point.x = static_cast<float>(moved.x());
    point.y = static_cast<float>(moved.y());
    point.z = static_cast<float>(moved.z());
  }
}

}  // namespace

void TransformListener::transformPointCloud(const std::string& target_frame,
                                            const sensor_msgs::PointCloud& pcin,
                                            sensor_msgs::PointCloud& pcout) const {
  StampedTransform transform;
  lookupTransform(target_frame, pcin.header.frame_id, pcin.header.stamp, transform);
  transform_points(target_frame, pcin.header.stamp, transform, pcin, pcout);
}

void TransformListener::transformPointCloud(const std::string& target_frame,
                                            const ros::Time& target_time,
                                            const sensor_msgs::PointCloud& pcin,
                                            const std::string& fixed_frame,
                                            sensor_msgs::PointCloud& pcout) const {
  StampedTransform transform;
  lookupTransform(target_frame, target_time, pcin.header.frame_id, pcin.header.stamp, fixed_frame,
                  transform);
  transform_points(target_frame, target_time, transform, pcin, pcout);
}

namespace {

// Frames of tf2 have no slash in front, those of tf may.
geometry_msgs::TransformStamped without_slashes(geometry_msgs::TransformStamped message) {
  message.header.frame_id = strip_leading_slash(message.header.frame_id);
  message.child_frame_id = strip_leading_slash(message.child_frame_id);
  return message;
}

}  // namespace

TransformBroadcaster::TransformBroadcaster() = default;

void TransformBroadcaster::sendTransform(const StampedTransform& transform) {
  sendTransform(std::vector<StampedTransform>{transform});
}

void TransformBroadcaster::sendTransform(const std::vector<StampedTransform>& transforms) {
  std::vector<geometry_msgs::TransformStamped> messages(transforms.size());
  for (std::size_t i = 0; i < transforms.size(); ++i)
    transformStampedTFToMsg(transforms[i], messages[i]);
  sendTransform(messages);
}

void TransformBroadcaster::sendTransform(const geometry_msgs::TransformStamped& transform) {
  sendTransform(std::vector<geometry_msgs::TransformStamped>{transform});
}

void TransformBroadcaster::sendTransform(
    const std::vector<geometry_msgs::TransformStamped>& transforms) {
  std::vector<geometry_msgs::TransformStamped> messages;
  messages.reserve(transforms.size());
  for (const geometry_msgs::TransformStamped& one : transforms)
    messages.push_back(without_slashes(one));
  tf2_broadcaster_.sendTransform(messages);
}

}  // namespace tf
