#include "kdl/chain.hpp"

#include <stdexcept>

#include "kdl/tree.hpp"

namespace KDL {

// ---- Inertia ----------------------------------------------------------------------------------

namespace {

// What moving a mass by c adds to the inertia about the place that it left.
RotationalInertia of_point(double m, const Vector& c) {
  return RotationalInertia(m * (c[1] * c[1] + c[2] * c[2]), m * (c[0] * c[0] + c[2] * c[2]),
                           m * (c[0] * c[0] + c[1] * c[1]), -m * c[0] * c[1], -m * c[0] * c[2],
                           -m * c[1] * c[2]);
}

RotationalInertia turned(const Rotation& r, const RotationalInertia& inertia) {
  Rotation middle;
  for (int i = 0; i < 9; ++i) middle.data[i] = inertia.data[i];
  middle = r * middle * r.Inverse();
  RotationalInertia out;
  for (int i = 0; i < 9; ++i) out.data[i] = middle.data[i];
  return out;
}

}  // namespace

RigidBodyInertia::RigidBodyInertia(double m, const Vector& cog, const RotationalInertia& Ic)
    : m_(m), h_(cog * m), I_(Ic + of_point(m, cog)) {}

RigidBodyInertia RigidBodyInertia::RefPoint(const Vector& p) const {
  const Vector cog = getCOG();
  return RigidBodyInertia(m_, cog - p, I_ + -1.0 * of_point(m_, cog));
}

RigidBodyInertia operator+(const RigidBodyInertia& a, const RigidBodyInertia& b) {
  RigidBodyInertia out = a;
  out.m_ += b.m_;
  out.h_ += b.h_;
  out.I_ = out.I_ + b.I_;
  return out;
}

RigidBodyInertia operator*(double s, const RigidBodyInertia& inertia) {
  const Vector cog = inertia.getCOG();
  const RotationalInertia about_cog =
      inertia.getRotationalInertia() + -1.0 * of_point(inertia.getMass(), cog);
  return RigidBodyInertia(s * inertia.getMass(), cog, s * about_cog);
}

RigidBodyInertia operator*(const Rotation& rotation, const RigidBodyInertia& inertia) {
  RigidBodyInertia out = inertia;
  out.h_ = rotation * inertia.h_;
  out.I_ = turned(rotation, inertia.I_);
  return out;
}

RigidBodyInertia operator*(const Frame& frame, const RigidBodyInertia& inertia) {
  return (frame.M * inertia).RefPoint(-frame.p);
}

Wrench operator*(const RigidBodyInertia& inertia, const Twist& t) {
  return Wrench(inertia.m_ * t.vel - inertia.h_ * t.rot, inertia.I_ * t.rot + inertia.h_ * t.vel);
}

// ---- Joint ------------------------------------------------------------------------------------

namespace {

Vector named_axis(Joint::JointType type) {
  switch (type) {
    case Joint::RotX:
    case Joint::TransX:
      return Vector(1.0, 0.0, 0.0);
    case Joint::RotY:
    case Joint::TransY:
      return Vector(0.0, 1.0, 0.0);
    case Joint::RotZ:
    case Joint::TransZ:
      return Vector(0.0, 0.0, 1.0);
    case Joint::RotAxis:
    case Joint::TransAxis:
      throw std::invalid_argument("a joint about an axis of its own wants that axis");
    default:
      return Vector();
  }
}

}  // namespace

Joint::Joint(const std::string& name, const JointType& type, double scale, double offset,
             double inertia, double damping, double stiffness)
    : name_(name),
      type_(type),
      scale_(scale),
      offset_(offset),
      inertia_(inertia),
      damping_(damping),
      stiffness_(stiffness),
      axis_(named_axis(type)) {}

Joint::Joint(const JointType& type, double scale, double offset, double inertia, double damping,
             double stiffness)
    : Joint("NoName", type, scale, offset, inertia, damping, stiffness) {}

Joint::Joint(const std::string& name, const Vector& origin, const Vector& axis,
             const JointType& type, double scale, double offset, double inertia, double damping,
             double stiffness)
    : name_(name),
      type_(type),
      scale_(scale),
      offset_(offset),
      inertia_(inertia),
      damping_(damping),
      stiffness_(stiffness),
      axis_(axis),
      origin_(origin) {
  if (type != RotAxis && type != TransAxis)
    throw std::invalid_argument("only joints about an axis of their own are given one");
  axis_.Normalize();
}

Joint::Joint(const Vector& origin, const Vector& axis, const JointType& type, double scale,
             double offset, double inertia, double damping, double stiffness)
    : Joint("NoName", origin, axis, type, scale, offset, inertia, damping, stiffness) {}

Frame Joint::pose(double q) const {
  if (type_ == Fixed) return Frame();
  const double moved = scale_ * q + offset_;
  if (turns()) return Frame(Rotation::Rot2(axis_, moved), origin_);
  return Frame(origin_ + axis_ * moved);
}

Twist Joint::twist(double qdot) const {
  if (type_ == Fixed) return Twist();
  const Vector rate = axis_ * (scale_ * qdot);
  return turns() ? Twist(Vector(), rate) : Twist(rate, Vector());
}

Vector Joint::JointAxis() const { return axis_; }

const std::string Joint::getTypeName() const {
  static const char* const names[] = {"RotAxis", "RotX",   "RotY",   "RotZ", "TransAxis",
                                      "TransX",  "TransY", "TransZ", "Fixed"};
  return names[type_];
}

// ---- Segment, chain ---------------------------------------------------------------------------

Segment::Segment(const std::string& name, const Joint& joint, const Frame& f_tip,
                 const RigidBodyInertia& I)
    : name_(name), joint_(joint), inertia_(I), f_tip_(joint.pose(0.0).Inverse() * f_tip) {}

Segment::Segment(const Joint& joint, const Frame& f_tip, const RigidBodyInertia& I)
    : Segment("NoName", joint, f_tip, I) {}

void Chain::addSegment(const Segment& segment) {
  segments.push_back(segment);
  if (segment.getJoint().getType() != Joint::Fixed) ++joints_;
}

void Chain::addChain(const Chain& chain) {
  for (const Segment& one : std::vector<Segment>(chain.segments)) addSegment(one);
}

// ---- Tree -------------------------------------------------------------------------------------

Tree::Tree(const std::string& root_name) : root_(root_name) {
  segments_.insert(std::make_pair(root_, TreeElement::Root(root_)));
}

Tree::Tree(const Tree& other) : Tree(other.root_) { add_all(other.getRootSegment(), root_); }

Tree& Tree::operator=(const Tree& other) {
  if (this == &other) return *this;
  segments_.clear();
  joints_ = 0;
  root_ = other.root_;
  segments_.insert(std::make_pair(root_, TreeElement::Root(root_)));
  add_all(other.getRootSegment(), root_);
  return *this;
}

bool Tree::addSegment(const Segment& segment, const std::string& hook_name) {
  const auto parent = segments_.find(hook_name);
  if (parent == segments_.end()) return false;
  const bool moves = segment.getJoint().getType() != Joint::Fixed;
  const auto [place, is_new] = segments_.insert(
      std::make_pair(segment.getName(), TreeElement(segment, parent, moves ? joints_ : 0)));
  if (!is_new) return false;
  parent->second.children.push_back(place);
  if (moves) ++joints_;
  return true;
}

bool Tree::addChain(const Chain& chain, const std::string& hook_name) {
  std::string hook = hook_name;
  for (const Segment& one : chain.segments) {
    if (!addSegment(one, hook)) return false;
    hook = one.getName();
  }
  return true;
}

bool Tree::addTree(const Tree& tree, const std::string& hook_name) {
  return add_all(tree.getRootSegment(), hook_name);
}

bool Tree::add_all(SegmentMap::const_iterator root, const std::string& hook_name) {
  for (const SegmentMap::const_iterator& child : root->second.children) {
    if (!addSegment(child->second.segment, hook_name)) return false;
    if (!add_all(child, child->first)) return false;
  }
  return true;
}

namespace {

// The segment the other way round: from its tip to its root, with the same joint.
Segment reversed(const Segment& segment, const std::string& parent_name) {
  const Joint& joint = segment.getJoint();
  const Frame back = segment.getFrameToTip().Inverse();
  if (joint.getType() == Joint::Fixed)
    return Segment(parent_name, Joint(joint.getName(), Joint::Fixed), back);
  const bool turns = joint.getType() <= Joint::RotZ;
  const Vector axis = back.M * -joint.JointAxis();
  return Segment(parent_name,
                 Joint(joint.getName(), back * joint.JointOrigin(), axis,
                       turns ? Joint::RotAxis : Joint::TransAxis),
                 back);
}

}  // namespace

bool Tree::getChain(const std::string& chain_root, const std::string& chain_tip,
                    Chain& chain) const {
  chain = Chain();
  const auto root = segments_.find(chain_root), tip = segments_.find(chain_tip);
  if (root == segments_.end() || tip == segments_.end()) return false;
  const auto ancestors = [&](SegmentMap::const_iterator from) {
    std::vector<SegmentMap::const_iterator> way{from};
    while (way.back()->first != root_) way.push_back(way.back()->second.parent);
    return way;
  };
  std::vector<SegmentMap::const_iterator> up = ancestors(root), down = ancestors(tip);
  SegmentMap::const_iterator meeting = segments_.find(root_);
  while (!up.empty() && !down.empty() && up.back() == down.back()) {
    meeting = up.back();
    up.pop_back();
    down.pop_back();
  }
  for (std::size_t i = 0; i < up.size(); ++i) {
    const std::string& parent = i + 1 < up.size() ? up[i + 1]->first : meeting->first;
    chain.addSegment(reversed(up[i]->second.segment, parent));
  }
  for (auto one = down.rbegin(); one != down.rend(); ++one)
    chain.addSegment((*one)->second.segment);
  return true;
}

}  // namespace KDL
