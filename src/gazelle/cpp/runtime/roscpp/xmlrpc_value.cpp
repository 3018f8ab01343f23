// Values of the parameter server.

#include "xmlrpcpp/XmlRpcValue.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ostream>
#include <sstream>

namespace XmlRpc {

namespace {

const char* nameOf(XmlRpcValue::Type type) {
  switch (type) {
    case XmlRpcValue::TypeBoolean:
      return "Boolean";
    case XmlRpcValue::TypeInt:
      return "Int";
    case XmlRpcValue::TypeDouble:
      return "Double";
    case XmlRpcValue::TypeString:
      return "String";
    case XmlRpcValue::TypeDateTime:
      return "DateTime";
    case XmlRpcValue::TypeBase64:
      return "Base64";
    case XmlRpcValue::TypeArray:
      return "Array";
    case XmlRpcValue::TypeStruct:
      return "Struct";
    case XmlRpcValue::TypeInvalid:
      break;
  }
  return "Invalid";
}

std::string& doubleFormat() {
  static std::string format = "%.17g";
  return format;
}

std::string textOf(double value) {
  const std::string& format = doubleFormat();
  char text[64];
  std::snprintf(text, sizeof text, format.c_str(), value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '\'')
      out += "&apos;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

const char kBase64[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string base64Of(const std::vector<char>& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<uint8_t>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      out += i + j <= bytes.size() ? kBase64[group >> (18 - 6 * j) & 63] : '=';
  }
  return out;
}

std::vector<char> fromBase64(const std::string& text) {
  std::vector<char> bytes;
  uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    const char* found = c ? std::strchr(kBase64, c) : nullptr;
    if (!found) continue;
    group = group << 6 | static_cast<uint32_t>(found - kBase64);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<char>(group >> bits & 255));
    }
  }
  return bytes;
}

// Reads the XML of a value: what XML-RPC has, no more.
class Reader {
 public:
  Reader(const std::string& xml, std::size_t at) : xml_(xml), at_(at) {}
  std::size_t at() const { return at_; }

  bool read(XmlRpcValue& value) {
    skip();
    if (take("<value/>")) {
      value = std::string();
      return true;
    }
    if (!take("<value>")) return false;
    const std::size_t begin = at_;
    skip();
    bool is_read = true;
    if (take("<boolean>")) {
      value = untilTag() == "1";
    } else if (take("<i4>") || take("<int>")) {
      value = static_cast<int>(std::strtol(untilTag().c_str(), nullptr, 10));
    } else if (take("<double>")) {
      value = std::strtod(untilTag().c_str(), nullptr);
    } else if (take("<string/>")) {
      value = std::string();
      return take("</value>");
    } else if (take("<string>")) {
      value = unescaped(untilTag());
    } else if (take("<base64>")) {
      std::vector<char> bytes = fromBase64(untilTag());
      value = XmlRpcValue(bytes.data(), static_cast<int>(bytes.size()));
    } else if (take("<array>")) {
      is_read = readArray(value);
    } else if (take("<struct>")) {
      is_read = readStruct(value);
    } else {
      at_ = begin;
      const std::size_t end = xml_.find("</value>", at_);
      if (end == std::string::npos) return false;
      value = unescaped(xml_.substr(at_, end - at_));
      at_ = end;
      return take("</value>");
    }
    if (!is_read || !closeTag()) return false;
    skip();
    return take("</value>");
  }

 private:
  void skip() {
    while (at_ < xml_.size() && std::strchr(" \t\r\n", xml_[at_])) ++at_;
  }
  bool take(const char* tag) {
    const std::size_t size = std::strlen(tag);
    if (xml_.compare(at_, size, tag) != 0) return false;
    at_ += size;
    return true;
  }
  std::string untilTag() {
    const std::size_t end = xml_.find('<', at_);
    const std::string text = xml_.substr(at_, end == std::string::npos ? end : end - at_);
    at_ = end == std::string::npos ? xml_.size() : end;
    return text;
  }
  bool closeTag() {
    skip();
    if (xml_.compare(at_, 2, "</") != 0) return false;
    const std::size_t end = xml_.find('>', at_);
    if (end == std::string::npos) return false;
    at_ = end + 1;
    return true;
  }
  bool readArray(XmlRpcValue& value) {
    value.clear();
    value.setSize(0);
    skip();
    if (take("<data/>")) return true;
    if (!take("<data>")) return false;
    for (int i = 0;; ++i) {
      skip();
      if (take("</data>")) return true;
      XmlRpcValue item;
      if (!read(item)) return false;
      value[i] = item;
    }
  }
  bool readStruct(XmlRpcValue& value) {
    value.clear();
    value.begin();
    for (;;) {
      skip();
      if (!take("<member>")) return true;
      skip();
      if (!take("<name>")) return false;
      const std::string name = unescaped(untilTag());
      if (!closeTag() || !read(value[name])) return false;
      skip();
      if (!take("</member>")) return false;
    }
  }
  static std::string unescaped(const std::string& text) {
    static const std::pair<const char*, char> kEntities[] = {
        {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&apos;", '\''}, {"&quot;", '"'}};
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
      bool is_entity = false;
      for (const auto& entity : kEntities) {
        const std::size_t size = std::strlen(entity.first);
        if (text.compare(i, size, entity.first) == 0) {
          out += entity.second;
          i += size;
          is_entity = true;
          break;
        }
      }
      if (!is_entity) out += text[i++];
    }
    return out;
  }

  const std::string& xml_;
  std::size_t at_;
};

}  // namespace

