// KDL's geometry: vectors, rotations, frames, twists and wrenches.
#pragma once

#include <cmath>
#include <ostream>

namespace KDL {

constexpr double PI = 3.14159265358979323846;
constexpr double PI_2 = PI / 2.0;
constexpr double PI_4 = PI / 4.0;
constexpr double deg2rad = PI / 180.0;
constexpr double rad2deg = 180.0 / PI;
inline double epsilon = 1e-6;

inline double sign(double x) { return x < 0.0 ? -1.0 : (x > 0.0 ? 1.0 : 0.0); }
inline bool Equal(double a, double b, double eps = epsilon) { return std::fabs(a - b) < eps; }
inline double sqr(double x) { return x * x; }

class Vector {
 public:
  double data[3];

  Vector() : data{0.0, 0.0, 0.0} {}
  Vector(double x, double y, double z) : data{x, y, z} {}

  double operator()(int index) const { return data[index]; }
  double& operator()(int index) { return data[index]; }
  double operator[](int index) const { return data[index]; }
  double& operator[](int index) { return data[index]; }
  double x() const { return data[0]; }
  double y() const { return data[1]; }
  double z() const { return data[2]; }
  void x(double value) { data[0] = value; }
  void y(double value) { data[1] = value; }
  void z(double value) { data[2] = value; }
  Vector& operator+=(const Vector& v) {
    for (int i = 0; i < 3; ++i) data[i] += v.data[i];
    return *this;
  }
  Vector& operator-=(const Vector& v) {
    for (int i = 0; i < 3; ++i) data[i] -= v.data[i];
    return *this;
  }
  void ReverseSign() {
    for (double& value : data) value = -value;
  }
  double Norm() const {
    return std::sqrt(data[0] * data[0] + data[1] * data[1] + data[2] * data[2]);
  }
  // Gives the length back; one too short becomes the x axis.
  double Normalize(double eps = epsilon) {
    const double length = Norm();
    if (length < eps) {
      *this = Vector(1.0, 0.0, 0.0);
    } else {
      for (double& value : data) value /= length;
    }
    return length;
  }
  static Vector Zero() { return Vector(); }
};

inline Vector operator+(Vector a, const Vector& b) { return a += b; }
inline Vector operator-(Vector a, const Vector& b) { return a -= b; }
inline Vector operator-(const Vector& v) { return Vector(-v[0], -v[1], -v[2]); }
inline Vector operator*(const Vector& v, double s) { return Vector(v[0] * s, v[1] * s, v[2] * s); }
inline Vector operator*(double s, const Vector& v) { return v * s; }
inline Vector operator/(const Vector& v, double s) { return v * (1.0 / s); }
// The cross product.
inline Vector operator*(const Vector& a, const Vector& b) {
  return Vector(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline void SetToZero(Vector& v) { v = Vector(); }
inline bool Equal(const Vector& a, const Vector& b, double eps = epsilon) {
  return Equal(a[0], b[0], eps) && Equal(a[1], b[1], eps) && Equal(a[2], b[2], eps);
}
inline bool operator==(const Vector& a, const Vector& b) { return Equal(a, b); }
inline bool operator!=(const Vector& a, const Vector& b) { return !(a == b); }

class Twist;
class Wrench;

class Rotation {
 public:
  double data[9];  // row by row

  Rotation() : data{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0} {}
  Rotation(double xx, double yx, double zx, double xy, double yy, double zy, double xz, double yz,
           double zz)
      : data{xx, yx, zx, xy, yy, zy, xz, yz, zz} {}
  // From the three axes.
  Rotation(const Vector& x, const Vector& y, const Vector& z)
      : data{x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]} {}

  double operator()(int row, int column) const { return data[3 * row + column]; }
  double& operator()(int row, int column) { return data[3 * row + column]; }
  Vector operator*(const Vector& v) const {
    return Vector(data[0] * v[0] + data[1] * v[1] + data[2] * v[2],
                  data[3] * v[0] + data[4] * v[1] + data[5] * v[2],
                  data[6] * v[0] + data[7] * v[1] + data[8] * v[2]);
  }
  Twist operator*(const Twist& t) const;
  Wrench operator*(const Wrench& w) const;
  Twist Inverse(const Twist& t) const;
  Wrench Inverse(const Wrench& w) const;
  Vector Inverse(const Vector& v) const { return Inverse() * v; }
  Rotation Inverse() const {
    return Rotation(data[0], data[3], data[6], data[1], data[4], data[7], data[2], data[5],
                    data[8]);
  }
  void SetInverse() { *this = Inverse(); }
  Vector UnitX() const { return Vector(data[0], data[3], data[6]); }
  Vector UnitY() const { return Vector(data[1], data[4], data[7]); }
  Vector UnitZ() const { return Vector(data[2], data[5], data[8]); }
  void UnitX(const Vector& v) { *this = Rotation(v, UnitY(), UnitZ()); }
  void UnitY(const Vector& v) { *this = Rotation(UnitX(), v, UnitZ()); }
  void UnitZ(const Vector& v) { *this = Rotation(UnitX(), UnitY(), v); }

  static Rotation Identity() { return Rotation(); }
  static Rotation RotX(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return Rotation(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c);
  }
  static Rotation RotY(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return Rotation(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c);
  }
  static Rotation RotZ(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return Rotation(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
  }
  void DoRotX(double angle) { *this = multiplied(RotX(angle)); }
  void DoRotY(double angle) { *this = multiplied(RotY(angle)); }
  void DoRotZ(double angle) { *this = multiplied(RotZ(angle)); }
  static Rotation Rot(const Vector& axis, double angle) {
    Vector unit = axis;
    unit.Normalize();
    return Rot2(unit, angle);
  }
  // The axis is a unit vector already.
  static Rotation Rot2(const Vector& axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), v = 1.0 - c;
    const double x = axis[0], y = axis[1], z = axis[2];
    return Rotation(c + v * x * x, v * x * y - s * z, v * x * z + s * y,  //
                    v * x * y + s * z, c + v * y * y, v * y * z - s * x,  //
                    v * x * z - s * y, v * y * z + s * x, c + v * z * z);
  }
  // About the fixed axes x, y and z, one after another.
  static Rotation RPY(double roll, double pitch, double yaw) {
    return RotZ(yaw).multiplied(RotY(pitch)).multiplied(RotX(roll));
  }
  static Rotation EulerZYX(double alpha, double beta, double gamma) {
    return RPY(gamma, beta, alpha);
  }
  static Rotation EulerZYZ(double alpha, double beta, double gamma) {
    return RotZ(alpha).multiplied(RotY(beta)).multiplied(RotZ(gamma));
  }
  static Rotation Quaternion(double x, double y, double z, double w) {
    return Rotation(w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y),
                    2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x),
                    2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z);
  }
  void GetRPY(double& roll, double& pitch, double& yaw) const {
    pitch = std::atan2(-data[6], std::hypot(data[0], data[3]));
    if (std::fabs(pitch) > PI / 2.0 - 1e-12) {  // roll and yaw turn about the same axis
      yaw = std::atan2(-data[1], data[4]);
      roll = 0.0;
    } else {
      roll = std::atan2(data[7], data[8]);
      yaw = std::atan2(data[3], data[0]);
    }
  }
  void GetEulerZYX(double& alpha, double& beta, double& gamma) const { GetRPY(gamma, beta, alpha); }
  void GetEulerZYZ(double& alpha, double& beta, double& gamma) const {
    if (std::fabs(data[8]) > 1.0 - 1e-12) {
      gamma = 0.0;
      beta = data[8] > 0.0 ? 0.0 : PI;
      alpha = data[8] > 0.0 ? std::atan2(data[3], data[0]) : std::atan2(-data[3], -data[0]);
    } else {
      alpha = std::atan2(data[5], data[2]);
      beta = std::atan2(std::hypot(data[6], data[7]), data[8]);
      gamma = std::atan2(data[7], -data[6]);
    }
  }
  void GetQuaternion(double& x, double& y, double& z, double& w) const;
  // The axis times the angle.
  Vector GetRot() const {
    Vector axis;
    const double angle = GetRotAngle(axis);
    return axis * angle;
  }
  double GetRotAngle(Vector& axis, double eps = epsilon) const;

