// Encodings of sensor_msgs/Image as OpenCV has them, and from one to another.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace cv_bridge {

class Exception : public std::runtime_error {
 public:
  explicit Exception(const std::string& description) : std::runtime_error(description) {}
};

typedef enum { BMP, DIB, JPG, JPEG, JPE, JP2, PNG, PBM, PGM, PPM, SR, RAS, TIFF, TIF } Format;

struct CvtColorForDisplayOptions {
  bool do_dynamic_scaling = false;
  double min_image_value = 0.0;
  double max_image_value = 0.0;
  int colormap = -1;
  int bg_label = -1;
};

namespace impl {

// What a name says: the order of its channels ("" where only the type is known), how many, and
// OpenCV's word for a value's type.
struct Encoding {
  std::string order;
  int channels = 0;
  int depth = CV_8U;
};

inline bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

inline bool find_encoding(const std::string& name, Encoding& out) {
  static const std::map<std::string, Encoding> odd = {
      {"yuv422", {"uyvy", 2, CV_8U}},
      {"uyvy", {"uyvy", 2, CV_8U}},
      {"yuv422_yuy2", {"yuyv", 2, CV_8U}},
      {"yuyv", {"yuyv", 2, CV_8U}},
  };
  if (const auto found = odd.find(name); found != odd.end()) {
    out = found->second;
    return true;
  }
  static const std::map<std::string, int> colours = {
      {"mono", 1},       {"rgb", 3},        {"bgr", 3},        {"rgba", 4},      {"bgra", 4},
      {"bayer_rggb", 1}, {"bayer_bggr", 1}, {"bayer_gbrg", 1}, {"bayer_grbg", 1}};
  for (const auto& [order, channels] : colours) {
    if (name == order + "8" || name == order + "16") {
      out = {order, channels, name == order + "8" ? CV_8U : CV_16U};
      return true;
    }
  }
  static const std::map<std::string, int> depths = {
      {"8U", CV_8U},   {"8S", CV_8S},   {"16U", CV_16U}, {"16S", CV_16S},
      {"32S", CV_32S}, {"32F", CV_32F}, {"64F", CV_64F}};
  for (const auto& [word, depth] : depths) {
    if (name == word) {
      out = {"", 1, depth};
      return true;
    }
    if (!starts_with(name, word + "C")) continue;
    const std::string digits = name.substr(word.size() + 1);
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos) continue;
    out = {"", std::atoi(digits.c_str()), depth};
    return out.channels >= 1 && out.channels <= CV_CN_MAX;
  }
  return false;
}

inline Encoding encoding_of(const std::string& name) {
  Encoding out;
  if (!find_encoding(name, out)) throw Exception("Unrecognized image encoding [" + name + "]");
  return out;
}

