#pragma once

#include <memory>

#define GAZELLE_URDF_POINTERS(Class)                          \
  class Class;                                                \
  using Class##SharedPtr = std::shared_ptr<Class>;            \
  using Class##ConstSharedPtr = std::shared_ptr<const Class>; \
  using Class##WeakPtr = std::weak_ptr<Class>

namespace urdf {

GAZELLE_URDF_POINTERS(Box);
GAZELLE_URDF_POINTERS(Collision);
GAZELLE_URDF_POINTERS(Cylinder);
GAZELLE_URDF_POINTERS(Geometry);
GAZELLE_URDF_POINTERS(Inertial);
GAZELLE_URDF_POINTERS(Joint);
GAZELLE_URDF_POINTERS(JointCalibration);
GAZELLE_URDF_POINTERS(JointDynamics);
GAZELLE_URDF_POINTERS(JointLimits);
GAZELLE_URDF_POINTERS(JointMimic);
GAZELLE_URDF_POINTERS(JointSafety);
GAZELLE_URDF_POINTERS(Link);
GAZELLE_URDF_POINTERS(Material);
GAZELLE_URDF_POINTERS(Mesh);
GAZELLE_URDF_POINTERS(ModelInterface);
GAZELLE_URDF_POINTERS(Sphere);
GAZELLE_URDF_POINTERS(Visual);

template <class T, class U>
std::shared_ptr<T> const_pointer_cast(const std::shared_ptr<U>& pointer) {
  return std::const_pointer_cast<T>(pointer);
}
template <class T, class U>
std::shared_ptr<T> dynamic_pointer_cast(const std::shared_ptr<U>& pointer) {
  return std::dynamic_pointer_cast<T>(pointer);
}
template <class T, class U>
std::shared_ptr<T> static_pointer_cast(const std::shared_ptr<U>& pointer) {
  return std::static_pointer_cast<T>(pointer);
}

}  // namespace urdf
