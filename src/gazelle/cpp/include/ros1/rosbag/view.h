#pragma once

#include <rosbag/macros.h>
#include <rosbag/message_instance.h>
#include <rosbag/query.h>
#include <rosbag/structures.h>

#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>
#include <cstddef>
#include <iterator>
#include <vector>

namespace rosbag {

/// Messages of one bag or several, in the order of their times.
class ROSBAG_STORAGE_DECL View {
 public:
  typedef boost::function<bool(ConnectionInfo const*)> Query;

  class iterator {
   public:
    typedef std::forward_iterator_tag iterator_category;
    typedef MessageInstance value_type;
    typedef std::ptrdiff_t difference_type;
    typedef MessageInstance const* pointer;
    typedef MessageInstance const& reference;

    iterator() : view_(0), place_(0) {}
    reference operator*() const { return view_->at(place_); }
    pointer operator->() const { return &view_->at(place_); }
    iterator& operator++() {
      ++place_;
      return *this;
    }
    iterator operator++(int) {
      iterator before = *this;
      ++place_;
      return before;
    }
    bool operator==(iterator const& other) const { return place_ == other.place_; }
    bool operator!=(iterator const& other) const { return place_ != other.place_; }

   private:
    friend class View;
    iterator(View* view, std::size_t place) : view_(view), place_(place) {}
    View* view_;
    std::size_t place_;
  };
  typedef iterator const_iterator;

  /// `reduce_overlap`: a message that several queries find is there once.
  View(bool const& reduce_overlap = false) : reduce_overlap_(reduce_overlap) {}
  View(Bag const& bag, ros::Time const& start_time = ros::TIME_MIN,
       ros::Time const& end_time = ros::TIME_MAX, bool const& reduce_overlap = false)
      : reduce_overlap_(reduce_overlap) {
    addQuery(bag, start_time, end_time);
  }
  View(Bag const& bag, Query query, ros::Time const& start_time = ros::TIME_MIN,
       ros::Time const& end_time = ros::TIME_MAX, bool const& reduce_overlap = false)
      : reduce_overlap_(reduce_overlap) {
    addQuery(bag, query, start_time, end_time);
  }

  iterator begin() { return iterator(this, 0); }
  iterator end() { return iterator(this, messages_.size()); }
  uint32_t size() const { return static_cast<uint32_t>(messages_.size()); }
  void addQuery(Bag const& bag, ros::Time const& start_time = ros::TIME_MIN,
                ros::Time const& end_time = ros::TIME_MAX);
  void addQuery(Bag const& bag, Query query, ros::Time const& start_time = ros::TIME_MIN,
                ros::Time const& end_time = ros::TIME_MAX);
  std::vector<ConnectionInfo const*> getConnections();
  ros::Time getBeginTime();
  ros::Time getEndTime();

 private:
  MessageInstance const& at(std::size_t place) const { return messages_[place]; }

  bool reduce_overlap_;
  std::vector<MessageInstance> messages_;
};

}  // namespace rosbag