// OpenCV's number for a change of colours; -1 where there is none.
inline int colour_code(const std::string& from, const std::string& to) {
  static const std::map<std::string, int> codes = {
      {"mono rgb", cv::COLOR_GRAY2RGB},
      {"mono bgr", cv::COLOR_GRAY2BGR},
      {"mono rgba", cv::COLOR_GRAY2RGBA},
      {"mono bgra", cv::COLOR_GRAY2BGRA},
      {"rgb mono", cv::COLOR_RGB2GRAY},
      {"rgb bgr", cv::COLOR_RGB2BGR},
      {"rgb rgba", cv::COLOR_RGB2RGBA},
      {"rgb bgra", cv::COLOR_RGB2BGRA},
      {"bgr mono", cv::COLOR_BGR2GRAY},
      {"bgr rgb", cv::COLOR_BGR2RGB},
      {"bgr rgba", cv::COLOR_BGR2RGBA},
      {"bgr bgra", cv::COLOR_BGR2BGRA},
      {"rgba mono", cv::COLOR_RGBA2GRAY},
      {"rgba rgb", cv::COLOR_RGBA2RGB},
      {"rgba bgr", cv::COLOR_RGBA2BGR},
      {"rgba bgra", cv::COLOR_RGBA2BGRA},
      {"bgra mono", cv::COLOR_BGRA2GRAY},
      {"bgra rgb", cv::COLOR_BGRA2RGB},
      {"bgra bgr", cv::COLOR_BGRA2BGR},
      {"bgra rgba", cv::COLOR_BGRA2RGBA},
      {"uyvy mono", cv::COLOR_YUV2GRAY_UYVY},
      {"uyvy rgb", cv::COLOR_YUV2RGB_UYVY},
      {"uyvy bgr", cv::COLOR_YUV2BGR_UYVY},
      {"uyvy rgba", cv::COLOR_YUV2RGBA_UYVY},
      {"uyvy bgra", cv::COLOR_YUV2BGRA_UYVY},
      {"yuyv mono", cv::COLOR_YUV2GRAY_YUY2},
      {"yuyv rgb", cv::COLOR_YUV2RGB_YUY2},
      {"yuyv bgr", cv::COLOR_YUV2BGR_YUY2},
      {"yuyv rgba", cv::COLOR_YUV2RGBA_YUY2},
      {"yuyv bgra", cv::COLOR_YUV2BGRA_YUY2},
      // OpenCV names a pattern by its second row's second and third pixels.
      {"bayer_rggb mono", cv::COLOR_BayerBG2GRAY},
      {"bayer_rggb rgb", cv::COLOR_BayerBG2RGB},
      {"bayer_rggb bgr", cv::COLOR_BayerBG2BGR},
      {"bayer_bggr mono", cv::COLOR_BayerRG2GRAY},
      {"bayer_bggr rgb", cv::COLOR_BayerRG2RGB},
      {"bayer_bggr bgr", cv::COLOR_BayerRG2BGR},
      {"bayer_gbrg mono", cv::COLOR_BayerGR2GRAY},
      {"bayer_gbrg rgb", cv::COLOR_BayerGR2RGB},
      {"bayer_gbrg bgr", cv::COLOR_BayerGR2BGR},
      {"bayer_grbg mono", cv::COLOR_BayerGB2GRAY},
      {"bayer_grbg rgb", cv::COLOR_BayerGB2RGB},
      {"bayer_grbg bgr", cv::COLOR_BayerGB2BGR}};
  const auto found = codes.find(from + " " + to);
  return found == codes.end() ? -1 : found->second;
}

// A copy in another encoding.
inline cv::Mat converted(const cv::Mat& image, const std::string& source,
                         const std::string& target) {
  if (target.empty() || source == target) return image.clone();
  const Encoding from = encoding_of(source), to = encoding_of(target);
  const bool is_colour = !from.order.empty(), wants_colour = !to.order.empty();
  if (!is_colour && wants_colour)
    throw Exception("[" + source + "] is not a color format. but [" + target +
                    "] is. The conversion does not make sense");
  if (!is_colour && from.channels != to.channels)
    throw Exception("[" + source + "] and [" + target + "] do not have the same number of channel");
  if (is_colour && !wants_colour && from.channels != to.channels)
    throw Exception("[" + source + "] is a color format but [" + target +
                    "] is not so they must have the same OpenCV type, CV_8UC3, CV16UC1 ....");
  cv::Mat out = image;
  if (is_colour && wants_colour && from.order != to.order) {
    int code = colour_code(from.order, to.order);
    if (code < 0 && starts_with(from.order, "bayer") && to.channels == 4) {
      // Patterns become colours first, which then get an alpha.
      cv::Mat colours;
      cv::cvtColor(out, colours, colour_code(from.order, "bgr"));
      out = colours;
      code = colour_code("bgr", to.order);
    }
    if (code < 0)
      throw Exception("Unsupported conversion from [" + source + "] to [" + target + "]");
    cv::Mat colours;
    cv::cvtColor(out, colours, code);
    out = colours;
  }
  if (from.depth != to.depth) {
    double scale = 1.0;
    if (is_colour && from.depth == CV_8U && to.depth == CV_16U) scale = 65535.0 / 255.0;
    if (is_colour && from.depth == CV_16U && to.depth == CV_8U) scale = 255.0 / 65535.0;
    cv::Mat values;
    out.convertTo(values, CV_MAKETYPE(to.depth, out.channels()), scale);
    return values;
  }
  return out.data == image.data ? out.clone() : out;
}

inline const char* extension(Format format) {
  static const char* const names[] = {"bmp", "dib", "jpg", "jpeg", "jpe", "jp2",  "png",
                                      "pbm", "pgm", "ppm", "sr",   "ras", "tiff", "tif"};
  return names[format];
}

inline bool machine_is_big_endian() {
  const std::uint16_t probe = 1;
  return *reinterpret_cast<const std::uint8_t*>(&probe) == 0;
}

