// Fields and points of sensor_msgs' PointCloud2, for the classes of either ROS.
#pragma once

#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gazelle {
namespace clouds {

// Numbers of sensor_msgs/PointField's kinds.
enum Kind { int8 = 1, uint8, int16, uint16, int32, uint32, float32, float64 };

inline int size_of_kind(int kind) {
  switch (kind) {
    case int8:
    case uint8:
      return 1;
    case int16:
    case uint16:
      return 2;
    case int32:
    case uint32:
    case float32:
      return 4;
    case float64:
      return 8;
    default:
      throw std::runtime_error("PointField of type " + std::to_string(kind) + " does not exist");
  }
}

template <class Field, class Cloud>
int add_field(Cloud& cloud, const std::string& name, int count, int kind, int offset) {
  Field field;
  field.name = name;
  field.count = static_cast<std::uint32_t>(count);
  field.datatype = static_cast<std::uint8_t>(kind);
  field.offset = static_cast<std::uint32_t>(offset);
  cloud.fields.push_back(field);
  return offset + count * size_of_kind(kind);
}

// Gives a cloud fields and points.
template <class Cloud, class Field>
class Modifier {
 public:
  explicit Modifier(Cloud& cloud) : cloud_(cloud) {}

  std::size_t size() const {
    return cloud_.point_step == 0 ? 0 : cloud_.data.size() / cloud_.point_step;
  }
  void reserve(std::size_t size) { cloud_.data.reserve(size * cloud_.point_step); }
  void resize(std::size_t size) {
    cloud_.data.resize(size * cloud_.point_step);
    // The rows of an organized cloud do not hold another number of points.
    cloud_.height = 1;
    cloud_.width = static_cast<std::uint32_t>(size);
    cloud_.row_step = cloud_.width * cloud_.point_step;
  }
  void clear() {
    cloud_.data.clear();
    cloud_.height = cloud_.width = cloud_.row_step = 0;
  }

  // For each field: name (const char *), count (int), kind (int), as in setPointCloud2Fields(3,
  // "x", 1, sensor_msgs::PointField::FLOAT32, …).
  void setPointCloud2Fields(int n_fields, ...) {
    cloud_.fields.clear();
    va_list words;
    va_start(words, n_fields);
    int offset = 0;
    for (int i = 0; i < n_fields; ++i) {
      const std::string name(va_arg(words, char*));
      const int count = va_arg(words, int);
      const int kind = va_arg(words, int);
      offset = add_field<Field>(cloud_, name, count, kind, offset);
    }
    va_end(words);
    finish(offset);
  }

  // "xyz", "rgb" and "rgba", each padded to 16 bytes.
  void setPointCloud2FieldsByString(int n_fields, ...) {
    cloud_.fields.clear();
    va_list words;
    va_start(words, n_fields);
    int offset = 0;
    for (int i = 0; i < n_fields; ++i) {
      const std::string name(va_arg(words, char*));
      if (name == "xyz") {
        offset = add_field<Field>(cloud_, "x", 1, float32, offset);
        offset = add_field<Field>(cloud_, "y", 1, float32, offset);
        offset = add_field<Field>(cloud_, "z", 1, float32, offset) + 4;
      } else if (name == "rgb" || name == "rgba") {
        offset = add_field<Field>(cloud_, name, 1, float32, offset) + 12;
      } else {
        va_end(words);
        throw std::runtime_error("Field " + name + " does not exist");
      }
    }
    va_end(words);
    finish(offset);
  }

 private:
  void finish(int offset) {
    cloud_.point_step = static_cast<std::uint32_t>(offset);
    cloud_.row_step = cloud_.width * cloud_.point_step;
    cloud_.data.resize(static_cast<std::size_t>(cloud_.height) * cloud_.row_step);
  }
  Cloud& cloud_;
};

// Steps from point to point over one field, whose bytes are taken for a `Number`.
template <class Number, class Cloud, class Derived>
class Iterator {
  using Byte = std::conditional_t<std::is_const<Number>::value, const unsigned char, unsigned char>;

 public:
  Iterator() = default;
  Iterator(Cloud& cloud, const std::string& field) { begin(cloud, field); }

  Number& operator*() const { return *data_; }
  Number& operator[](std::size_t i) const { return *(data_ + i); }
  Derived& operator++() {
    data_ = reinterpret_cast<Number*>(bytes() + step_);
    return static_cast<Derived&>(*this);
  }
  Derived operator++(int) {
    Derived before = static_cast<Derived&>(*this);
    ++*this;
    return before;
  }
  Derived operator+(int count) const {
    Derived moved = static_cast<const Derived&>(*this);
    moved += count;
    return moved;
  }
  Derived& operator+=(int count) {
    data_ = reinterpret_cast<Number*>(bytes() + static_cast<std::ptrdiff_t>(step_) * count);
    return static_cast<Derived&>(*this);
  }
  bool operator==(const Derived& other) const { return data_ == other.data_; }
  bool operator!=(const Derived& other) const { return data_ != other.data_; }
  Derived end() const {
    Derived found = static_cast<const Derived&>(*this);
    found.data_ = end_;
    return found;
  }

 private:
  Byte* bytes() const { return reinterpret_cast<Byte*>(data_); }

