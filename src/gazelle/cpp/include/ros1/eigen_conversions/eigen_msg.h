// Between Eigen and messages.
#pragma once

#include <Eigen/Geometry>

#include "geometry_msgs/Point.h"
#include "geometry_msgs/Pose.h"
#include "geometry_msgs/Quaternion.h"
#include "geometry_msgs/Transform.h"
#include "geometry_msgs/Twist.h"
#include "geometry_msgs/Vector3.h"
#include "geometry_msgs/Wrench.h"
#include "std_msgs/Float64MultiArray.h"

namespace tf {

namespace impl {

template <class EigenTransform, class Vector, class Quaternion>
void to_eigen(const Vector& v, const Quaternion& q, EigenTransform& e) {
  e = EigenTransform(Eigen::Translation3d(v.x, v.y, v.z) * Eigen::Quaterniond(q.w, q.x, q.y, q.z));
}
template <class EigenTransform, class Vector, class Quaternion>
void from_eigen(const EigenTransform& e, Vector& v, Quaternion& q) {
  v.x = e.translation()[0];
  v.y = e.translation()[1];
  v.z = e.translation()[2];
  Eigen::Quaterniond rotation(e.linear());
  if (rotation.w() < 0) rotation.coeffs() *= -1.0;
  q.x = rotation.x();
  q.y = rotation.y();
  q.z = rotation.z();
  q.w = rotation.w();
}

}  // namespace impl

inline void pointMsgToEigen(const geometry_msgs::Point& m, Eigen::Vector3d& e) {
  e = Eigen::Vector3d(m.x, m.y, m.z);
}
inline void pointEigenToMsg(const Eigen::Vector3d& e, geometry_msgs::Point& m) {
  m.x = e.x();
  m.y = e.y();
  m.z = e.z();
}
inline void vectorMsgToEigen(const geometry_msgs::Vector3& m, Eigen::Vector3d& e) {
  e = Eigen::Vector3d(m.x, m.y, m.z);
}
inline void vectorEigenToMsg(const Eigen::Vector3d& e, geometry_msgs::Vector3& m) {
  m.x = e.x();
  m.y = e.y();
  m.z = e.z();
}
inline void quaternionMsgToEigen(const geometry_msgs::Quaternion& m, Eigen::Quaterniond& e) {
  e = Eigen::Quaterniond(m.w, m.x, m.y, m.z);
}
inline void quaternionEigenToMsg(const Eigen::Quaterniond& e, geometry_msgs::Quaternion& m) {
  m.x = e.x();
  m.y = e.y();
  m.z = e.z();
  m.w = e.w();
}
inline void poseMsgToEigen(const geometry_msgs::Pose& m, Eigen::Affine3d& e) {
  impl::to_eigen(m.position, m.orientation, e);
}
inline void poseMsgToEigen(const geometry_msgs::Pose& m, Eigen::Isometry3d& e) {
  impl::to_eigen(m.position, m.orientation, e);
}
inline void poseEigenToMsg(const Eigen::Affine3d& e, geometry_msgs::Pose& m) {
  impl::from_eigen(e, m.position, m.orientation);
}
inline void poseEigenToMsg(const Eigen::Isometry3d& e, geometry_msgs::Pose& m) {
  impl::from_eigen(e, m.position, m.orientation);
}
inline void transformMsgToEigen(const geometry_msgs::Transform& m, Eigen::Affine3d& e) {
  impl::to_eigen(m.translation, m.rotation, e);
}
inline void transformMsgToEigen(const geometry_msgs::Transform& m, Eigen::Isometry3d& e) {
  impl::to_eigen(m.translation, m.rotation, e);
}
inline void transformEigenToMsg(const Eigen::Affine3d& e, geometry_msgs::Transform& m) {
  impl::from_eigen(e, m.translation, m.rotation);
}
inline void transformEigenToMsg(const Eigen::Isometry3d& e, geometry_msgs::Transform& m) {
  impl::from_eigen(e, m.translation, m.rotation);
}
inline void twistMsgToEigen(const geometry_msgs::Twist& m, Eigen::Matrix<double, 6, 1>& e) {
  e << m.linear.x, m.linear.y, m.linear.z, m.angular.x, m.angular.y, m.angular.z;
}
inline void twistEigenToMsg(const Eigen::Matrix<double, 6, 1>& e, geometry_msgs::Twist& m) {
  vectorEigenToMsg(e.head<3>(), m.linear);
  vectorEigenToMsg(e.tail<3>(), m.angular);
}
inline void wrenchMsgToEigen(const geometry_msgs::Wrench& m, Eigen::Matrix<double, 6, 1>& e) {
  e << m.force.x, m.force.y, m.force.z, m.torque.x, m.torque.y, m.torque.z;
}
inline void wrenchEigenToMsg(const Eigen::Matrix<double, 6, 1>& e, geometry_msgs::Wrench& m) {
  vectorEigenToMsg(e.head<3>(), m.force);
  vectorEigenToMsg(e.tail<3>(), m.torque);
}
// Row by row.
template <class Derived>
void matrixEigenToMsg(const Eigen::MatrixBase<Derived>& e, std_msgs::Float64MultiArray& m) {
  if (m.layout.dim.size() != 2) m.layout.dim.resize(2);
  m.layout.dim[0].stride = e.rows() * e.cols();
  m.layout.dim[0].size = e.rows();
  m.layout.dim[1].stride = e.cols();
  m.layout.dim[1].size = e.cols();
  m.data.clear();
  for (int i = 0; i < e.rows(); ++i)
    for (int j = 0; j < e.cols(); ++j) m.data.push_back(e.coeff(i, j));
}

}  // namespace tf
