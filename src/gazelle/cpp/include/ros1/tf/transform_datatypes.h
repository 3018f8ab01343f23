// tf's types, with the time and the frame that they belong to, and their messages.
#pragma once

#include <cmath>
#include <string>

#include "geometry_msgs/PointStamped.h"
#include "geometry_msgs/PoseStamped.h"
#include "geometry_msgs/QuaternionStamped.h"
#include "geometry_msgs/TransformStamped.h"
#include "geometry_msgs/Vector3Stamped.h"
#include "ros/console.h"
#include "ros/time.h"
#include "tf/LinearMath/Transform.h"

namespace tf {

typedef tf::Vector3 Point;
typedef tf::Transform Pose;

static const double QUATERNION_TOLERANCE = 0.1f;

template <typename T>
class Stamped : public T {
 public:
  ros::Time stamp_;
  std::string frame_id_ = "NO_ID_STAMPED_DEFAULT_CONSTRUCTION";

  Stamped() {}
  Stamped(const T& input, const ros::Time& timestamp, const std::string& frame_id)
      : T(input), stamp_(timestamp), frame_id_(frame_id) {}
  void setData(const T& input) { static_cast<T&>(*this) = input; }
};
template <typename T>
bool operator==(const Stamped<T>& a, const Stamped<T>& b) {
  return a.frame_id_ == b.frame_id_ && a.stamp_ == b.stamp_ &&
         static_cast<const T&>(a) == static_cast<const T&>(b);
}

class StampedTransform : public tf::Transform {
 public:
  ros::Time stamp_;
  std::string frame_id_;
  std::string child_frame_id_;

