// Robot descriptions as models: read and judged by the host, as urdfdom does it.
#include "urdf/model.h"

#include <fstream>
#include <iterator>

#include "gazelle/core.hpp"
#include "gazelle/json.hpp"
#include "gazelle/urdf/model_from_text.hpp"
#include "urdf_parser/urdf_parser.h"

namespace gazelle {
namespace {

// An element of XML, as {"name", "attributes": {…}, "children": […]}.
class Element {
 public:
  explicit Element(const Json& json) : json_(&json) {}

  std::string name() const { return (*json_)["name"].as_string(); }
  bool has(const char* attribute) const { return (*json_)["attributes"].has(attribute); }
  std::string text(const char* attribute) const {
    return (*json_)["attributes"][attribute].as_string();
  }
  double number(const char* attribute, double fallback = 0.0) const {
    return has(attribute) ? urdf::strToDouble(text(attribute).c_str()) : fallback;
  }
  std::vector<Element> children() const {
    std::vector<Element> found;
    for (const Json& child : (*json_)["children"].items()) found.emplace_back(child);
    return found;
  }
  std::vector<Element> all(const char* child_name) const {
    std::vector<Element> found;
    for (const Element& child : children()) {
      if (child.name() == child_name) found.push_back(child);
    }
    return found;
  }
  // The first child of a name, as a list of none or one.
  std::vector<Element> first(const char* child_name) const {
    std::vector<Element> found = all(child_name);
    if (found.size() > 1) found.erase(found.begin() + 1, found.end());
    return found;
  }