  Rotation multiplied(const Rotation& r) const {
    Rotation out;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        out(i, j) = (*this)(i, 0) * r(0, j) + (*this)(i, 1) * r(1, j) + (*this)(i, 2) * r(2, j);
    return out;
  }
};

inline Rotation operator*(const Rotation& a, const Rotation& b) { return a.multiplied(b); }
inline void SetToZero(Rotation& r) { r = Rotation(); }
inline bool Equal(const Rotation& a, const Rotation& b, double eps = epsilon) {
  for (int i = 0; i < 9; ++i)
    if (!Equal(a.data[i], b.data[i], eps)) return false;
  return true;
}
inline bool operator==(const Rotation& a, const Rotation& b) { return Equal(a, b); }
inline bool operator!=(const Rotation& a, const Rotation& b) { return !(a == b); }

inline void Rotation::GetQuaternion(double& x, double& y, double& z, double& w) const {
  const Rotation& m = *this;
  const double trace = m(0, 0) + m(1, 1) + m(2, 2) + 1.0;
  if (trace > 1e-12) {
    const double s = 0.5 / std::sqrt(trace);
    w = 0.25 / s;
    x = (m(2, 1) - m(1, 2)) * s;
    y = (m(0, 2) - m(2, 0)) * s;
    z = (m(1, 0) - m(0, 1)) * s;
    return;
  }
  // Half a turn or nearly: from the largest component, so that none loses its digits.
  const int i = m(0, 0) > m(1, 1) ? (m(0, 0) > m(2, 2) ? 0 : 2) : (m(1, 1) > m(2, 2) ? 1 : 2);
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const double s = 2.0 * std::sqrt(1.0 + m(i, i) - m(j, j) - m(k, k));
  double out[3];
  out[i] = 0.25 * s;
  out[j] = (m(j, i) + m(i, j)) / s;
  out[k] = (m(k, i) + m(i, k)) / s;
  w = (m(k, j) - m(j, k)) / s;
  x = out[0];
  y = out[1];
  z = out[2];
}

