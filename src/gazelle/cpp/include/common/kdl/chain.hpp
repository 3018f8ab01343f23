// Joints, segments and chains of them.
#pragma once

#include <string>
#include <vector>

#include "kdl/frames.hpp"

#define GAZELLE_KDL __attribute__((visibility("default")))

namespace KDL {

class RotationalInertia {
 public:
  double data[9];

  explicit RotationalInertia(double Ixx = 0.0, double Iyy = 0.0, double Izz = 0.0, double Ixy = 0.0,
                             double Ixz = 0.0, double Iyz = 0.0)
      : data{Ixx, Ixy, Ixz, Ixy, Iyy, Iyz, Ixz, Iyz, Izz} {}
  static RotationalInertia Zero() { return RotationalInertia(); }
  Vector operator*(const Vector& omega) const {
    return Vector(data[0] * omega[0] + data[1] * omega[1] + data[2] * omega[2],
                  data[3] * omega[0] + data[4] * omega[1] + data[5] * omega[2],
                  data[6] * omega[0] + data[7] * omega[1] + data[8] * omega[2]);
  }
};
inline RotationalInertia operator+(RotationalInertia a, const RotationalInertia& b) {
  for (int i = 0; i < 9; ++i) a.data[i] += b.data[i];
  return a;
}
inline RotationalInertia operator*(double s, RotationalInertia inertia) {
  for (double& value : inertia.data) value *= s;
  return inertia;
}

// Mass, its centre, and the inertia about the reference point.
class GAZELLE_KDL RigidBodyInertia {
 public:
  // `Ic` is about the centre of mass.
  explicit RigidBodyInertia(double m = 0.0, const Vector& cog = Vector::Zero(),
                            const RotationalInertia& Ic = RotationalInertia::Zero());
  static RigidBodyInertia Zero() { return RigidBodyInertia(); }
  double getMass() const { return m_; }
  Vector getCOG() const { return m_ == 0.0 ? Vector::Zero() : h_ / m_; }
  RotationalInertia getRotationalInertia() const { return I_; }
  RigidBodyInertia RefPoint(const Vector& p) const;

 private:
  friend RigidBodyInertia GAZELLE_KDL operator+(const RigidBodyInertia&, const RigidBodyInertia&);
  friend RigidBodyInertia GAZELLE_KDL operator*(const Frame&, const RigidBodyInertia&);
  friend RigidBodyInertia GAZELLE_KDL operator*(const Rotation&, const RigidBodyInertia&);
  friend Wrench GAZELLE_KDL operator*(const RigidBodyInertia&, const Twist&);

  double m_;
  Vector h_;
  RotationalInertia I_;
};
GAZELLE_KDL RigidBodyInertia operator+(const RigidBodyInertia& a, const RigidBodyInertia& b);
GAZELLE_KDL RigidBodyInertia operator*(double s, const RigidBodyInertia& inertia);
GAZELLE_KDL RigidBodyInertia operator*(const Frame& frame, const RigidBodyInertia& inertia);
GAZELLE_KDL RigidBodyInertia operator*(const Rotation& rotation, const RigidBodyInertia& inertia);
GAZELLE_KDL Wrench operator*(const RigidBodyInertia& inertia, const Twist& t);

class GAZELLE_KDL Joint {
 public:
  typedef enum {
    RotAxis,
    RotX,
    RotY,
    RotZ,
    TransAxis,
    TransX,
    TransY,
    TransZ,
    Fixed,
    None = Fixed
  } JointType;

  explicit Joint(const std::string& name, const JointType& type = Fixed, double scale = 1.0,
                 double offset = 0.0, double inertia = 0.0, double damping = 0.0,
                 double stiffness = 0.0);
  explicit Joint(const JointType& type = Fixed, double scale = 1.0, double offset = 0.0,
                 double inertia = 0.0, double damping = 0.0, double stiffness = 0.0);
  Joint(const std::string& name, const Vector& origin, const Vector& axis, const JointType& type,
        double scale = 1.0, double offset = 0.0, double inertia = 0.0, double damping = 0.0,
        double stiffness = 0.0);
  Joint(const Vector& origin, const Vector& axis, const JointType& type, double scale = 1.0,
        double offset = 0.0, double inertia = 0.0, double damping = 0.0, double stiffness = 0.0);

  Frame pose(double q) const;
  Twist twist(double qdot) const;
  Vector JointAxis() const;
  Vector JointOrigin() const { return origin_; }
  const std::string& getName() const { return name_; }
  JointType getType() const { return type_; }
  const std::string getTypeName() const;
  double getInertia() const { return inertia_; }
  double getDamping() const { return damping_; }
  double getStiffness() const { return stiffness_; }

 private:
  bool turns() const { return type_ <= RotZ; }

  std::string name_;
  JointType type_;
  double scale_, offset_, inertia_, damping_, stiffness_;
  Vector axis_, origin_;
};

class GAZELLE_KDL Segment {
 public:
  explicit Segment(const std::string& name, const Joint& joint = Joint(Joint::Fixed),
                   const Frame& f_tip = Frame::Identity(),
                   const RigidBodyInertia& I = RigidBodyInertia::Zero());
  explicit Segment(const Joint& joint = Joint(Joint::Fixed), const Frame& f_tip = Frame::Identity(),
                   const RigidBodyInertia& I = RigidBodyInertia::Zero());

  Frame pose(double q) const { return joint_.pose(q) * f_tip_; }
  Twist twist(double q, double qdot) const {
    return joint_.twist(qdot).RefPoint(joint_.pose(q).M * f_tip_.p);
  }
  const std::string& getName() const { return name_; }
  const Joint& getJoint() const { return joint_; }
  const RigidBodyInertia& getInertia() const { return inertia_; }
  void setInertia(const RigidBodyInertia& inertia) { inertia_ = inertia; }
  Frame getFrameToTip() const { return joint_.pose(0.0) * f_tip_; }
  void setFrameToTip(const Frame& f_tip) { f_tip_ = joint_.pose(0.0).Inverse() * f_tip; }

 private:
  std::string name_;
  Joint joint_;
  RigidBodyInertia inertia_;
  Frame f_tip_;  // from the joint, where it stands at 0
};

class GAZELLE_KDL Chain {
 public:
  std::vector<Segment> segments;

  void addSegment(const Segment& segment);
  void addChain(const Chain& chain);
  unsigned int getNrOfJoints() const { return joints_; }
  unsigned int getNrOfSegments() const { return static_cast<unsigned int>(segments.size()); }
  const Segment& getSegment(unsigned int nr) const { return segments[nr]; }
  Segment& getSegment(unsigned int nr) { return segments[nr]; }

 private:
  unsigned int joints_ = 0;
};

}  // namespace KDL