  StampedTransform() {}
  StampedTransform(const tf::Transform& input, const ros::Time& timestamp,
                   const std::string& frame_id, const std::string& child_frame_id)
      : tf::Transform(input),
        stamp_(timestamp),
        frame_id_(frame_id),
        child_frame_id_(child_frame_id) {}
  void setData(const tf::Transform& input) { static_cast<tf::Transform&>(*this) = input; }
};
inline bool operator==(const StampedTransform& a, const StampedTransform& b) {
  return a.frame_id_ == b.frame_id_ && a.child_frame_id_ == b.child_frame_id_ &&
         a.stamp_ == b.stamp_ &&
         static_cast<const tf::Transform&>(a) == static_cast<const tf::Transform&>(b);
}

// ---- Rotations ------------------------------------------------------------------------------

inline void quaternionMsgToTF(const geometry_msgs::Quaternion& msg, Quaternion& bt) {
  bt = Quaternion(msg.x, msg.y, msg.z, msg.w);
  if (std::fabs(bt.length2() - 1.0) <= QUATERNION_TOLERANCE) return;
  ROS_WARN("MSG to TF: Quaternion Not Properly Normalized");
  bt.normalize();
}
inline void quaternionTFToMsg(const Quaternion& bt, geometry_msgs::Quaternion& msg) {
  Quaternion unit = bt;
  if (std::fabs(bt.length2() - 1.0) > QUATERNION_TOLERANCE) {
    ROS_WARN("TF to MSG: Quaternion Not Properly Normalized");
    unit.normalize();
  }
  msg.x = unit.x();
  msg.y = unit.y();
  msg.z = unit.z();
  msg.w = unit.w();
}
inline double getYaw(const Quaternion& bt_q) {
  double yaw = 0.0, pitch = 0.0, roll = 0.0;
  Matrix3x3(bt_q).getRPY(roll, pitch, yaw);
  return yaw;
}
inline double getYaw(const geometry_msgs::Quaternion& msg_q) {
  Quaternion q;
  quaternionMsgToTF(msg_q, q);
  return getYaw(q);
}
inline Quaternion createQuaternionFromRPY(double roll, double pitch, double yaw) {
  Quaternion q;
  q.setRPY(roll, pitch, yaw);
  return q;
}
inline Quaternion createQuaternionFromYaw(double yaw) {
  return createQuaternionFromRPY(0.0, 0.0, yaw);
}
inline geometry_msgs::Quaternion createQuaternionMsgFromRollPitchYaw(double roll, double pitch,
                                                                     double yaw) {
  geometry_msgs::Quaternion msg;
  quaternionTFToMsg(createQuaternionFromRPY(roll, pitch, yaw), msg);
  return msg;
}
inline geometry_msgs::Quaternion createQuaternionMsgFromYaw(double yaw) {
  return createQuaternionMsgFromRollPitchYaw(0.0, 0.0, yaw);
}
inline Quaternion createIdentityQuaternion() { return Quaternion(0.0, 0.0, 0.0, 1.0); }

// ---- Vectors, poses, transforms -------------------------------------------------------------

inline void vector3MsgToTF(const geometry_msgs::Vector3& msg_v, Vector3& bt_v) {
  bt_v = Vector3(msg_v.x, msg_v.y, msg_v.z);
}
inline void vector3TFToMsg(const Vector3& bt_v, geometry_msgs::Vector3& msg_v) {
  msg_v.x = bt_v.x();
  msg_v.y = bt_v.y();
  msg_v.z = bt_v.z();
}
inline void pointMsgToTF(const geometry_msgs::Point& msg_v, Point& bt_v) {
  bt_v = Vector3(msg_v.x, msg_v.y, msg_v.z);
}
inline void pointTFToMsg(const Point& bt_v, geometry_msgs::Point& msg_v) {
  msg_v.x = bt_v.x();
  msg_v.y = bt_v.y();
  msg_v.z = bt_v.z();
}
inline void transformMsgToTF(const geometry_msgs::Transform& msg, Transform& bt) {
  const auto& q = msg.rotation;
  const auto& t = msg.translation;
  bt = Transform(Quaternion(q.x, q.y, q.z, q.w), Vector3(t.x, t.y, t.z));
}
inline void transformTFToMsg(const Transform& bt, geometry_msgs::Transform& msg) {
  vector3TFToMsg(bt.getOrigin(), msg.translation);
  quaternionTFToMsg(bt.getRotation(), msg.rotation);
}
inline void poseMsgToTF(const geometry_msgs::Pose& msg, Pose& bt) {
  const auto& q = msg.orientation;
  const auto& p = msg.position;
  bt = Transform(Quaternion(q.x, q.y, q.z, q.w), Vector3(p.x, p.y, p.z));
}
inline void poseTFToMsg(const Pose& bt, geometry_msgs::Pose& msg) {
  pointTFToMsg(bt.getOrigin(), msg.position);
  quaternionTFToMsg(bt.getRotation(), msg.orientation);
}

// ---- The same with a header -----------------------------------------------------------------

#define GAZELLE_TF_STAMPED(function, Message, Type, part)                                      \
  inline void function##StampedMsgToTF(const geometry_msgs::Message& msg, Stamped<Type>& bt) { \
    function##MsgToTF(msg.part, bt);                                                           \
    bt.stamp_ = msg.header.stamp;                                                              \
    bt.frame_id_ = msg.header.frame_id;                                                        \
  }                                                                                            \
  inline void function##StampedTFToMsg(const Stamped<Type>& bt, geometry_msgs::Message& msg) { \
    function##TFToMsg(bt, msg.part);                                                           \
    msg.header.stamp = bt.stamp_;                                                              \
    msg.header.frame_id = bt.frame_id_;                                                        \
  }

GAZELLE_TF_STAMPED(quaternion, QuaternionStamped, Quaternion, quaternion)
GAZELLE_TF_STAMPED(vector3, Vector3Stamped, Vector3, vector)
GAZELLE_TF_STAMPED(point, PointStamped, Point, point)
GAZELLE_TF_STAMPED(pose, PoseStamped, Pose, pose)

#undef GAZELLE_TF_STAMPED

inline void transformStampedMsgToTF(const geometry_msgs::TransformStamped& msg,
                                    StampedTransform& bt) {
  transformMsgToTF(msg.transform, bt);
  bt.stamp_ = msg.header.stamp;
  bt.frame_id_ = msg.header.frame_id;
  bt.child_frame_id_ = msg.child_frame_id;
}
inline void transformStampedTFToMsg(const StampedTransform& bt,
                                    geometry_msgs::TransformStamped& msg) {
  transformTFToMsg(bt, msg.transform);
  msg.header.stamp = bt.stamp_;
  msg.header.frame_id = bt.frame_id_;
  msg.child_frame_id = bt.child_frame_id_;
}

}  // namespace tf