inline double Rotation::GetRotAngle(Vector& axis, double eps) const {
  const Vector twice(data[7] - data[5], data[2] - data[6], data[3] - data[1]);
  const double c = (data[0] + data[4] + data[8] - 1.0) / 2.0, s = twice.Norm() / 2.0;
  const double angle = std::atan2(s, c);
  if (s > eps) {
    axis = twice / (2.0 * s);
    return angle;
  }
  if (c > 0.0) {  // no rotation: any axis will do
    axis = Vector(0.0, 0.0, 1.0);
    return angle < eps ? 0.0 : angle;
  }
  double x, y, z, w;
  GetQuaternion(x, y, z, w);
  axis = Vector(x, y, z);
  axis.Normalize();
  return angle;
}

class Twist {
 public:
  Vector vel;
  Vector rot;

  Twist() {}
  Twist(const Vector& velocity, const Vector& rotation) : vel(velocity), rot(rotation) {}
  Twist& operator+=(const Twist& t) {
    vel += t.vel;
    rot += t.rot;
    return *this;
  }
  Twist& operator-=(const Twist& t) {
    vel -= t.vel;
    rot -= t.rot;
    return *this;
  }
  double operator()(int i) const { return i < 3 ? vel(i) : rot(i - 3); }
  double& operator()(int i) { return i < 3 ? vel(i) : rot(i - 3); }
  double operator[](int i) const { return (*this)(i); }
  double& operator[](int i) { return (*this)(i); }
  static Twist Zero() { return Twist(); }
  void ReverseSign() {
    vel.ReverseSign();
    rot.ReverseSign();
  }
  // The same motion, told at a point that lies so from the one before.
  Twist RefPoint(const Vector& v_base_AB) const { return Twist(vel + rot * v_base_AB, rot); }
};
inline Twist operator+(Twist a, const Twist& b) { return a += b; }
inline Twist operator-(Twist a, const Twist& b) { return a -= b; }
inline Twist operator-(const Twist& t) { return Twist(-t.vel, -t.rot); }
inline Twist operator*(const Twist& t, double s) { return Twist(t.vel * s, t.rot * s); }
inline Twist operator*(double s, const Twist& t) { return t * s; }
inline Twist operator/(const Twist& t, double s) { return t * (1.0 / s); }
inline void SetToZero(Twist& t) { t = Twist(); }
inline bool Equal(const Twist& a, const Twist& b, double eps = epsilon) {
  return Equal(a.vel, b.vel, eps) && Equal(a.rot, b.rot, eps);
}
inline bool operator==(const Twist& a, const Twist& b) { return Equal(a, b); }
inline bool operator!=(const Twist& a, const Twist& b) { return !(a == b); }

class Wrench {
 public:
  Vector force;
  Vector torque;

