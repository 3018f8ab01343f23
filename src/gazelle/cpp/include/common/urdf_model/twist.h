#pragma once

#include "urdf_model/pose.h"

namespace urdf {

class Twist {
 public:
  void clear() {
    linear.clear();
    angular.clear();
  }

  Vector3 linear;
  Vector3 angular;
};

}  // namespace urdf
