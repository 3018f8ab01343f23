#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace moveit {
namespace core {

class RobotModel;
class RobotState;

struct VariableBounds {
  double min_position_ = 0.0;
  double max_position_ = 0.0;
  bool position_bounded_ = false;
  double min_velocity_ = 0.0;
  double max_velocity_ = 0.0;
  bool velocity_bounded_ = false;
};

class JointModel {
 public:
  enum JointType { UNKNOWN, REVOLUTE, PRISMATIC, PLANAR, FLOATING, FIXED };

  const std::string& getName() const { return name; }
  JointType getType() const { return type; }
  const std::vector<std::string>& getVariableNames() const { return variables; }
  std::size_t getVariableCount() const { return variables.size(); }
  const std::vector<VariableBounds>& getVariableBounds() const { return bounds; }

  // Filled by the model.
  std::string name;
  JointType type = UNKNOWN;
  std::string child;
  std::vector<std::string> variables;
  std::vector<VariableBounds> bounds;
  bool is_active = false;
};

class LinkModel {
 public:
  const std::string& getName() const { return name; }

  std::string name;
};

// Joints that are planned for together.
class JointModelGroup {
 public:
  const std::string& getName() const { return name; }
  const RobotModel& getParentModel() const { return *parent; }
  const std::vector<std::string>& getJointModelNames() const { return joints; }
  const std::vector<std::string>& getActiveJointModelNames() const { return active_joints; }
  const std::vector<std::string>& getLinkModelNames() const { return links; }
  const std::vector<std::string>& getVariableNames() const { return variables; }
  const std::vector<const JointModel*>& getActiveJointModels() const { return active_models; }
  std::size_t getVariableCount() const { return variables.size(); }
  bool isChain() const { return is_chain; }
  bool isEndEffector() const { return is_chain == false && tips.empty(); }
  const std::vector<std::string>& getSubgroupNames() const { return subgroups; }
  const std::vector<std::string>& getAttachedEndEffectorNames() const { return end_effectors; }
  std::vector<std::string> getDefaultStateNames() const {
    std::vector<std::string> names;
    for (const auto& entry : states) names.push_back(entry.first);
    return names;
  }
  bool getVariableDefaultPositions(const std::string& state,
                                   std::map<std::string, double>& values) const {
    const auto found = states.find(state);
    if (found == states.end()) return false;
    values = found->second;
    return true;
  }
  bool hasLinkModel(const std::string& link) const;
  // The link that poses are about: where the hand is mounted, or the chain's end.
  std::string end_effector_link() const;

  // Filled by the model.
  std::string name;
  const RobotModel* parent = nullptr;
  std::vector<std::string> joints, active_joints, links, variables, tips, subgroups;
  std::vector<std::string> end_effectors, effector_links;
  std::vector<int> indices;
  std::vector<const JointModel*> active_models;
  std::map<std::string, std::map<std::string, double>> states;
  bool is_chain = false;
};

// A robot as URDF and SRDF describe it.
class RobotModel {
 public:
  // Throws gazelle::Error where the texts are no robot.
  RobotModel(const std::string& urdf, const std::string& srdf);
  RobotModel(const RobotModel&) = delete;
  RobotModel& operator=(const RobotModel&) = delete;

  const std::string& getName() const { return name_; }
  // The frame that poses are planned in.
  const std::string& getModelFrame() const { return frame_; }
  const std::string& getRootLinkName() const { return root_; }
  const std::vector<std::string>& getVariableNames() const { return variables_; }
  std::size_t getVariableCount() const { return variables_.size(); }
  const std::vector<std::string>& getLinkModelNames() const { return link_names_; }
  std::vector<std::string> getJointModelNames() const;
  const std::vector<const JointModel*>& getActiveJointModels() const { return active_; }
  const std::vector<std::string>& getJointModelGroupNames() const { return group_names_; }
  bool hasJointModelGroup(const std::string& group) const { return groups_.count(group) != 0; }
  const JointModelGroup* getJointModelGroup(const std::string& group) const;
  bool hasLinkModel(const std::string& link) const { return links_.count(link) != 0; }
  const LinkModel* getLinkModel(const std::string& link) const;
  const JointModel* getJointModel(const std::string& joint) const;
  int getVariableIndex(const std::string& variable) const;

  const std::string& key() const { return key_; }
  const std::vector<double>& defaults() const { return defaults_; }
  const std::vector<JointModel>& joints() const { return joints_; }

 private:
  std::string key_, name_, frame_, root_;
  std::vector<std::string> variables_, link_names_, group_names_;
  std::vector<double> defaults_;
  std::vector<JointModel> joints_;
  std::vector<const JointModel*> active_;
  std::map<std::string, int> index_;
  std::map<std::string, LinkModel> links_;
  std::map<std::string, JointModelGroup> groups_;
};

using RobotModelPtr = std::shared_ptr<RobotModel>;
using RobotModelConstPtr = std::shared_ptr<const RobotModel>;

// Where all joints of a robot are.
class RobotState {
 public:
  explicit RobotState(const RobotModelConstPtr& robot_model)
      : model_(robot_model), positions_(robot_model->defaults()) {}