void XmlRpcValue::invalidate() {
  switch (_type) {
    case TypeString:
      delete _value.asString;
      break;
    case TypeDateTime:
      delete _value.asTime;
      break;
    case TypeBase64:
      delete _value.asBinary;
      break;
    case TypeArray:
      delete _value.asArray;
      break;
    case TypeStruct:
      delete _value.asStruct;
      break;
    default:
      break;
  }
  _type = TypeInvalid;
  _value.asBinary = nullptr;
}

XmlRpcValue& XmlRpcValue::operator=(const XmlRpcValue& other) {
  if (this == &other) return *this;
  // Made before the old one goes, which may hold the other.
  auto made = other._value;
  switch (other._type) {
    case TypeString:
      made.asString = new std::string(*other._value.asString);
      break;
    case TypeDateTime:
      made.asTime = new struct tm(*other._value.asTime);
      break;
    case TypeBase64:
      made.asBinary = new BinaryData(*other._value.asBinary);
      break;
    case TypeArray:
      made.asArray = new ValueArray(*other._value.asArray);
      break;
    case TypeStruct:
      made.asStruct = new ValueStruct(*other._value.asStruct);
      break;
    default:
      break;
  }
  const Type type = other._type;
  invalidate();
  _type = type;
  _value = made;
  return *this;
}

bool XmlRpcValue::operator==(const XmlRpcValue& other) const {
  if (_type != other._type) return false;
  switch (_type) {
    case TypeBoolean:
      return _value.asBool == other._value.asBool;
    case TypeInt:
      return _value.asInt == other._value.asInt;
    case TypeDouble:
      return _value.asDouble == other._value.asDouble;
    case TypeString:
      return *_value.asString == *other._value.asString;
    case TypeDateTime:
      return std::memcmp(_value.asTime, other._value.asTime, sizeof(struct tm)) == 0;
    case TypeBase64:
      return *_value.asBinary == *other._value.asBinary;
    case TypeArray:
      return *_value.asArray == *other._value.asArray;
    case TypeStruct:
      return *_value.asStruct == *other._value.asStruct;
    case TypeInvalid:
      break;
  }
  return true;
}

XmlRpcValue& XmlRpcValue::as(Type type) {
  if (_type == TypeInvalid) {
    switch (type) {
      case TypeString:
        _value.asString = new std::string();
        break;
      case TypeDateTime:
        _value.asTime = new struct tm();
        break;
      case TypeBase64:
        _value.asBinary = new BinaryData();
        break;
      case TypeArray:
        _value.asArray = new ValueArray();
        break;
      case TypeStruct:
        _value.asStruct = new ValueStruct();
        break;
      default:
        _value.asDouble = 0;
        break;
    }
    _type = type;
  }
  static_cast<const XmlRpcValue*>(this)->as(type);
  return *this;
}

const XmlRpcValue& XmlRpcValue::as(Type type) const {
  if (_type != type)
    throw XmlRpcException(std::string("type error: the value is of type ") + nameOf(_type) +
                          ", not " + nameOf(type));
  return *this;
}

XmlRpcValue const& XmlRpcValue::operator[](int i) const {
  const ValueArray& items = *as(TypeArray)._value.asArray;
  if (i < 0 || static_cast<std::size_t>(i) >= items.size())
    throw XmlRpcException("range error: array index too large");
  return items[static_cast<std::size_t>(i)];
}

XmlRpcValue& XmlRpcValue::operator[](int i) {
  ValueArray& items = *as(TypeArray)._value.asArray;
  if (i < 0) throw XmlRpcException("range error: array index is negative");
  if (static_cast<std::size_t>(i) >= items.size()) items.resize(static_cast<std::size_t>(i) + 1);
  return items[static_cast<std::size_t>(i)];
}

