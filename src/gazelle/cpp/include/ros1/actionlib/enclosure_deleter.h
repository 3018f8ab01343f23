#pragma once

#include <boost/shared_ptr.hpp>

namespace actionlib {

/// Keeps a message for as long as a part of it is used.
template <class Enclosure>
class EnclosureDeleter {
 public:
  EnclosureDeleter(const boost::shared_ptr<Enclosure>& enclosure) : enclosure_(enclosure) {}
  template <class Member>
  void operator()(Member*) {
    enclosure_.reset();
  }

 private:
  boost::shared_ptr<Enclosure> enclosure_;
};

template <class Enclosure, class Member>
boost::shared_ptr<Member> share_member(boost::shared_ptr<Enclosure> enclosure, Member& member) {
  return boost::shared_ptr<Member>(enclosure, &member);
}

}  // namespace actionlib
