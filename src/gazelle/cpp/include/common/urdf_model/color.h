#pragma once

#include <string>
#include <vector>

#include "urdf_exception/exception.h"
#include "urdf_model/utils.h"

namespace urdf {

class Color {
 public:
  Color() { clear(); }
  Color(float red, float green, float blue, float alpha) : r(red), g(green), b(blue), a(alpha) {}

  void clear() {
    r = g = b = 0.0F;
    a = 1.0F;
  }
  bool init(const std::string& vector_str) {
    clear();
    std::istringstream words(vector_str);
    std::vector<float> values;
    for (std::string word; words >> word;) {
      try {
        values.push_back(static_cast<float>(strToDouble(word.c_str())));
      } catch (const std::runtime_error&) {
        return false;
      }
    }
    if (values.size() != 4) return false;
    r = values[0], g = values[1], b = values[2], a = values[3];
    return true;
  }

  float r, g, b, a;
};

}  // namespace urdf
