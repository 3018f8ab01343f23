#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "urdf_exception/exception.h"
#include "urdf_model/utils.h"

namespace urdf {

class Vector3 {
 public:
  Vector3() { clear(); }
  Vector3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}

  void clear() { x = y = z = 0.0; }
  void init(const std::string& vector_str) {
    clear();
    std::istringstream words(vector_str);
    std::vector<double> values;
    for (std::string word; words >> word;) {
      try {
        values.push_back(strToDouble(word.c_str()));
      } catch (const std::runtime_error&) {
        throw ParseError("Unable to parse component [" + word +
                         "] to a double (while parsing a vector value)");
      }
    }
    if (values.size() != 3) {
      throw ParseError("Parser found " + std::to_string(values.size()) +
                       " elements but 3 expected while parsing vector [" + vector_str + "]");
    }
    x = values[0], y = values[1], z = values[2];
  }
  Vector3 operator+(const Vector3& other) const {
    return Vector3(x + other.x, y + other.y, z + other.z);
  }

  double x, y, z;
};

class Rotation {
 public:
  Rotation() { clear(); }
  Rotation(double x_, double y_, double z_, double w_) { setFromQuaternion(x_, y_, z_, w_); }

  void clear() {
    x = y = z = 0.0;
    w = 1.0;
  }
  void init(const std::string& rotation_str) {
    Vector3 rpy;
    rpy.init(rotation_str);
    setFromRPY(rpy.x, rpy.y, rpy.z);
  }
  void setFromQuaternion(double quat_x, double quat_y, double quat_z, double quat_w) {
    x = quat_x, y = quat_y, z = quat_z, w = quat_w;
    normalize();
  }
  void setFromRPY(double roll, double pitch, double yaw) {
    const double cr = std::cos(roll / 2.0), sr = std::sin(roll / 2.0);
    const double cp = std::cos(pitch / 2.0), sp = std::sin(pitch / 2.0);
    const double cy = std::cos(yaw / 2.0), sy = std::sin(yaw / 2.0);
    x = sr * cp * cy - cr * sp * sy;
    y = cr * sp * cy + sr * cp * sy;
    z = cr * cp * sy - sr * sp * cy;
    w = cr * cp * cy + sr * sp * sy;
    normalize();
  }
  void getQuaternion(double& quat_x, double& quat_y, double& quat_z, double& quat_w) const {
    quat_x = x, quat_y = y, quat_z = z, quat_w = w;
  }
  void getRPY(double& roll, double& pitch, double& yaw) const {
    const double sine = 2.0 * (w * y - x * z);
    if (std::fabs(sine) > 0.99999) {  // straight up or down: roll and yaw are one turn
      roll = 0.0;
      pitch = std::copysign(M_PI / 2.0, sine);
      yaw = -std::copysign(2.0, sine) * std::atan2(x, w);
      return;
    }
    roll = std::atan2(2.0 * (y * z + w * x), w * w - x * x - y * y + z * z);
    pitch = std::asin(sine);
    yaw = std::atan2(2.0 * (x * y + w * z), w * w + x * x - y * y - z * z);
  }
  void normalize() {
    const double size = std::sqrt(x * x + y * y + z * z + w * w);
    if (size == 0.0) {
      clear();
    } else {
      x /= size, y /= size, z /= size, w /= size;
    }
  }
  Rotation operator*(const Rotation& q) const {
    Rotation product;
    product.x = w * q.x + x * q.w + y * q.z - z * q.y;
    product.y = w * q.y - x * q.z + y * q.w + z * q.x;
    product.z = w * q.z + x * q.y - y * q.x + z * q.w;
    product.w = w * q.w - x * q.x - y * q.y - z * q.z;
    return product;
  }
  Vector3 operator*(const Vector3& v) const {
    const Vector3 t(2.0 * (y * v.z - z * v.y), 2.0 * (z * v.x - x * v.z),
                    2.0 * (x * v.y - y * v.x));
    return Vector3(v.x + w * t.x + y * t.z - z * t.y, v.y + w * t.y + z * t.x - x * t.z,
                   v.z + w * t.z + x * t.y - y * t.x);
  }
  Rotation GetInverse() const { return Rotation(-x, -y, -z, w); }

  double x, y, z, w;
};

class Pose {
 public:
  void clear() {
    position.clear();
    rotation.clear();
  }

  Vector3 position;
  Rotation rotation;
};

}  // namespace urdf
