// Positions with velocities and accelerations; frames with twists.
#pragma once

#include "kdl/jntarray.hpp"

namespace KDL {

class JntArrayVel {
 public:
  JntArray q;
  JntArray qdot;

  JntArrayVel() {}
  explicit JntArrayVel(unsigned int size) : q(size), qdot(size) {}
  explicit JntArrayVel(const JntArray& q_in) : q(q_in), qdot(q_in.rows()) {}
  JntArrayVel(const JntArray& q_in, const JntArray& qdot_in) : q(q_in), qdot(qdot_in) {}
  void resize(unsigned int size) {
    q.resize(size);
    qdot.resize(size);
  }
  JntArray value() const { return q; }
  JntArray deriv() const { return qdot; }
};

class JntArrayAcc {
 public:
  JntArray q;
  JntArray qdot;
  JntArray qdotdot;

  JntArrayAcc() {}
  explicit JntArrayAcc(unsigned int size) : q(size), qdot(size), qdotdot(size) {}
  JntArrayAcc(const JntArray& q_in, const JntArray& qdot_in, const JntArray& qdotdot_in)
      : q(q_in), qdot(qdot_in), qdotdot(qdotdot_in) {}
  void resize(unsigned int size) {
    q.resize(size);
    qdot.resize(size);
    qdotdot.resize(size);
  }
};

struct VectorVel {
  Vector p;  // where
  Vector v;  // how fast
  VectorVel() {}
  explicit VectorVel(const Vector& position) : p(position) {}
  VectorVel(const Vector& position, const Vector& velocity) : p(position), v(velocity) {}
  Vector value() const { return p; }
  Vector deriv() const { return v; }
};

struct RotationVel {
  Rotation R;
  Vector w;
  RotationVel() {}
  explicit RotationVel(const Rotation& rotation) : R(rotation) {}
  RotationVel(const Rotation& rotation, const Vector& rate) : R(rotation), w(rate) {}
  Rotation value() const { return R; }
  Vector deriv() const { return w; }
};

class FrameVel {
 public:
  RotationVel M;
  VectorVel p;

  FrameVel() {}
  explicit FrameVel(const Frame& frame) : M(frame.M), p(frame.p) {}
  FrameVel(const Frame& frame, const Twist& twist) : M(frame.M, twist.rot), p(frame.p, twist.vel) {}
  Frame GetFrame() const { return Frame(M.R, p.p); }
  Twist GetTwist() const { return Twist(p.v, M.w); }
  Frame value() const { return GetFrame(); }
  Twist deriv() const { return GetTwist(); }
  static FrameVel Identity() { return FrameVel(); }
};

}  // namespace KDL
