#pragma once

#include <string>

#include "urdf_model/model.h"

namespace gazelle {

// Reads a robot description into a model (verb description/urdf). False, and the reasons in
// `problem`, where it is none.
bool model_from_text(const std::string& xml, urdf::ModelInterface& model, std::string& problem);

}  // namespace gazelle
