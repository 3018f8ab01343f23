#pragma once

#include <map>
#include <string>

#include "kdl/tree.hpp"
#include "urdf/model.h"
#include "urdf_parser/urdf_parser.h"

namespace kdl_parser {

namespace detail {

inline KDL::Frame frame_of(const urdf::Pose& pose) {
  const urdf::Rotation& turn = pose.rotation;
  return KDL::Frame(KDL::Rotation::Quaternion(turn.x, turn.y, turn.z, turn.w),
                    KDL::Vector(pose.position.x, pose.position.y, pose.position.z));
}

inline KDL::Joint joint_of(const urdf::Joint& joint) {
  const KDL::Frame frame = frame_of(joint.parent_to_joint_origin_transform);
  const KDL::Vector axis = frame.M * KDL::Vector(joint.axis.x, joint.axis.y, joint.axis.z);
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      return KDL::Joint(joint.name, frame.p, axis, KDL::Joint::RotAxis);
    case urdf::Joint::PRISMATIC:
      return KDL::Joint(joint.name, frame.p, axis, KDL::Joint::TransAxis);
    default:
      return KDL::Joint(joint.name, KDL::Joint::None);
  }
}

// In the link's frame: the tensor turned into it, the centre where it is.
inline KDL::RigidBodyInertia inertia_of(const urdf::Inertial& inertial) {
  const KDL::Frame origin = frame_of(inertial.origin);
  const KDL::RotationalInertia about_centre(inertial.ixx, inertial.iyy, inertial.izz, inertial.ixy,
                                            inertial.ixz, inertial.iyz);
  const KDL::RigidBodyInertia turned =
      origin.M * KDL::RigidBodyInertia(0.0, KDL::Vector::Zero(), about_centre);
  return KDL::RigidBodyInertia(inertial.mass, origin.p, turned.getRotationalInertia());
}

inline bool add_children(const urdf::LinkConstSharedPtr& link, KDL::Tree& tree) {
  const KDL::RigidBodyInertia inertia =
      link->inertial ? inertia_of(*link->inertial) : KDL::RigidBodyInertia(0.0);
  const KDL::Segment segment(link->name, joint_of(*link->parent_joint),
                             frame_of(link->parent_joint->parent_to_joint_origin_transform),
                             inertia);
  tree.addSegment(segment, link->parent_joint->parent_link_name);
  for (const auto& child : link->child_links) {
    if (!add_children(child, tree)) return false;
  }
  return true;
}

}  // namespace detail

inline bool treeFromUrdfModel(const urdf::ModelInterface& robot_model, KDL::Tree& tree) {
  if (!robot_model.getRoot()) return false;
  tree = KDL::Tree(robot_model.getRoot()->name);
  for (const auto& child : robot_model.getRoot()->child_links) {
    if (!detail::add_children(child, tree)) return false;
  }
  return true;
}

inline bool treeFromString(const std::string& xml, KDL::Tree& tree) {
  const auto model = urdf::parseURDF(xml);
  return model && treeFromUrdfModel(*model, tree);
}

inline bool treeFromFile(const std::string& file, KDL::Tree& tree) {
  const auto model = urdf::parseURDFFile(file);
  return model && treeFromUrdfModel(*model, tree);
}

}  // namespace kdl_parser
