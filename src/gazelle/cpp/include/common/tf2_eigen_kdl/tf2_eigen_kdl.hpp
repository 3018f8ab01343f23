// Between Eigen and KDL.
#pragma once

#include "gazelle/eigen_kdl.hpp"

namespace tf2 {

inline void quaternionKDLToEigen(const KDL::Rotation& k, Eigen::Quaterniond& e) {
  gazelle::kdl_to_eigen(k, e);
}
inline void quaternionEigenToKDL(const Eigen::Quaterniond& e, KDL::Rotation& k) {
  gazelle::eigen_to_kdl(e, k);
}
inline void transformKDLToEigen(const KDL::Frame& k, Eigen::Affine3d& e) {
  gazelle::kdl_to_eigen(k, e);
}
inline void transformEigenToKDL(const Eigen::Affine3d& e, KDL::Frame& k) {
  gazelle::eigen_to_kdl(e, k);
}
inline void transformKDLToEigen(const KDL::Frame& k, Eigen::Isometry3d& e) {
  gazelle::kdl_to_eigen(k, e);
}
inline void transformEigenToKDL(const Eigen::Isometry3d& e, KDL::Frame& k) {
  gazelle::eigen_to_kdl(e, k);
}
inline void twistKDLToEigen(const KDL::Twist& k, Eigen::Matrix<double, 6, 1>& e) {
  gazelle::kdl_to_eigen(k, e);
}
inline void twistEigenToKDL(const Eigen::Matrix<double, 6, 1>& e, KDL::Twist& k) {
  gazelle::eigen_to_kdl(e, k);
}
inline void vectorKDLToEigen(const KDL::Vector& k, Eigen::Matrix<double, 3, 1>& e) {
  gazelle::kdl_to_eigen(k, e);
}
inline void vectorEigenToKDL(const Eigen::Matrix<double, 3, 1>& e, KDL::Vector& k) {
  gazelle::eigen_to_kdl(e, k);
}
inline void wrenchKDLToEigen(const KDL::Wrench& k, Eigen::Matrix<double, 6, 1>& e) {
  gazelle::kdl_to_eigen(k, e);
}
inline void wrenchEigenToKDL(const Eigen::Matrix<double, 6, 1>& e, KDL::Wrench& k) {
  gazelle::eigen_to_kdl(e, k);
}

}  // namespace tf2
