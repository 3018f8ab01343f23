// A robot for MoveIt's interfaces: read, and its kinematics computed, by the host.
#include "gazelle/moveit/robot_model.hpp"

#include <algorithm>
#include <cmath>

#include "gazelle/core.hpp"
#include "gazelle/json.hpp"

namespace moveit {
namespace core {
namespace {

using gazelle::Json;

JointModel::JointType type_of(const std::string& word) {
  if (word == "revolute" || word == "continuous") return JointModel::REVOLUTE;
  if (word == "prismatic") return JointModel::PRISMATIC;
  if (word == "planar") return JointModel::PLANAR;
  if (word == "floating") return JointModel::FLOATING;
  if (word == "fixed") return JointModel::FIXED;
  return JointModel::UNKNOWN;
}

VariableBounds bounds_of(const Json& row) {
  VariableBounds bounds;
  bounds.min_position_ = row[0].as_double();
  bounds.max_position_ = row[1].as_double();
  bounds.position_bounded_ =
      std::isfinite(bounds.min_position_) && std::isfinite(bounds.max_position_);
  bounds.max_velocity_ = row[2].as_double();
  bounds.min_velocity_ = -bounds.max_velocity_;
  bounds.velocity_bounded_ = std::isfinite(bounds.max_velocity_);
  return bounds;
}

}  // namespace

bool JointModelGroup::hasLinkModel(const std::string& link) const {
  return std::find(links.begin(), links.end(), link) != links.end();
}

std::string JointModelGroup::end_effector_link() const {
  if (!effector_links.empty()) return effector_links.front();
  return is_chain && !tips.empty() ? tips.front() : std::string();
}

RobotModel::RobotModel(const std::string& urdf, const std::string& srdf) {
  const Json read = gazelle::call("moveit/model", Json::object({{"urdf", urdf}, {"srdf", srdf}}));
  key_ = read["key"].as_string();
  name_ = read["name"].as_string();
  frame_ = read["frame"].as_string();
  root_ = read["root"].as_string();
  link_names_ = read["links"].as_strings();
  for (const std::string& link : link_names_) links_[link].name = link;
  variables_ = read["variables"].as_strings();
  for (std::size_t i = 0; i < variables_.size(); ++i) index_[variables_[i]] = static_cast<int>(i);
  for (const Json& value : read["defaults"].items()) defaults_.push_back(value.as_double());
  for (const Json& item : read["joints"].items()) {
    JointModel joint;
    joint.name = item["name"].as_string();
    joint.type = type_of(item["type"].as_string());
    joint.child = item["child"].as_string();
    joint.variables = item["variables"].as_strings();
    joint.is_active = item["is_active"].as_bool();
    for (const Json& row : item["bounds"].items()) joint.bounds.push_back(bounds_of(row));
    joints_.push_back(joint);
  }
  for (const JointModel& joint : joints_) {
    if (joint.is_active) active_.push_back(&joint);
  }
  for (const Json& item : read["groups"].items()) {
    const std::string name = item["name"].as_string();
    group_names_.push_back(name);
    JointModelGroup& group = groups_[name];
    group.name = name;
    group.parent = this;
    group.joints = item["joints"].as_strings();
    group.active_joints = item["active_joints"].as_strings();
    group.links = item["links"].as_strings();
    group.variables = item["variables"].as_strings();
    group.tips = item["tips"].as_strings();
    group.subgroups = item["subgroups"].as_strings();
    group.end_effectors = item["end_effectors"].as_strings();
    group.effector_links = item["effector_links"].as_strings();
    group.is_chain = item["is_chain"].as_bool();
    for (const Json& index : item["indices"].items()) {
      group.indices.push_back(static_cast<int>(index.as_int()));
    }
    for (const std::string& joint : group.active_joints) {
      group.active_models.push_back(getJointModel(joint));
    }
    for (const auto& state : item["states"].members()) {
      for (const auto& value : state.second.members()) {
        group.states[state.first][value.first] = value.second.as_double();
      }
    }
  }
}

std::vector<std::string> RobotModel::getJointModelNames() const {
  std::vector<std::string> names;
  for (const JointModel& joint : joints_) names.push_back(joint.name);
  return names;
}

const JointModelGroup* RobotModel::getJointModelGroup(const std::string& group) const {
  const auto found = groups_.find(group);
  if (found != groups_.end()) return &found->second;
  gazelle::log(gazelle::Level::kError, "Group '" + group + "' not found in model '" + name_ + "'");
  return nullptr;
}

const LinkModel* RobotModel::getLinkModel(const std::string& link) const {
  const auto found = links_.find(link);
  if (found != links_.end()) return &found->second;
  gazelle::log(gazelle::Level::kError, "Link '" + link + "' not found in model '" + name_ + "'");
  return nullptr;
}

const JointModel* RobotModel::getJointModel(const std::string& joint) const {
  for (const JointModel& one : joints_) {
    if (one.name == joint) return &one;
  }
  gazelle::log(gazelle::Level::kError, "Joint '" + joint + "' not found in model '" + name_ + "'");
  return nullptr;
}

int RobotModel::getVariableIndex(const std::string& variable) const {
  const auto found = index_.find(variable);
  if (found != index_.end()) return found->second;
  throw std::runtime_error("Variable '" + variable + "' is not known to model '" + name_ + "'");
}

void RobotState::setToRandomPositions(const JointModelGroup* group) {
  const Json found = gazelle::call("moveit/random",
                                   Json::object({{"key", model_->key()}, {"group", group->name}}));
  std::vector<double> values;
  for (const Json& value : found.items()) values.push_back(value.as_double());
  setJointGroupPositions(group, values);
}

bool RobotState::setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose,
                           const std::string& tip, double timeout) {
  const Eigen::Quaterniond turn(pose.rotation());
  const Eigen::Vector3d place = pose.translation();
  const std::string link = tip.empty() ? group->end_effector_link() : tip;
  const Json found = gazelle::call(
      "moveit/ik", Json::object({{"key", model_->key()},
                                 {"group", group->name},
                                 {"link", link},
                                 {"positions", Json(positions_)},
                                 {"timeout_s", timeout},
                                 {"pose", Json::array({place.x(), place.y(), place.z(), turn.x(),
                                                       turn.y(), turn.z(), turn.w()})}}));
  if (found.is_null()) return false;
  std::vector<double> values;
  for (const Json& value : found.items()) values.push_back(value.as_double());
  setJointGroupPositions(group, values);
  return true;
}

const Eigen::Isometry3d& RobotState::getGlobalLinkTransform(const std::string& link) const {
  if (known_at_ != positions_) {
    known_at_ = positions_;
    known_.clear();
  }
  const auto known = known_.find(link);
  if (known != known_.end()) return known->second;
  const Json found = gazelle::call("moveit/fk", Json::object({{"key", model_->key()},
                                                              {"positions", Json(positions_)},
                                                              {"links", Json::array({link})}}));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      pose.matrix()(row, column) = found[0][row * 4 + column].as_double();
    }
  }
  return known_.emplace(link, pose).first->second;
}