const XmlRpcValue& XmlRpcValue::operator[](const std::string& key) const {
  const ValueStruct& members = *as(TypeStruct)._value.asStruct;
  const auto found = members.find(key);
  if (found == members.end()) throw XmlRpcException("there is no member '" + key + "'");
  return found->second;
}

int XmlRpcValue::size() const {
  switch (_type) {
    case TypeString:
      return static_cast<int>(_value.asString->size());
    case TypeBase64:
      return static_cast<int>(_value.asBinary->size());
    case TypeArray:
      return static_cast<int>(_value.asArray->size());
    case TypeStruct:
      return static_cast<int>(_value.asStruct->size());
    default:
      throw XmlRpcException(std::string("type error: a value of type ") + nameOf(_type) +
                            " has no size");
  }
}

void XmlRpcValue::setSize(int size) {
  as(TypeArray)._value.asArray->resize(static_cast<std::size_t>(size));
}

bool XmlRpcValue::hasMember(const std::string& name) const {
  return _type == TypeStruct && _value.asStruct->count(name) != 0;
}

bool XmlRpcValue::fromXml(const std::string& xml, int* offset) {
  invalidate();
  Reader reader(xml, static_cast<std::size_t>(*offset));
  XmlRpcValue read;
  if (!reader.read(read)) return false;
  *this = read;
  *offset = static_cast<int>(reader.at());
  return true;
}

std::string XmlRpcValue::toXml() const {
  std::string inner;
  switch (_type) {
    case TypeBoolean:
      inner = std::string("<boolean>") + (_value.asBool ? "1" : "0") + "</boolean>";
      break;
    case TypeInt:
      inner = "<i4>" + std::to_string(_value.asInt) + "</i4>";
      break;
    case TypeDouble:
      inner = "<double>" + textOf(_value.asDouble) + "</double>";
      break;
    case TypeString:
      inner = escaped(*_value.asString);
      break;
    case TypeDateTime: {
      char text[32];
      const struct tm& t = *_value.asTime;
      std::snprintf(text, sizeof text, "%4d%02d%02dT%02d:%02d:%02d", t.tm_year, t.tm_mon, t.tm_mday,
                    t.tm_hour, t.tm_min, t.tm_sec);
      inner = std::string("<dateTime.iso8601>") + text + "</dateTime.iso8601>";
      break;
    }
    case TypeBase64:
      inner = "<base64>" + base64Of(*_value.asBinary) + "</base64>";
      break;
    case TypeArray:
      inner = "<array><data>";
      for (const XmlRpcValue& item : *_value.asArray) inner += item.toXml();
      inner += "</data></array>";
      break;
    case TypeStruct:
      inner = "<struct>";
      for (const auto& member : *_value.asStruct)
        inner += "<member><name>" + escaped(member.first) + "</name>" + member.second.toXml() +
                 "</member>";
      inner += "</struct>";
      break;
    case TypeInvalid:
      return std::string();
  }
  return "<value>" + inner + "</value>";
}

std::ostream& XmlRpcValue::write(std::ostream& stream) const {
  switch (_type) {
    case TypeBoolean:
      return stream << _value.asBool;
    case TypeInt:
      return stream << _value.asInt;
    case TypeDouble:
      return stream << _value.asDouble;
    case TypeString:
      return stream << *_value.asString;
    case TypeDateTime: {
      const struct tm& t = *_value.asTime;
      char text[32];
      std::snprintf(text, sizeof text, "%4d%02d%02dT%02d:%02d:%02d", t.tm_year, t.tm_mon, t.tm_mday,
                    t.tm_hour, t.tm_min, t.tm_sec);
      return stream << text;
    }
    case TypeBase64:
      return stream << base64Of(*_value.asBinary);
    case TypeArray: {
      stream << '{';
      const char* separator = "";
      for (const XmlRpcValue& item : *_value.asArray) {
        stream << separator;
        item.write(stream);
        separator = ",";
      }
      return stream << '}';
    }
    case TypeStruct: {
      stream << '[';
      const char* separator = "";
      for (const auto& member : *_value.asStruct) {
        stream << separator << member.first << ':';
        member.second.write(stream);
        separator = ",";
      }
      return stream << ']';
    }
    case TypeInvalid:
      break;
  }
  return stream;
}

const std::string& XmlRpcValue::getDoubleFormat() { return doubleFormat(); }
void XmlRpcValue::setDoubleFormat(const char* format) { doubleFormat() = format; }

std::ostream& operator<<(std::ostream& stream, const XmlRpcValue& value) {
  return value.write(stream);
}

}  // namespace XmlRpc