// The message's bytes as an image; swapped into a copy where they are the other way round.
template <class Image>
cv::Mat view_of(const Image& source) {
  const Encoding encoding = encoding_of(source.encoding);
  const int type = CV_MAKETYPE(encoding.depth, encoding.channels);
  const std::size_t value_size = CV_ELEM_SIZE1(type);
  const std::size_t row = static_cast<std::size_t>(source.width) * CV_ELEM_SIZE(type);
  if (source.step < row)
    throw Exception("Image is wrongly formed: step < width * byte_depth * num_channels  or  " +
                    std::to_string(source.step) + " != " + std::to_string(source.width) + " * " +
                    std::to_string(value_size) + " * " + std::to_string(encoding.channels));
  if (static_cast<std::size_t>(source.height) * source.step != source.data.size())
    throw Exception("Image is wrongly formed: height * step != size  or  " +
                    std::to_string(source.height) + " * " + std::to_string(source.step) +
                    " != " + std::to_string(source.data.size()));
  const cv::Mat view(static_cast<int>(source.height), static_cast<int>(source.width), type,
                     const_cast<std::uint8_t*>(source.data.data()), source.step);
  if (value_size == 1 || (source.is_bigendian != 0) == machine_is_big_endian()) return view;
  cv::Mat swapped = view.clone();
  const std::size_t values = static_cast<std::size_t>(swapped.cols) * encoding.channels;
  for (int y = 0; y < swapped.rows; ++y) {
    std::uint8_t* value = swapped.ptr<std::uint8_t>(y);
    for (std::size_t i = 0; i < values; ++i, value += value_size)
      std::reverse(value, value + value_size);
  }
  return swapped;
}

// What the bytes of a compressed image hold, and its encoding.
template <class Compressed>
cv::Mat decompressed(const Compressed& source, std::string& encoding) {
  const cv::Mat bytes(1, static_cast<int>(source.data.size()), CV_8UC1,
                      const_cast<std::uint8_t*>(source.data.data()));
  const cv::Mat image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  if (image.empty())
    throw Exception("a compressed image of format '" + source.format + "' cannot be read");
  const std::string bits = image.depth() == CV_16U ? "16" : "8";
  encoding = (image.channels() == 1 ? "mono" : (image.channels() == 3 ? "bgr" : "bgra")) + bits;
  return image;
}

// For the eye: labels in colours, depths scaled between two values.
inline cv::Mat for_display(const cv::Mat& image, const std::string& source, std::string& target,
                           const CvtColorForDisplayOptions& options) {
  Encoding from = encoding_of(source);
  if (target.empty())
    target = from.channels == 1 && !starts_with(from.order, "bayer") ? "mono8" : "bgr8";
  const bool scales =
      options.do_dynamic_scaling || options.min_image_value != options.max_image_value;
  if (!from.order.empty() && !scales) return converted(image, source, target);
  if (from.channels != 1)
    throw Exception("cvtColorForDisplay() does not know how to scale images of " + source);
  if (source == "32SC1" && !scales) {  // labels
    cv::Mat colours(image.rows, image.cols, CV_8UC3, cv::Scalar(0, 0, 0));
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        const int label = image.at<int>(y, x);
        if (label == options.bg_label) continue;
        const unsigned mixed = static_cast<unsigned>(label + 1) * 2654435761U;
        colours.at<cv::Vec3b>(y, x) = cv::Vec3b(static_cast<std::uint8_t>(mixed >> 24),
                                                static_cast<std::uint8_t>(mixed >> 16),
                                                static_cast<std::uint8_t>(mixed >> 8));
      }
    }
    return converted(colours, "bgr8", target);
  }
  double low = options.min_image_value, high = options.max_image_value;
  if (low == high) {
    if (options.do_dynamic_scaling) {
      cv::minMaxLoc(image, &low, &high, nullptr, nullptr, image == image);
    } else {
      low = 0.0;
      high = from.depth == CV_8U ? 255.0 : (from.depth == CV_16U ? 10000.0 : 10.0);
    }
  }
  const double scale = high > low ? 255.0 / (high - low) : 0.0;
  cv::Mat grey;
  image.convertTo(grey, CV_8UC1, scale, -low * scale);
  if (options.colormap >= 0) {
    cv::Mat colours;
    cv::applyColorMap(grey, colours, options.colormap);
    return converted(colours, "bgr8", target);
  }
  return converted(grey, "mono8", target);
}

}  // namespace impl

inline int getCvType(const std::string& encoding) {
  const impl::Encoding found = impl::encoding_of(encoding);
  return CV_MAKETYPE(found.depth, found.channels);
}

}  // namespace cv_bridge