namespace {

template <class Visit>
bool for_bounds(const RobotModel& model, const JointModelGroup* group, Visit visit) {
  for (const JointModel& joint : model.joints()) {
    if (!joint.is_active) continue;
    if (group != nullptr && std::find(group->active_joints.begin(), group->active_joints.end(),
                                      joint.name) == group->active_joints.end()) {
      continue;
    }
    for (std::size_t i = 0; i < joint.variables.size() && i < joint.bounds.size(); ++i) {
      const bool goes_on = visit(model.getVariableIndex(joint.variables[i]), joint.bounds[i]);
      if (!goes_on) return false;
    }
  }
  return true;
}

}  // namespace

bool RobotState::satisfiesBounds(double margin) const { return satisfiesBounds(nullptr, margin); }

bool RobotState::satisfiesBounds(const JointModelGroup* group, double margin) const {
  return for_bounds(*model_, group, [&](int index, const VariableBounds& bounds) {
    const double value = positions_[index];
    return !bounds.position_bounded_ ||
           (value >= bounds.min_position_ - margin && value <= bounds.max_position_ + margin);
  });
}

void RobotState::enforceBounds() { enforceBounds(nullptr); }

void RobotState::enforceBounds(const JointModelGroup* group) {
  for_bounds(*model_, group, [&](int index, const VariableBounds& bounds) {
    if (bounds.position_bounded_) {
      positions_[index] =
          std::min(std::max(positions_[index], bounds.min_position_), bounds.max_position_);
    }
    return true;
  });
}

double RobotState::distance(const RobotState& other) const {
  double sum = 0.0;
  for (const JointModel* joint : model_->getActiveJointModels()) {
    for (const std::string& name : joint->variables) {
      sum += std::fabs(getVariablePosition(name) - other.getVariablePosition(name));
    }
  }
  return sum;
}

}  // namespace core
}  // namespace moveit
