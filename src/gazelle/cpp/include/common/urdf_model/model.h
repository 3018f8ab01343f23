#pragma once

#include <map>
#include <string>
#include <vector>

#include "urdf_model/link.h"
#include "urdf_model/types.h"

namespace urdf {

class ModelInterface {
 public:
  virtual ~ModelInterface() = default;

  LinkConstSharedPtr getRoot() const { return root_link_; }
  LinkConstSharedPtr getLink(const std::string& name) const { return value(links_, name); }
  JointConstSharedPtr getJoint(const std::string& name) const { return value(joints_, name); }
  const std::string& getName() const { return name_; }
  MaterialSharedPtr getMaterial(const std::string& name) const { return value(materials_, name); }
  void getLinks(std::vector<LinkSharedPtr>& links) const {
    for (const auto& entry : links_) links.push_back(entry.second);
  }
  void getLink(const std::string& name, LinkSharedPtr& link) const { link = value(links_, name); }

  void clear() {
    name_.clear();
    links_.clear();
    joints_.clear();
    materials_.clear();
    root_link_.reset();
  }

  // Hang links on joints; `parent_link_tree` becomes child → parent. Throws ParseError.
  void initTree(std::map<std::string, std::string>& parent_link_tree) {
    for (auto& entry : joints_) {
      const JointSharedPtr& joint = entry.second;
      const LinkSharedPtr parent = value(links_, joint->parent_link_name);
      const LinkSharedPtr child = value(links_, joint->child_link_name);
      if (!parent) {
        throw ParseError("parent link [" + joint->parent_link_name + "] of joint [" + entry.first +
                         "] not found");
      }
      if (!child) {
        throw ParseError("child link [" + joint->child_link_name + "] of joint [" + entry.first +
                         "] not found");
      }
      child->setParent(parent);
      child->parent_joint = joint;
      parent->child_joints.push_back(joint);
      parent->child_links.push_back(child);
      parent_link_tree[child->name] = parent->name;
    }
  }
  // Find the one link without a parent. Throws ParseError where there are several or none.
  void initRoot(const std::map<std::string, std::string>& parent_link_tree) {
    root_link_.reset();
    for (const auto& entry : links_) {
      if (parent_link_tree.count(entry.first) != 0) continue;
      if (root_link_) {
        throw ParseError("Two root links found: [" + root_link_->name + "] and [" + entry.first +
                         "]");
      }
      root_link_ = entry.second;
    }
    if (!root_link_) throw ParseError("No root link found. The robot xml is not a valid tree.");
  }

  std::map<std::string, LinkSharedPtr> links_;
  std::map<std::string, JointSharedPtr> joints_;
  std::map<std::string, MaterialSharedPtr> materials_;
  std::string name_;
  LinkSharedPtr root_link_;

 private:
  template <class T>
  static std::shared_ptr<T> value(const std::map<std::string, std::shared_ptr<T>>& map,
                                  const std::string& name) {
    const auto found = map.find(name);
    return found == map.end() ? std::shared_ptr<T>() : found->second;
  }
};

}  // namespace urdf