 private:
  const Json* json_;
};

urdf::Pose origin_of(const Element& element) {
  urdf::Pose pose;
  for (const Element& origin : element.first("origin")) {
    if (origin.has("xyz")) pose.position.init(origin.text("xyz"));
    if (origin.has("rpy")) pose.rotation.init(origin.text("rpy"));
  }
  return pose;
}

urdf::MaterialSharedPtr material_of(const Element& element) {
  auto material = std::make_shared<urdf::Material>();
  material->name = element.text("name");
  for (const Element& texture : element.first("texture")) {
    material->texture_filename = texture.text("filename");
  }
  for (const Element& color : element.first("color")) material->color.init(color.text("rgba"));
  return material;
}

bool says_how_it_looks(const Element& material) {
  return !material.all("texture").empty() || !material.all("color").empty();
}

urdf::GeometrySharedPtr geometry_of(const Element& owner) {
  for (const Element& geometry : owner.first("geometry")) {
    for (const Element& shape : geometry.children()) {
      if (shape.name() == "sphere") {
        auto made = std::make_shared<urdf::Sphere>();
        made->radius = shape.number("radius");
        return made;
      }
      if (shape.name() == "box") {
        auto made = std::make_shared<urdf::Box>();
        made->dim.init(shape.text("size"));
        return made;
      }
      if (shape.name() == "cylinder") {
        auto made = std::make_shared<urdf::Cylinder>();
        made->radius = shape.number("radius");
        made->length = shape.number("length");
        return made;
      }
      if (shape.name() == "mesh") {
        auto made = std::make_shared<urdf::Mesh>();
        made->filename = shape.text("filename");
        if (shape.has("scale")) made->scale.init(shape.text("scale"));
        return made;
      }
    }
  }
  return nullptr;
}

urdf::InertialSharedPtr inertial_of(const Element& element) {
  auto inertial = std::make_shared<urdf::Inertial>();
  inertial->origin = origin_of(element);
  for (const Element& mass : element.first("mass")) inertial->mass = mass.number("value");
  for (const Element& inertia : element.first("inertia")) {
    inertial->ixx = inertia.number("ixx");
    inertial->ixy = inertia.number("ixy");
    inertial->ixz = inertia.number("ixz");
    inertial->iyy = inertia.number("iyy");
    inertial->iyz = inertia.number("iyz");
    inertial->izz = inertia.number("izz");
  }
  return inertial;
}

urdf::LinkSharedPtr link_of(const Element& element, urdf::ModelInterface& model) {
  auto link = std::make_shared<urdf::Link>();
  link->name = element.text("name");
  for (const Element& inertial : element.first("inertial")) link->inertial = inertial_of(inertial);
  for (const Element& item : element.all("visual")) {
    auto visual = std::make_shared<urdf::Visual>();
    visual->origin = origin_of(item);
    visual->geometry = geometry_of(item);
    visual->name = item.text("name");
    for (const Element& material : item.first("material")) {
      visual->material_name = material.text("name");
      if (says_how_it_looks(material)) {
        visual->material = material_of(material);
        model.materials_.emplace(visual->material_name, visual->material);
      }
      const auto known = model.materials_.find(visual->material_name);
      if (!visual->material && known != model.materials_.end()) visual->material = known->second;
    }
    link->visual_array.push_back(visual);
  }
  for (const Element& item : element.all("collision")) {
    auto collision = std::make_shared<urdf::Collision>();
    collision->origin = origin_of(item);
    collision->geometry = geometry_of(item);
    collision->name = item.text("name");
    link->collision_array.push_back(collision);
  }
  if (!link->visual_array.empty()) link->visual = link->visual_array.front();
  if (!link->collision_array.empty()) link->collision = link->collision_array.front();
  return link;
}

int joint_type(const std::string& word) {
  if (word == "planar") return urdf::Joint::PLANAR;
  if (word == "floating") return urdf::Joint::FLOATING;
  if (word == "revolute") return urdf::Joint::REVOLUTE;
  if (word == "continuous") return urdf::Joint::CONTINUOUS;
  if (word == "prismatic") return urdf::Joint::PRISMATIC;
  if (word == "fixed") return urdf::Joint::FIXED;
  return urdf::Joint::UNKNOWN;
}

urdf::JointSharedPtr joint_of(const Element& element) {
  auto joint = std::make_shared<urdf::Joint>();
  joint->name = element.text("name");
  joint->type = joint_type(element.text("type"));
  joint->parent_to_joint_origin_transform = origin_of(element);
  for (const Element& end : element.first("parent")) joint->parent_link_name = end.text("link");
  for (const Element& end : element.first("child")) joint->child_link_name = end.text("link");
  if (joint->type != urdf::Joint::FLOATING && joint->type != urdf::Joint::FIXED) {
    joint->axis = urdf::Vector3(1.0, 0.0, 0.0);
    for (const Element& axis : element.first("axis")) {
      if (axis.has("xyz")) joint->axis.init(axis.text("xyz"));
    }
  }
  for (const Element& item : element.first("limit")) {
    joint->limits = std::make_shared<urdf::JointLimits>();
    joint->limits->lower = item.number("lower");
    joint->limits->upper = item.number("upper");
    joint->limits->effort = item.number("effort");
    joint->limits->velocity = item.number("velocity");
  }
  for (const Element& item : element.first("safety_controller")) {
    joint->safety = std::make_shared<urdf::JointSafety>();
    joint->safety->soft_lower_limit = item.number("soft_lower_limit");
    joint->safety->soft_upper_limit = item.number("soft_upper_limit");
    joint->safety->k_position = item.number("k_position");
    joint->safety->k_velocity = item.number("k_velocity");
  }
  for (const Element& item : element.first("calibration")) {
    joint->calibration = std::make_shared<urdf::JointCalibration>();
    joint->calibration->reference_position = item.number("reference_position");
    if (item.has("rising")) {
      joint->calibration->rising = std::make_shared<double>(item.number("rising"));
    }
    if (item.has("falling")) {
      joint->calibration->falling = std::make_shared<double>(item.number("falling"));
    }
  }
  for (const Element& item : element.first("mimic")) {
    joint->mimic = std::make_shared<urdf::JointMimic>();
    joint->mimic->joint_name = item.text("joint");
    joint->mimic->multiplier = item.number("multiplier", 1.0);
    joint->mimic->offset = item.number("offset");
  }
  for (const Element& item : element.first("dynamics")) {
    joint->dynamics = std::make_shared<urdf::JointDynamics>();
    joint->dynamics->damping = item.number("damping");
    joint->dynamics->friction = item.number("friction");
  }
  return joint;
}

void fill(const Element& robot, urdf::ModelInterface& model) {
  model.clear();
  model.name_ = robot.text("name");
  for (const Element& item : robot.all("material")) {
    const auto material = material_of(item);
    model.materials_[material->name] = material;
  }
  for (const Element& item : robot.all("link")) {
    const auto link = link_of(item, model);
    model.links_[link->name] = link;
  }
  for (const Element& item : robot.all("joint")) {
    const auto joint = joint_of(item);
    model.joints_[joint->name] = joint;
  }
  std::map<std::string, std::string> parents;
  model.initTree(parents);
  model.initRoot(parents);
}

}  // namespace

bool model_from_text(const std::string& xml, urdf::ModelInterface& model, std::string& problem) {
  model.clear();
  try {
    const Json read = call("description/urdf", Json::object({{"text", xml}}));
    problem = read["problem"].as_string();
    if (!problem.empty()) return false;
    fill(Element(read["robot"]), model);
  } catch (const std::runtime_error& error) {
    model.clear();
    problem = error.what();
    return false;
  }
  return true;
}

}  // namespace gazelle

namespace urdf {
namespace {

bool read_file(const std::string& path, std::string& text) {
  std::ifstream file(path);
  if (!file) {
    gazelle::log(gazelle::Level::kError, "Could not open file [" + path + "] for parsing.");
    return false;
  }
  text.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  return true;
}

bool fill_model(const std::string& text, ModelInterface& model) {
  std::string problem;
  if (gazelle::model_from_text(text, model, problem)) return true;
  gazelle::log(gazelle::Level::kError, problem);
  return false;
}

}  // namespace

// The same in both versions of ROS, whose headers differ in what does not touch these two.
bool Model::initString(const std::string& xmlstring) { return fill_model(xmlstring, *this); }

bool Model::initFile(const std::string& filename) {
  std::string text;
  return read_file(filename, text) && initString(text);
}

ModelInterfaceSharedPtr parseURDF(const std::string& xml_string) {
  auto model = std::make_shared<ModelInterface>();
  return fill_model(xml_string, *model) ? model : nullptr;
}

ModelInterfaceSharedPtr parseURDFFile(const std::string& path) {
  std::string text;
  return read_file(path, text) ? parseURDF(text) : nullptr;
}

}  // namespace urdf
