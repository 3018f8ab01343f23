// Between KDL and tf.
#pragma once

#include "geometry_msgs/Pose.h"
#include "geometry_msgs/Twist.h"
#include "kdl/frames.hpp"
#include "kdl_conversions/kdl_msg.h"
#include "tf/transform_datatypes.h"

namespace tf {

inline void vectorTFToKDL(const tf::Vector3& t, KDL::Vector& k) {
  k = KDL::Vector(t[0], t[1], t[2]);
}
inline void vectorKDLToTF(const KDL::Vector& k, tf::Vector3& t) {
  t = tf::Vector3(k[0], k[1], k[2]);
}
inline void quaternionTFToKDL(const tf::Quaternion& t, KDL::Rotation& k) {
  k = KDL::Rotation::Quaternion(t[0], t[1], t[2], t[3]);
}
inline void quaternionKDLToTF(const KDL::Rotation& k, tf::Quaternion& t) {
  double x, y, z, w;
  k.GetQuaternion(x, y, z, w);
  t = tf::Quaternion(x, y, z, w);
}
inline void poseTFToKDL(const tf::Pose& t, KDL::Frame& k) {
  vectorTFToKDL(t.getOrigin(), k.p);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) k.M(row, column) = t.getBasis()[row][column];
}
inline void poseKDLToTF(const KDL::Frame& k, tf::Pose& t) {
  t.setOrigin(tf::Vector3(k.p[0], k.p[1], k.p[2]));
  t.setBasis(tf::Matrix3x3(k.M(0, 0), k.M(0, 1), k.M(0, 2), k.M(1, 0), k.M(1, 1), k.M(1, 2),
                           k.M(2, 0), k.M(2, 1), k.M(2, 2)));
}
inline void transformTFToKDL(const tf::Transform& t, KDL::Frame& k) { poseTFToKDL(t, k); }
inline void transformKDLToTF(const KDL::Frame& k, tf::Transform& t) { poseKDLToTF(k, t); }
inline void VectorTFToKDL(const tf::Vector3& t, KDL::Vector& k) { vectorTFToKDL(t, k); }
inline void RotationTFToKDL(const tf::Quaternion& t, KDL::Rotation& k) { quaternionTFToKDL(t, k); }
inline void PoseTFToKDL(const tf::Pose& t, KDL::Frame& k) { poseTFToKDL(t, k); }
inline void TransformTFToKDL(const tf::Transform& t, KDL::Frame& k) { poseTFToKDL(t, k); }
inline void TransformKDLToTF(const KDL::Frame& k, tf::Transform& t) { poseKDLToTF(k, t); }

// The pose after moving with a twist for a time.
inline geometry_msgs::Pose addDelta(const geometry_msgs::Pose& pose,
                                    const geometry_msgs::Twist& twist, const double& t) {
  KDL::Frame frame;
  KDL::Twist moved;
  poseMsgToKDL(pose, frame);
  twistMsgToKDL(twist, moved);
  geometry_msgs::Pose out;
  poseKDLToMsg(KDL::addDelta(frame, moved, t), out);
  return out;
}

}  // namespace tf