  void begin(Cloud& cloud, const std::string& name) {
    step_ = cloud.point_step;
    std::size_t offset = 0;
    bool is_there = false;
    for (const auto& field : cloud.fields) {
      if (field.name == name) {
        offset = field.offset;
        is_there = true;
      }
    }
    // The parts of a colour, which is one number of four bytes: blue first where it is
    // little-endian.
    const std::string parts = "bgra";
    if (!is_there && name.size() == 1 && parts.find(name) != std::string::npos) {
      for (const auto& field : cloud.fields) {
        if (field.name == "rgb" || field.name == "rgba") {
          const std::size_t place = parts.find(name);
          offset = field.offset + (cloud.is_bigendian ? 3 - place : place);
          is_there = true;
        }
      }
    }
    if (!is_there) throw std::runtime_error("Field " + name + " does not exist");
    Byte* start = cloud.data.data();
    const std::size_t points =
        step_ == 0 ? 0 : static_cast<std::size_t>(cloud.width) * cloud.height;
    data_ = reinterpret_cast<Number*>(start + offset);
    end_ = reinterpret_cast<Number*>(start + offset + points * step_);
  }

  std::size_t step_ = 0;
  Number* data_ = nullptr;
  Number* end_ = nullptr;
};

// A number of any kind of a point's field.
template <class T>
T read_number(const unsigned char* from, int kind) {
  const auto as = [from](auto zero) {
    auto value = zero;
    __builtin_memcpy(&value, from, sizeof(value));
    return static_cast<T>(value);
  };
  switch (kind) {
    case int8:
      return as(std::int8_t{});
    case uint8:
      return as(std::uint8_t{});
    case int16:
      return as(std::int16_t{});
    case uint16:
      return as(std::uint16_t{});
    case int32:
      return as(std::int32_t{});
    case uint32:
      return as(std::uint32_t{});
    case float32:
      return as(float{});
    case float64:
      return as(double{});
    default:
      return T{};
  }
}

template <class T>
void write_number(unsigned char* to, int kind, T number) {
  const auto as = [to, number](auto zero) {
    const auto value = static_cast<decltype(zero)>(number);
    __builtin_memcpy(to, &value, sizeof(value));
  };
  switch (kind) {
    case int8:
      return as(std::int8_t{});
    case uint8:
      return as(std::uint8_t{});
    case int16:
      return as(std::int16_t{});
    case uint16:
      return as(std::uint16_t{});
    case int32:
      return as(std::int32_t{});
    case uint32:
      return as(std::uint32_t{});
    case float32:
      return as(float{});
    case float64:
      return as(double{});
    default:
      return;
  }
}

// sensor_msgs/PointCloud as PointCloud2: x, y, z and the channels as 32-bit floats.
template <class Field, class Cloud, class Cloud2>
bool to_cloud2(const Cloud& input, Cloud2& output) {
  output.header = input.header;
  output.width = static_cast<std::uint32_t>(input.points.size());
  output.height = 1;
  output.fields.clear();
  int offset = 0;
  for (const char* name : {"x", "y", "z"}) {
    offset = add_field<Field>(output, name, 1, float32, offset);
  }
  for (const auto& channel : input.channels) {
    offset = add_field<Field>(output, channel.name, 1, float32, offset);
  }
  output.point_step = static_cast<std::uint32_t>(offset);
  output.row_step = output.point_step * output.width;
  output.data.resize(static_cast<std::size_t>(output.row_step));
  output.is_bigendian = false;
  output.is_dense = false;
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    unsigned char* to = output.data.data() + i * output.point_step;
    write_number(to, float32, input.points[i].x);
    write_number(to + 4, float32, input.points[i].y);
    write_number(to + 8, float32, input.points[i].z);
    for (std::size_t k = 0; k < input.channels.size(); ++k) {
      if (input.channels[k].values.size() == input.points.size()) {
        write_number(to + 12 + 4 * k, float32, input.channels[k].values[i]);
      }
    }
  }
  return true;
}

template <class Cloud2>
int field_index(const Cloud2& cloud, const std::string& name) {
  for (std::size_t i = 0; i < cloud.fields.size(); ++i) {
    if (cloud.fields[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

template <class Cloud2, class Cloud>
bool from_cloud2(const Cloud2& input, Cloud& output) {
  output.header = input.header;
  const std::size_t count = static_cast<std::size_t>(input.width) * input.height;
  const int x = field_index(input, "x");
  const int y = field_index(input, "y");
  const int z = field_index(input, "z");
  if (x < 0 || y < 0 || z < 0) return false;
  output.points.resize(count);
  output.channels.clear();
  std::vector<int> others;
  for (int i = 0; i < static_cast<int>(input.fields.size()); ++i) {
    if (i != x && i != y && i != z) {
      others.push_back(i);
      output.channels.emplace_back();
      output.channels.back().name = input.fields[static_cast<std::size_t>(i)].name;
      output.channels.back().values.resize(count);
    }
  }
  const auto value = [&input](const unsigned char* point, int index) {
    const auto& field = input.fields[static_cast<std::size_t>(index)];
    return read_number<float>(point + field.offset, field.datatype);
  };
  for (std::uint32_t row = 0; row < input.height; ++row) {
    for (std::uint32_t column = 0; column < input.width; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * input.width + column;
      const unsigned char* point = input.data.data() +
                                   static_cast<std::size_t>(row) * input.row_step +
                                   static_cast<std::size_t>(column) * input.point_step;
      output.points[i].x = value(point, x);
      output.points[i].y = value(point, y);
      output.points[i].z = value(point, z);
      for (std::size_t k = 0; k < others.size(); ++k) {
        output.channels[k].values[i] = value(point, others[k]);
      }
    }
  }
  return true;
}

template <class Image>
bool fill_image(Image& image, const std::string& encoding, std::uint32_t rows,
                std::uint32_t columns, std::uint32_t step, const void* data) {
  image.encoding = encoding;
  image.height = rows;
  image.width = columns;
  image.step = step;
  const auto* start = static_cast<const unsigned char*>(data);
  image.data.assign(start, start + static_cast<std::size_t>(step) * rows);
  image.is_bigendian = 0;
  return true;
}

}  // namespace clouds
}  // namespace gazelle
