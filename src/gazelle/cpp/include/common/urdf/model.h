#pragma once

#include <memory>
#include <string>

#include "urdf_model/model.h"

namespace urdf {

// A robot's description, read from a text or a file.
class Model : public ModelInterface {
 public:
  bool initString(const std::string& xmlstring);
  bool initFile(const std::string& filename);
};

using ModelSharedPtr = std::shared_ptr<Model>;
using ModelConstSharedPtr = std::shared_ptr<const Model>;
using ModelUniquePtr = std::unique_ptr<Model>;

}  // namespace urdf
