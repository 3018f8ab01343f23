// Filters with one output: the base of all, and those that need no node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

#include <gazelle/message_filters/calls.hpp>

namespace message_filters {

// What tells messages to whoever registered.
template <class M>
class SimpleFilter : public detail::Registers<std::tuple<platform::Event<M const>>, 1> {
 public:
  using MConstPtr = platform::Ptr<M const>;
  using EventType = platform::Event<M const>;
  using Callback = platform::Function<void(const MConstPtr&)>;
  using EventCallback = platform::Function<void(const EventType&)>;

  void setName(const std::string& name) { name_ = name; }
  const std::string& getName() { return name_; }

 protected:
  void signalMessage(const MConstPtr& message) { signalMessage(EventType(message)); }
  void signalMessage(const EventType& event) { this->tell(std::tuple<EventType>(event)); }

 private:
  std::string name_;
};

// Connects a filter's output to a function of events.
template <class M, class F, class Function>
Connection connect_events(F& filter, Function function) {
  return filter.registerCallback(
      platform::Function<void(const platform::Event<M const>&)>(std::move(function)));
}

// Tells on what it is told.
template <typename M>
class PassThrough : public SimpleFilter<M> {
 public:
  using MConstPtr = platform::Ptr<M const>;
  using EventType = platform::Event<M const>;

  PassThrough() = default;
  template <typename F>
  explicit PassThrough(F& filter) {
    connectInput(filter);
  }
  ~PassThrough() { incoming_.disconnect(); }
  template <class F>
  void connectInput(F& filter) {
    incoming_.disconnect();
    incoming_ = connect_events<M>(filter, [this](const EventType& event) { add(event); });
  }
  void add(const MConstPtr& message) { this->signalMessage(message); }
  void add(const EventType& event) { this->signalMessage(event); }

 private:
  Connection incoming_;
};

// The last messages, in the order of their stamps.
template <class M>
class Cache : public SimpleFilter<M> {
 public:
  using MConstPtr = platform::Ptr<M const>;
  using EventType = platform::Event<M const>;
  using Time = platform::Time;

  template <class F>
  explicit Cache(F& filter, unsigned int cache_size = 1) : cache_size_(cache_size) {
    connectInput(filter);
  }
  explicit Cache(unsigned int cache_size = 1) : cache_size_(cache_size) {}
  ~Cache() { incoming_.disconnect(); }

  template <class F>
  void connectInput(F& filter) {
    incoming_.disconnect();
    incoming_ = connect_events<M>(filter, [this](const EventType& event) { add(event); });
  }
  void setCacheSize(unsigned int cache_size) { cache_size_ = cache_size; }

  void add(const MConstPtr& message) { add(EventType(message)); }
  void add(const EventType& event) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      while (!kept_.empty() && kept_.size() >= cache_size_) kept_.pop_front();
      const std::int64_t stamp_ns = stamp_of(event);
      auto place = kept_.end();
      while (place != kept_.begin() && stamp_of(*(place - 1)) > stamp_ns) --place;
      kept_.insert(place, event);
    }
    this->signalMessage(event);
  }

  std::vector<MConstPtr> getInterval(const Time& start, const Time& end) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<MConstPtr> found;
    for (const EventType& event : kept_) {
      const std::int64_t stamp_ns = stamp_of(event);
      if (stamp_ns >= platform::ns_of(start) && stamp_ns <= platform::ns_of(end))
        found.push_back(event.getConstMessage());
    }
    return found;
  }
  // Those of the interval, with the last before and the first after it.
  std::vector<MConstPtr> getSurroundingInterval(const Time& start, const Time& end) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<MConstPtr> found;
    if (kept_.empty()) return found;
    std::size_t first = kept_.size() - 1;
    while (first > 0 && stamp_of(kept_[first]) > platform::ns_of(start)) --first;
    std::size_t last = first;
    while (last < kept_.size() - 1 && stamp_of(kept_[last]) < platform::ns_of(end)) ++last;
    for (std::size_t i = first; i <= last; ++i) found.push_back(kept_[i].getConstMessage());
    return found;
  }
  MConstPtr getElemBeforeTime(const Time& time) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    MConstPtr found;
    for (const EventType& event : kept_)
      if (stamp_of(event) < platform::ns_of(time)) found = event.getConstMessage();
    return found;
  }
  MConstPtr getElemAfterTime(const Time& time) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const EventType& event : kept_)
      if (stamp_of(event) > platform::ns_of(time)) return event.getConstMessage();
    return MConstPtr();
  }
  Time getLatestTime() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return kept_.empty() ? Time() : platform::stamp(*kept_.back().getConstMessage());
  }
  Time getOldestTime() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return kept_.empty() ? Time() : platform::stamp(*kept_.front().getConstMessage());
  }

 private:
  static std::int64_t stamp_of(const EventType& event) {
    return platform::ns_of(platform::stamp(*event.getConstMessage()));
  }

  mutable std::mutex mutex_;
  std::deque<EventType> kept_;
  unsigned int cache_size_;
  Connection incoming_;
};

// Filters one behind the other, made at run time.
template <typename M>
class Chain : public SimpleFilter<M> {
 public:
  using MConstPtr = platform::Ptr<M const>;
  using EventType = platform::Event<M const>;

  Chain() = default;
  template <typename F>
  explicit Chain(F& filter) {
    connectInput(filter);
  }
  ~Chain() {
    incoming_.disconnect();
    last_.disconnect();
  }

  struct NullDeleter {
    void operator()(void const*) const {}
  };

  template <class F>
  std::size_t addFilter(F* filter) {
    return addFilter(platform::Ptr<F>(filter, NullDeleter()));
  }
  template <class F>
  std::size_t addFilter(const platform::Ptr<F>& filter) {
    last_.disconnect();
    last_ = connect_events<M>(*filter, [this](const EventType& event) { lastFilterCB(event); });
    if (!filters_.empty()) filters_.back().connect(*filter);
    filters_.push_back(Link{filter,
                            filter.get(),
                            [filter](const EventType& event) { filter->add(event); },
                            [filter](const std::function<void(const EventType&)>& next) {
                              return connect_events<M>(*filter, next);
                            },
                            {}});
    return filters_.size() - 1;
  }
  template <typename F>
  platform::Ptr<F> getFilter(std::size_t index) const {
    if (index >= filters_.size()) return platform::Ptr<F>();
    return platform::static_pointer_cast<F>(filters_[index].kept);
  }
  template <class F>
  void connectInput(F& filter) {
    incoming_.disconnect();
    incoming_ = connect_events<M>(filter, [this](const EventType& event) { add(event); });
  }
  void add(const MConstPtr& message) { add(EventType(message)); }
  void add(const EventType& event) {
    if (!filters_.empty()) filters_.front().add(event);
  }

 private:
  struct Link {
    platform::Ptr<void> kept;
    void* raw;
    std::function<void(const EventType&)> add;
    std::function<Connection(const std::function<void(const EventType&)>&)> listen;
    Connection to_next;
    template <class F>
    void connect(F& next) {
      to_next = listen([&next](const EventType& event) { next.add(event); });
    }
  };
  void lastFilterCB(const EventType& event) { this->signalMessage(event); }

  std::vector<Link> filters_;
  Connection incoming_, last_;
};

}  // namespace message_filters