  Wrench() {}
  Wrench(const Vector& f, const Vector& t) : force(f), torque(t) {}
  Wrench& operator+=(const Wrench& w) {
    force += w.force;
    torque += w.torque;
    return *this;
  }
  Wrench& operator-=(const Wrench& w) {
    force -= w.force;
    torque -= w.torque;
    return *this;
  }
  double operator()(int i) const { return i < 3 ? force(i) : torque(i - 3); }
  double& operator()(int i) { return i < 3 ? force(i) : torque(i - 3); }
  double operator[](int i) const { return (*this)(i); }
  double& operator[](int i) { return (*this)(i); }
  static Wrench Zero() { return Wrench(); }
  void ReverseSign() {
    force.ReverseSign();
    torque.ReverseSign();
  }
  Wrench RefPoint(const Vector& v_base_AB) const {
    return Wrench(force, torque + force * v_base_AB);
  }
};
inline Wrench operator+(Wrench a, const Wrench& b) { return a += b; }
inline Wrench operator-(Wrench a, const Wrench& b) { return a -= b; }
inline Wrench operator-(const Wrench& w) { return Wrench(-w.force, -w.torque); }
inline Wrench operator*(const Wrench& w, double s) { return Wrench(w.force * s, w.torque * s); }
inline Wrench operator*(double s, const Wrench& w) { return w * s; }
inline Wrench operator/(const Wrench& w, double s) { return w * (1.0 / s); }
inline void SetToZero(Wrench& w) { w = Wrench(); }
inline bool Equal(const Wrench& a, const Wrench& b, double eps = epsilon) {
  return Equal(a.force, b.force, eps) && Equal(a.torque, b.torque, eps);
}
inline bool operator==(const Wrench& a, const Wrench& b) { return Equal(a, b); }
inline bool operator!=(const Wrench& a, const Wrench& b) { return !(a == b); }

// The power that a wrench does along a twist.
inline double dot(const Twist& t, const Wrench& w) {
  return dot(t.vel, w.force) + dot(t.rot, w.torque);
}
inline double dot(const Wrench& w, const Twist& t) { return dot(t, w); }
// How two motions change one another.
inline Twist operator*(const Twist& a, const Twist& b) {
  return Twist(a.rot * b.vel + a.vel * b.rot, a.rot * b.rot);
}
inline Wrench operator*(const Twist& a, const Wrench& b) {
  return Wrench(a.rot * b.force, a.rot * b.torque + a.vel * b.force);
}

inline Twist Rotation::operator*(const Twist& t) const {
  return Twist(*this * t.vel, *this * t.rot);
}
inline Wrench Rotation::operator*(const Wrench& w) const {
  return Wrench(*this * w.force, *this * w.torque);
}
inline Twist Rotation::Inverse(const Twist& t) const { return Inverse() * t; }
inline Wrench Rotation::Inverse(const Wrench& w) const { return Inverse() * w; }

class Frame {
 public:
  Vector p;
  Rotation M;

  Frame() {}
  Frame(const Rotation& R, const Vector& V) : p(V), M(R) {}
  explicit Frame(const Vector& V) : p(V) {}
  explicit Frame(const Rotation& R) : M(R) {}

  double operator()(int row, int column) const {
    if (row == 3) return column == 3 ? 1.0 : 0.0;
    return column == 3 ? p(row) : M(row, column);
  }
  void Make4x4(double* values) const {
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) values[4 * row + column] = (*this)(row, column);
  }
  Frame Inverse() const { return Frame(M.Inverse(), -(M.Inverse() * p)); }
  Vector Inverse(const Vector& v) const { return M.Inverse() * (v - p); }
  Twist Inverse(const Twist& t) const {
    return Twist(M.Inverse() * (t.vel - p * t.rot), M.Inverse() * t.rot);
  }
  Wrench Inverse(const Wrench& w) const {
    return Wrench(M.Inverse() * w.force, M.Inverse() * (w.torque - p * w.force));
  }
  Vector operator*(const Vector& v) const { return M * v + p; }
  Twist operator*(const Twist& t) const {
    const Vector rot = M * t.rot;
    return Twist(M * t.vel + p * rot, rot);
  }
  Wrench operator*(const Wrench& w) const {
    const Vector force = M * w.force;
    return Wrench(force, M * w.torque + p * force);
  }
  static Frame Identity() { return Frame(); }
  // The rotation and the move that a constant twist makes in a time, from here.
  void Integrate(const Twist& t_this, double frequency) {
    const double n = t_this.rot.Norm() / frequency;
    if (n < epsilon) {
      p += M * (t_this.vel / frequency);
    } else {
      *this = Frame(M * Rotation::Rot(t_this.rot, n), p + M * (t_this.vel / frequency));
    }
  }
  // Denavit and Hartenberg, as Craig has it.
  static Frame DH_Craig1989(double a, double alpha, double d, double theta) {
    const double ct = std::cos(theta), st = std::sin(theta);
    const double ca = std::cos(alpha), sa = std::sin(alpha);
    return Frame(Rotation(ct, -st, 0.0, st * ca, ct * ca, -sa, st * sa, ct * sa, ca),
                 Vector(a, -sa * d, ca * d));
  }
  static Frame DH(double a, double alpha, double d, double theta) {
    const double ct = std::cos(theta), st = std::sin(theta);
    const double ca = std::cos(alpha), sa = std::sin(alpha);
    return Frame(Rotation(ct, -st * ca, st * sa, st, ct * ca, -ct * sa, 0.0, sa, ca),
                 Vector(a * ct, a * st, d));
  }
};
inline Frame operator*(const Frame& a, const Frame& b) { return Frame(a.M * b.M, a.M * b.p + a.p); }
inline bool Equal(const Frame& a, const Frame& b, double eps = epsilon) {
  return Equal(a.p, b.p, eps) && Equal(a.M, b.M, eps);
}
inline bool operator==(const Frame& a, const Frame& b) { return Equal(a, b); }
inline bool operator!=(const Frame& a, const Frame& b) { return !(a == b); }

