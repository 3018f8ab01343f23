#pragma once

#include <string>
#include <vector>

#include "urdf_model/color.h"
#include "urdf_model/joint.h"
#include "urdf_model/types.h"

namespace urdf {

class Geometry {
 public:
  enum { SPHERE, BOX, CYLINDER, MESH } type;
  virtual ~Geometry() = default;
};

class Sphere : public Geometry {
 public:
  Sphere() { type = SPHERE; }
  void clear() { radius = 0.0; }
  double radius = 0.0;
};

class Box : public Geometry {
 public:
  Box() { type = BOX; }
  void clear() { dim.clear(); }
  Vector3 dim;
};

class Cylinder : public Geometry {
 public:
  Cylinder() { type = CYLINDER; }
  void clear() { length = radius = 0.0; }
  double length = 0.0;
  double radius = 0.0;
};

class Mesh : public Geometry {
 public:
  Mesh() { type = MESH; }
  void clear() {
    filename.clear();
    scale = Vector3(1.0, 1.0, 1.0);
  }
  std::string filename;
  Vector3 scale = Vector3(1.0, 1.0, 1.0);
};

class Material {
 public:
  void clear() { *this = Material(); }

  std::string name;
  std::string texture_filename;
  Color color;
};

class Inertial {
 public:
  void clear() { *this = Inertial(); }

  Pose origin;
  double mass = 0.0;
  double ixx = 0.0, ixy = 0.0, ixz = 0.0, iyy = 0.0, iyz = 0.0, izz = 0.0;
};

class Visual {
 public:
  void clear() { *this = Visual(); }

  Pose origin;
  GeometrySharedPtr geometry;
  std::string material_name;
  MaterialSharedPtr material;
  std::string name;
};

class Collision {
 public:
  void clear() { *this = Collision(); }

  Pose origin;
  GeometrySharedPtr geometry;
  std::string name;
};

class Link {
 public:
  void clear() { *this = Link(); }
  LinkSharedPtr getParent() const { return parent_link_.lock(); }
  void setParent(const LinkSharedPtr& parent) { parent_link_ = parent; }

  std::string name;
  InertialSharedPtr inertial;
  VisualSharedPtr visual;
  CollisionSharedPtr collision;
  std::vector<CollisionSharedPtr> collision_array;
  std::vector<VisualSharedPtr> visual_array;
  JointSharedPtr parent_joint;
  std::vector<JointSharedPtr> child_joints;
  std::vector<LinkSharedPtr> child_links;
  int link_index = 0;

 private:
  LinkWeakPtr parent_link_;
};

}  // namespace urdf
