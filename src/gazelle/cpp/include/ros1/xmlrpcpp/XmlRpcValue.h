#pragma once

#include <ros/macros.h>

#include <cstdint>
#include <ctime>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "xmlrpcpp/XmlRpcException.h"

namespace XmlRpc {

/// A value as the parameter server stores it.
class XMLRPCPP_DECL XmlRpcValue {
 public:
  enum Type {
    TypeInvalid,
    TypeBoolean,
    TypeInt,
    TypeDouble,
    TypeString,
    TypeDateTime,
    TypeBase64,
    TypeArray,
    TypeStruct
  };
  typedef std::vector<char> BinaryData;
  typedef std::vector<XmlRpcValue> ValueArray;
  typedef std::map<std::string, XmlRpcValue> ValueStruct;
  typedef ValueStruct::iterator iterator;
  typedef ValueStruct::const_iterator const_iterator;

  XmlRpcValue() : _type(TypeInvalid) { _value.asBinary = 0; }
  XmlRpcValue(bool value) : _type(TypeBoolean) { _value.asBool = value; }
  XmlRpcValue(int value) : _type(TypeInt) { _value.asInt = value; }
  XmlRpcValue(double value) : _type(TypeDouble) { _value.asDouble = value; }
  XmlRpcValue(const std::string& value) : _type(TypeString) {
    _value.asString = new std::string(value);
  }
  XmlRpcValue(const char* value) : _type(TypeString) { _value.asString = new std::string(value); }
  XmlRpcValue(struct tm* value) : _type(TypeDateTime) { _value.asTime = new struct tm(*value); }
  XmlRpcValue(void* value, int size) : _type(TypeBase64) {
    _value.asBinary = new BinaryData(static_cast<char*>(value), static_cast<char*>(value) + size);
  }
  /// From XML, `<value>…</value>`; invalid where it is none.
  XmlRpcValue(const std::string& xml, int* offset) : _type(TypeInvalid) {
    _value.asBinary = 0;
    if (!fromXml(xml, offset)) _type = TypeInvalid;
  }
  XmlRpcValue(const XmlRpcValue& other) : _type(TypeInvalid) {
    _value.asBinary = 0;
    *this = other;
  }
  ~XmlRpcValue() { invalidate(); }

  void clear() { invalidate(); }
  XmlRpcValue& operator=(const XmlRpcValue& other);
  XmlRpcValue& operator=(const bool& value) { return operator=(XmlRpcValue(value)); }
  XmlRpcValue& operator=(const int& value) { return operator=(XmlRpcValue(value)); }
  XmlRpcValue& operator=(const double& value) { return operator=(XmlRpcValue(value)); }
  XmlRpcValue& operator=(const char* value) { return operator=(XmlRpcValue(value)); }
  XmlRpcValue& operator=(const std::string& value) { return operator=(XmlRpcValue(value)); }

  bool operator==(const XmlRpcValue& other) const;
  bool operator!=(const XmlRpcValue& other) const { return !(*this == other); }

  // Each throws XmlRpcException where the value is of another type; the non-const ones make an
  // invalid value one of theirs.
  operator bool&() { return as(TypeBoolean)._value.asBool; }
  operator const bool&() const { return as(TypeBoolean)._value.asBool; }
  operator int&() { return as(TypeInt)._value.asInt; }
  operator const int&() const { return as(TypeInt)._value.asInt; }
  operator double&() { return as(TypeDouble)._value.asDouble; }
  operator const double&() const { return as(TypeDouble)._value.asDouble; }
  operator std::string&() { return *as(TypeString)._value.asString; }
  operator const std::string&() const { return *as(TypeString)._value.asString; }
  operator BinaryData&() { return *as(TypeBase64)._value.asBinary; }
  operator const BinaryData&() const { return *as(TypeBase64)._value.asBinary; }
  operator struct tm &() { return *as(TypeDateTime)._value.asTime; }
  operator const struct tm &() const { return *as(TypeDateTime)._value.asTime; }

  XmlRpcValue const& operator[](int i) const;
  XmlRpcValue& operator[](int i);
  XmlRpcValue& operator[](const std::string& key) { return (*as(TypeStruct)._value.asStruct)[key]; }
  XmlRpcValue& operator[](const char* key) { return (*this)[std::string(key)]; }
  const XmlRpcValue& operator[](const std::string& key) const;
  const XmlRpcValue& operator[](const char* key) const { return (*this)[std::string(key)]; }

  iterator begin() { return as(TypeStruct)._value.asStruct->begin(); }
  iterator end() { return as(TypeStruct)._value.asStruct->end(); }
  const_iterator begin() const { return as(TypeStruct)._value.asStruct->begin(); }
  const_iterator end() const { return as(TypeStruct)._value.asStruct->end(); }

  bool valid() const { return _type != TypeInvalid; }
  const Type& getType() const { return _type; }
  /// Of a string, an array or a struct.
  int size() const;
  void setSize(int size);
  bool hasMember(const std::string& name) const;

  bool fromXml(const std::string& xml, int* offset);
  std::string toXml() const;
  std::ostream& write(std::ostream& stream) const;

  static const std::string& getDoubleFormat();
  static void setDoubleFormat(const char* format);

 protected:
  void invalidate();
  XmlRpcValue& as(Type type);
  const XmlRpcValue& as(Type type) const;

  Type _type;
  union {
    bool asBool;
    int asInt;
    double asDouble;
    struct tm* asTime;
    std::string* asString;
    BinaryData* asBinary;
    ValueArray* asArray;
    ValueStruct* asStruct;
  } _value;
};

XMLRPCPP_DECL std::ostream& operator<<(std::ostream& stream, const XmlRpcValue& value);

}  // namespace XmlRpc
