#pragma once
// What messages of old packages derive from.

#include <ros/macros.h>

#include <boost/shared_ptr.hpp>
#include <map>
#include <string>

namespace ros {

class Message {
 public:
  typedef boost::shared_ptr<Message> Ptr;
  typedef boost::shared_ptr<Message const> ConstPtr;
  Message() {}
  virtual ~Message() {}
};
typedef boost::shared_ptr<Message> MessagePtr;
typedef boost::shared_ptr<Message const> MessageConstPtr;

}  // namespace ros