// The constant rate that takes one to the other in a time, and the way there.
inline Vector diff(const Vector& a, const Vector& b, double dt = 1.0) { return (b - a) / dt; }
inline Vector diff(const Rotation& a, const Rotation& b, double dt = 1.0) {
  return a * ((a.Inverse() * b).GetRot() / dt);
}
inline Twist diff(const Frame& a, const Frame& b, double dt = 1.0) {
  return Twist(diff(a.p, b.p, dt), diff(a.M, b.M, dt));
}
inline Twist diff(const Twist& a, const Twist& b, double dt = 1.0) {
  return Twist(diff(a.vel, b.vel, dt), diff(a.rot, b.rot, dt));
}
inline Wrench diff(const Wrench& a, const Wrench& b, double dt = 1.0) {
  return Wrench(diff(a.force, b.force, dt), diff(a.torque, b.torque, dt));
}
inline Vector addDelta(const Vector& a, const Vector& da, double dt = 1.0) { return a + da * dt; }
inline Rotation addDelta(const Rotation& a, const Vector& da, double dt = 1.0) {
  return a * Rotation::Rot(a.Inverse() * da, da.Norm() * dt);
}
inline Frame addDelta(const Frame& a, const Twist& da, double dt = 1.0) {
  return Frame(addDelta(a.M, da.rot, dt), addDelta(a.p, da.vel, dt));
}
inline Twist addDelta(const Twist& a, const Twist& da, double dt = 1.0) { return a + da * dt; }
inline Wrench addDelta(const Wrench& a, const Wrench& da, double dt = 1.0) { return a + da * dt; }

// In the plane.
class Vector2 {
 public:
  double data[2];
  Vector2() : data{0.0, 0.0} {}
  Vector2(double x, double y) : data{x, y} {}
  double operator()(int i) const { return data[i]; }
  double& operator()(int i) { return data[i]; }
  double x() const { return data[0]; }
  double y() const { return data[1]; }
  void x(double value) { data[0] = value; }
  void y(double value) { data[1] = value; }
  double Norm() const { return std::hypot(data[0], data[1]); }
};

inline std::ostream& operator<<(std::ostream& out, const Vector& v) {
  return out << "[" << v[0] << "," << v[1] << "," << v[2] << "]";
}
inline std::ostream& operator<<(std::ostream& out, const Twist& t) {
  out << "[";
  for (int i = 0; i < 6; ++i) out << (i == 0 ? "" : ",") << t(i);
  return out << "]";
}
inline std::ostream& operator<<(std::ostream& out, const Wrench& w) {
  out << "[";
  for (int i = 0; i < 6; ++i) out << (i == 0 ? "" : ",") << w(i);
  return out << "]";
}
inline std::ostream& operator<<(std::ostream& out, const Rotation& r) {
  out << "[";
  for (int i = 0; i < 3; ++i)
    out << (i == 0 ? "" : "\n") << r(i, 0) << "," << r(i, 1) << "," << r(i, 2)
        << (i < 2 ? ";" : "");
  return out << "]";
}
inline std::ostream& operator<<(std::ostream& out, const Frame& f) {
  return out << "[" << f.M << "\n" << f.p << "]\n";
}

}  // namespace KDL
