// Names of image encodings and what they say of a pixel; included inside a namespace of either ROS.
//
// No include guard: `sensor_msgs/image_encodings.h` and `.hpp` bring it into their own namespaces.

inline const std::string RGB8 = "rgb8";
inline const std::string RGBA8 = "rgba8";
inline const std::string RGB16 = "rgb16";
inline const std::string RGBA16 = "rgba16";
inline const std::string BGR8 = "bgr8";
inline const std::string BGRA8 = "bgra8";
inline const std::string BGR16 = "bgr16";
inline const std::string BGRA16 = "bgra16";
inline const std::string MONO8 = "mono8";
inline const std::string MONO16 = "mono16";

// OpenCV's matrices.
inline const std::string TYPE_8UC1 = "8UC1";
inline const std::string TYPE_8UC2 = "8UC2";
inline const std::string TYPE_8UC3 = "8UC3";
inline const std::string TYPE_8UC4 = "8UC4";
inline const std::string TYPE_8SC1 = "8SC1";
inline const std::string TYPE_8SC2 = "8SC2";
inline const std::string TYPE_8SC3 = "8SC3";
inline const std::string TYPE_8SC4 = "8SC4";
inline const std::string TYPE_16UC1 = "16UC1";
inline const std::string TYPE_16UC2 = "16UC2";
inline const std::string TYPE_16UC3 = "16UC3";
inline const std::string TYPE_16UC4 = "16UC4";
inline const std::string TYPE_16SC1 = "16SC1";
inline const std::string TYPE_16SC2 = "16SC2";
inline const std::string TYPE_16SC3 = "16SC3";
inline const std::string TYPE_16SC4 = "16SC4";
inline const std::string TYPE_32SC1 = "32SC1";
inline const std::string TYPE_32SC2 = "32SC2";
inline const std::string TYPE_32SC3 = "32SC3";
inline const std::string TYPE_32SC4 = "32SC4";
inline const std::string TYPE_32FC1 = "32FC1";
inline const std::string TYPE_32FC2 = "32FC2";
inline const std::string TYPE_32FC3 = "32FC3";
inline const std::string TYPE_32FC4 = "32FC4";
inline const std::string TYPE_64FC1 = "64FC1";
inline const std::string TYPE_64FC2 = "64FC2";
inline const std::string TYPE_64FC3 = "64FC3";
inline const std::string TYPE_64FC4 = "64FC4";

// Colours in turn behind a camera's filter.
inline const std::string BAYER_RGGB8 = "bayer_rggb8";
inline const std::string BAYER_BGGR8 = "bayer_bggr8";
inline const std::string BAYER_GBRG8 = "bayer_gbrg8";
inline const std::string BAYER_GRBG8 = "bayer_grbg8";
inline const std::string BAYER_RGGB16 = "bayer_rggb16";
inline const std::string BAYER_BGGR16 = "bayer_bggr16";
inline const std::string BAYER_GBRG16 = "bayer_gbrg16";
inline const std::string BAYER_GRBG16 = "bayer_grbg16";

// Brightness and colour apart.
inline const std::string UYVY = "uyvy";
inline const std::string YUV422 = "yuv422";
inline const std::string YUYV = "yuyv";
inline const std::string YUV422_YUY2 = "yuv422_yuy2";
inline const std::string NV21 = "nv21";
inline const std::string NV24 = "nv24";

inline const std::string ABSTRACT_ENCODING_PREFIXES[] = {"8UC",  "8SC",  "16UC", "16SC",
                                                         "32SC", "32FC", "64FC"};

inline bool isColor(const std::string& encoding) {
  static const std::set<std::string> known = {RGB8,  RGBA8, RGB16,  RGBA16,     BGR8,
                                              BGRA8, BGR16, BGRA16, UYVY,       YUYV,
                                              NV21,  NV24,  YUV422, YUV422_YUY2};
  return known.count(encoding) != 0;
}

inline bool isMono(const std::string& encoding) { return encoding == MONO8 || encoding == MONO16; }

inline bool isBayer(const std::string& encoding) { return encoding.compare(0, 6, "bayer_") == 0; }

inline bool hasAlpha(const std::string& encoding) {
  return encoding == RGBA8 || encoding == BGRA8 || encoding == RGBA16 || encoding == BGRA16;
}

namespace detail {
// "16SC3" as bits and channels, zeros where a text is no such name. Without a number: one channel.
inline void matrix(const std::string& encoding, int& bits, int& channels) {
  bits = channels = 0;
  for (const std::string& prefix : ABSTRACT_ENCODING_PREFIXES) {
    if (encoding.compare(0, prefix.size(), prefix) == 0) {
      bits = std::atoi(prefix.c_str());
      const std::string number = encoding.substr(prefix.size());
      channels = number.empty() ? 1 : std::atoi(number.c_str());
    }
  }
}
}  // namespace detail

inline int numChannels(const std::string& encoding) {
  if (encoding == RGBA8 || encoding == BGRA8 || encoding == RGBA16 || encoding == BGRA16) {
    return 4;
  }
  if (encoding == RGB8 || encoding == BGR8 || encoding == RGB16 || encoding == BGR16 ||
      encoding == NV24) {
    return encoding == NV24 ? 2 : 3;
  }
  if (encoding == UYVY || encoding == YUV422 || encoding == YUYV || encoding == YUV422_YUY2 ||
      encoding == NV21) {
    return 2;
  }
  if (isMono(encoding) || isBayer(encoding)) {
    return 1;
  }
  int bits = 0;
  int channels = 0;
  detail::matrix(encoding, bits, channels);
  if (channels == 0) {
    throw std::runtime_error("Unknown encoding " + encoding);
  }
  return channels;
}

inline int bitDepth(const std::string& encoding) {
  int bits = 0;
  int channels = 0;
  detail::matrix(encoding, bits, channels);
  if (channels != 0) {
    return bits;
  }
  if (encoding == MONO16 || encoding == RGB16 || encoding == RGBA16 || encoding == BGR16 ||
      encoding == BGRA16 || (isBayer(encoding) && encoding.size() > 11)) {
    return 16;
  }
  if (isMono(encoding) || isBayer(encoding) || isColor(encoding)) {
    return 8;
  }
  throw std::runtime_error("Unknown encoding " + encoding);
}
