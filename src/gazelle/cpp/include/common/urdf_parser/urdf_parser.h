#pragma once

#include <string>

#include "urdf_model/model.h"
#include "urdf_model/types.h"

namespace urdf {

// The model of a description; null where it is none, which is said on the console.
ModelInterfaceSharedPtr parseURDF(const std::string& xml_string);
ModelInterfaceSharedPtr parseURDFFile(const std::string& path);

}  // namespace urdf