  const RobotModelConstPtr& getRobotModel() const { return model_; }
  std::size_t getVariableCount() const { return positions_.size(); }
  const std::vector<std::string>& getVariableNames() const { return model_->getVariableNames(); }
  double* getVariablePositions() { return positions_.data(); }
  const double* getVariablePositions() const { return positions_.data(); }
  double getVariablePosition(const std::string& variable) const {
    return positions_.at(model_->getVariableIndex(variable));
  }
  void setVariablePosition(const std::string& variable, double value) {
    positions_.at(model_->getVariableIndex(variable)) = value;
  }
  void setVariablePositions(const std::map<std::string, double>& values) {
    for (const auto& entry : values) setVariablePosition(entry.first, entry.second);
  }
  void setVariablePositions(const std::vector<std::string>& names,
                            const std::vector<double>& values) {
    for (std::size_t i = 0; i < names.size() && i < values.size(); ++i) {
      setVariablePosition(names[i], values[i]);
    }
  }
  void setToDefaultValues() { positions_ = model_->defaults(); }
  // A named state of a group; false where it has none of this name.
  bool setToDefaultValues(const JointModelGroup* group, const std::string& name) {
    const auto found = group->states.find(name);
    if (found == group->states.end()) return false;
    setVariablePositions(found->second);
    return true;
  }
  void setToRandomPositions(const JointModelGroup* group);
  void setJointPositions(const std::string& joint, const double* position) {
    setVariablePosition(joint, *position);
  }
  void setJointPositions(const std::string& joint, const std::vector<double>& position) {
    setVariablePosition(joint, position.at(0));
  }
  const double* getJointPositions(const std::string& joint) const {
    return &positions_.at(model_->getVariableIndex(joint));
  }

  void setJointGroupPositions(const JointModelGroup* group, const std::vector<double>& values) {
    for (std::size_t i = 0; i < group->indices.size() && i < values.size(); ++i) {
      positions_[group->indices[i]] = values[i];
    }
  }
  void setJointGroupPositions(const std::string& group, const std::vector<double>& values) {
    if (const auto* found = model_->getJointModelGroup(group)) {
      setJointGroupPositions(found, values);
    }
  }
  void copyJointGroupPositions(const JointModelGroup* group, std::vector<double>& values) const {
    values.clear();
    for (const int index : group->indices) values.push_back(positions_[index]);
  }
  void copyJointGroupPositions(const std::string& group, std::vector<double>& values) const {
    if (const auto* found = model_->getJointModelGroup(group)) {
      copyJointGroupPositions(found, values);
    }
  }
  const JointModelGroup* getJointModelGroup(const std::string& group) const {
    return model_->getJointModelGroup(group);
  }
  const LinkModel* getLinkModel(const std::string& link) const {
    return model_->getLinkModel(link);
  }
  const JointModel* getJointModel(const std::string& joint) const {
    return model_->getJointModel(joint);
  }

  // Inverse kinematics: from where the joints are, and from elsewhere until the time is up.
  bool setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose,
                 double timeout = 0.0) {
    return setFromIK(group, pose, std::string(), timeout);
  }
  bool setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose,
                 const std::string& tip, double timeout = 0.0);
  template <class PoseMsg, class = decltype(std::declval<PoseMsg>().orientation.w)>
  bool setFromIK(const JointModelGroup* group, const PoseMsg& pose, double timeout = 0.0) {
    return setFromIK(group, pose, std::string(), timeout);
  }
  template <class PoseMsg, class = decltype(std::declval<PoseMsg>().orientation.w)>
  bool setFromIK(const JointModelGroup* group, const PoseMsg& pose, const std::string& tip,
                 double timeout = 0.0) {
    Eigen::Isometry3d target = Eigen::Isometry3d::Identity();
    target.translate(Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z));
    target.rotate(Eigen::Quaterniond(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                                     pose.orientation.z));
    return setFromIK(group, target, tip, timeout);
  }

  // The pose of a link in the model's frame.
  const Eigen::Isometry3d& getGlobalLinkTransform(const std::string& link) const;
  const Eigen::Isometry3d& getGlobalLinkTransform(const LinkModel* link) const {
    return getGlobalLinkTransform(link->getName());
  }
  const Eigen::Isometry3d& getFrameTransform(const std::string& link) const {
    return getGlobalLinkTransform(link);
  }

  bool satisfiesBounds(double margin = 0.0) const;
  bool satisfiesBounds(const JointModelGroup* group, double margin = 0.0) const;
  void enforceBounds();
  void enforceBounds(const JointModelGroup* group);
  double distance(const RobotState& other) const;
  void update(bool /*force*/ = false) {}
  void updateLinkTransforms() {}

 private:
  RobotModelConstPtr model_;
  std::vector<double> positions_;
  // What was asked for last, by link, with the positions that it belongs to.
  mutable std::vector<double> known_at_;
  mutable std::map<std::string, Eigen::Isometry3d> known_;
};

using RobotStatePtr = std::shared_ptr<RobotState>;
using RobotStateConstPtr = std::shared_ptr<const RobotState>;
using JointModelGroupPtr = std::shared_ptr<JointModelGroup>;

}  // namespace core
}  // namespace moveit

// The names of old.
namespace robot_model = moveit::core;
namespace robot_state = moveit::core;
