// Positions, velocities and efforts of joints, and Jacobians.
#pragma once

#include <Eigen/Core>
#include <ostream>

#include "kdl/frames.hpp"

namespace KDL {

class Jacobian {
 public:
  Eigen::Matrix<double, 6, Eigen::Dynamic> data;

  Jacobian() {}
  explicit Jacobian(unsigned int columns) : data(6, columns) { data.setZero(); }
  void resize(unsigned int columns) {
    data.conservativeResizeLike(Eigen::MatrixXd::Zero(6, columns));
  }
  double operator()(unsigned int i, unsigned int j) const { return data(i, j); }
  double& operator()(unsigned int i, unsigned int j) { return data(i, j); }
  unsigned int rows() const { return static_cast<unsigned int>(data.rows()); }
  unsigned int columns() const { return static_cast<unsigned int>(data.cols()); }
  bool operator==(const Jacobian& other) const;
  bool operator!=(const Jacobian& other) const { return !(*this == other); }
  Twist getColumn(unsigned int i) const {
    return Twist(Vector(data(0, i), data(1, i), data(2, i)),
                 Vector(data(3, i), data(4, i), data(5, i)));
  }
  void setColumn(unsigned int i, const Twist& t) {
    for (int row = 0; row < 6; ++row) data(row, i) = t(row);
  }
  void changeRefPoint(const Vector& base_AB) {
    for (unsigned int i = 0; i < columns(); ++i) setColumn(i, getColumn(i).RefPoint(base_AB));
  }
  void changeBase(const Rotation& rotation) {
    for (unsigned int i = 0; i < columns(); ++i) setColumn(i, rotation * getColumn(i));
  }
  void changeRefFrame(const Frame& frame) {
    for (unsigned int i = 0; i < columns(); ++i) setColumn(i, frame * getColumn(i));
  }
};
inline void SetToZero(Jacobian& jac) { jac.data.setZero(); }
inline bool Equal(const Jacobian& a, const Jacobian& b, double eps = epsilon) {
  return a.columns() == b.columns() &&
         (a.columns() == 0 || (a.data - b.data).cwiseAbs().maxCoeff() < eps);
}
inline bool Jacobian::operator==(const Jacobian& other) const { return Equal(*this, other); }
inline bool changeRefPoint(const Jacobian& in, const Vector& base_AB, Jacobian& out) {
  out = in;
  out.changeRefPoint(base_AB);
  return true;
}
inline bool changeBase(const Jacobian& in, const Rotation& rotation, Jacobian& out) {
  out = in;
  out.changeBase(rotation);
  return true;
}
inline bool changeRefFrame(const Jacobian& in, const Frame& frame, Jacobian& out) {
  out = in;
  out.changeRefFrame(frame);
  return true;
}

class JntArray {
 public:
  Eigen::VectorXd data;

  JntArray() {}
  explicit JntArray(unsigned int size) : data(Eigen::VectorXd::Zero(size)) {}
  void resize(unsigned int size) { data.conservativeResizeLike(Eigen::VectorXd::Zero(size)); }
  double operator()(unsigned int i, unsigned int = 0) const { return data(i); }
  double& operator()(unsigned int i, unsigned int = 0) { return data(i); }
  unsigned int rows() const { return static_cast<unsigned int>(data.rows()); }
  unsigned int columns() const { return 1; }
};
inline void Add(const JntArray& a, const JntArray& b, JntArray& out) { out.data = a.data + b.data; }
inline void Subtract(const JntArray& a, const JntArray& b, JntArray& out) {
  out.data = a.data - b.data;
}
inline void Multiply(const JntArray& a, double s, JntArray& out) { out.data = a.data * s; }
inline void Divide(const JntArray& a, double s, JntArray& out) { out.data = a.data / s; }
inline void MultiplyJacobian(const Jacobian& jac, const JntArray& rates, Twist& out) {
  const Eigen::Matrix<double, 6, 1> t = jac.data.lazyProduct(rates.data);
  for (int i = 0; i < 6; ++i) out(i) = t(i);
}
inline void SetToZero(JntArray& array) { array.data.setZero(); }
inline bool Equal(const JntArray& a, const JntArray& b, double eps = epsilon) {
  return a.rows() == b.rows() && (a.rows() == 0 || (a.data - b.data).cwiseAbs().maxCoeff() < eps);
}
inline bool operator==(const JntArray& a, const JntArray& b) { return Equal(a, b); }

class JntSpaceInertiaMatrix {
 public:
  Eigen::MatrixXd data;

  JntSpaceInertiaMatrix() {}
  explicit JntSpaceInertiaMatrix(int size) : data(Eigen::MatrixXd::Zero(size, size)) {}
  void resize(unsigned int size) { data.resize(size, size); }
  double operator()(unsigned int i, unsigned int j) const { return data(i, j); }
  double& operator()(unsigned int i, unsigned int j) { return data(i, j); }
  unsigned int rows() const { return static_cast<unsigned int>(data.rows()); }
  unsigned int columns() const { return static_cast<unsigned int>(data.cols()); }
};
inline void Multiply(const JntSpaceInertiaMatrix& a, const JntArray& v, JntArray& out) {
  out.data = a.data.lazyProduct(v.data);
}
inline void SetToZero(JntSpaceInertiaMatrix& matrix) { matrix.data.setZero(); }

inline std::ostream& operator<<(std::ostream& out, const JntArray& array) {
  out << "[";
  for (unsigned int i = 0; i < array.rows(); ++i) out << (i == 0 ? "" : " ") << array(i);
  return out << "]";
}
inline std::ostream& operator<<(std::ostream& out, const Jacobian& jac) { return out << jac.data; }

}  // namespace KDL
