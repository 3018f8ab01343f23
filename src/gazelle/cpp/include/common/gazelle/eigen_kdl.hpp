// Between Eigen and KDL.
#pragma once

#include <Eigen/Geometry>

#include "kdl/frames.hpp"

namespace gazelle {

template <class EigenTransform>
void kdl_to_eigen(const KDL::Frame& k, EigenTransform& e) {
  e = EigenTransform::Identity();
  for (int row = 0; row < 3; ++row) {
    e.matrix()(row, 3) = k.p(row);
    for (int column = 0; column < 3; ++column) e.matrix()(row, column) = k.M(row, column);
  }
}
template <class EigenTransform>
void eigen_to_kdl(const EigenTransform& e, KDL::Frame& k) {
  for (int row = 0; row < 3; ++row) {
    k.p(row) = e.matrix()(row, 3);
    for (int column = 0; column < 3; ++column) k.M(row, column) = e.matrix()(row, column);
  }
}
inline void kdl_to_eigen(const KDL::Rotation& k, Eigen::Quaterniond& e) {
  k.GetQuaternion(e.x(), e.y(), e.z(), e.w());
}
inline void eigen_to_kdl(const Eigen::Quaterniond& e, KDL::Rotation& k) {
  k = KDL::Rotation::Quaternion(e.x(), e.y(), e.z(), e.w());
}
inline void kdl_to_eigen(const KDL::Vector& k, Eigen::Matrix<double, 3, 1>& e) {
  e = Eigen::Vector3d(k[0], k[1], k[2]);
}
inline void eigen_to_kdl(const Eigen::Matrix<double, 3, 1>& e, KDL::Vector& k) {
  k = KDL::Vector(e[0], e[1], e[2]);
}
inline void kdl_to_eigen(const KDL::Twist& k, Eigen::Matrix<double, 6, 1>& e) {
  for (int i = 0; i < 6; ++i) e[i] = k[i];
}
inline void eigen_to_kdl(const Eigen::Matrix<double, 6, 1>& e, KDL::Twist& k) {
  for (int i = 0; i < 6; ++i) k[i] = e[i];
}
inline void kdl_to_eigen(const KDL::Wrench& k, Eigen::Matrix<double, 6, 1>& e) {
  for (int i = 0; i < 6; ++i) e[i] = k[i];
}
inline void eigen_to_kdl(const Eigen::Matrix<double, 6, 1>& e, KDL::Wrench& k) {
  for (int i = 0; i < 6; ++i) k[i] = e[i];
}

}  // namespace gazelle
