// Between Eigen and tf.
#pragma once

#include <Eigen/Geometry>

#include "tf/transform_datatypes.h"

namespace tf {

inline void matrixTFToEigen(const tf::Matrix3x3& t, Eigen::Matrix3d& e) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) e(i, j) = t[i][j];
}
inline void matrixEigenToTF(const Eigen::Matrix3d& e, tf::Matrix3x3& t) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t[i][j] = e(i, j);
}
inline void vectorTFToEigen(const tf::Vector3& t, Eigen::Vector3d& e) {
  e = Eigen::Vector3d(t[0], t[1], t[2]);
}
inline void vectorEigenToTF(const Eigen::Vector3d& e, tf::Vector3& t) {
  t = tf::Vector3(e[0], e[1], e[2]);
}
inline void quaternionTFToEigen(const tf::Quaternion& t, Eigen::Quaterniond& e) {
  e = Eigen::Quaterniond(t[3], t[0], t[1], t[2]);
}
inline void quaternionEigenToTF(const Eigen::Quaterniond& e, tf::Quaternion& t) {
  t = tf::Quaternion(e.x(), e.y(), e.z(), e.w());
}

namespace impl {

template <class EigenTransform>
void tf_to_eigen(const tf::Transform& t, EigenTransform& e) {
  e = EigenTransform::Identity();
  for (int i = 0; i < 3; ++i) {
    e.matrix()(i, 3) = t.getOrigin()[i];
    for (int j = 0; j < 3; ++j) e.matrix()(i, j) = t.getBasis()[i][j];
  }
}
template <class EigenTransform>
void eigen_to_tf(const EigenTransform& e, tf::Transform& t) {
  for (int i = 0; i < 3; ++i) {
    t.getOrigin()[i] = e.matrix()(i, 3);
    for (int j = 0; j < 3; ++j) t.getBasis()[i][j] = e.matrix()(i, j);
  }
  t.getOrigin()[3] = 0.0;
}

}  // namespace impl

inline void poseTFToEigen(const tf::Pose& t, Eigen::Affine3d& e) { impl::tf_to_eigen(t, e); }
inline void poseTFToEigen(const tf::Pose& t, Eigen::Isometry3d& e) { impl::tf_to_eigen(t, e); }
inline void poseEigenToTF(const Eigen::Affine3d& e, tf::Pose& t) { impl::eigen_to_tf(e, t); }
inline void poseEigenToTF(const Eigen::Isometry3d& e, tf::Pose& t) { impl::eigen_to_tf(e, t); }
inline void transformTFToEigen(const tf::Transform& t, Eigen::Affine3d& e) {
  impl::tf_to_eigen(t, e);
}
inline void transformTFToEigen(const tf::Transform& t, Eigen::Isometry3d& e) {
  impl::tf_to_eigen(t, e);
}
inline void transformEigenToTF(const Eigen::Affine3d& e, tf::Transform& t) {
  impl::eigen_to_tf(e, t);
}
inline void transformEigenToTF(const Eigen::Isometry3d& e, tf::Transform& t) {
  impl::eigen_to_tf(e, t);
}

}  // namespace tf
