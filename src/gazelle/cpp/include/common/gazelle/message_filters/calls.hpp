// How callbacks of users are called with messages: by pointers, references, events, or as bound
// functions that take what they need of the front.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <gazelle/message_filters/connection.hpp>
#include <message_filters/platform.hpp>

namespace message_filters {

// What fills the places of topics that a synchronizer does not have.
struct NullType {};
using NullTypeConstPtr = platform::Ptr<const NullType>;

template <class M>
struct NullFilter {
  template <typename C>
  Connection registerCallback(const C&) {
    return Connection();
  }
  template <typename P>
  Connection registerCallback(const std::function<void(P)>&) {
    return Connection();
  }
};

namespace detail {

// Callbacks that are called in the order in which they came; calling holds no lock, so that one may
// take itself out, and what it was bound to may end.
template <class Call>
class CallList {
 public:
  Connection add(Call call) {
    auto kept = std::make_shared<Call>(std::move(call));
    {
      const std::lock_guard<std::mutex> lock(state_->mutex);
      state_->calls.push_back(kept);
    }
    std::weak_ptr<State> weak = state_;
    return Connection([weak, kept] {
      if (const auto state = weak.lock()) {
        const std::lock_guard<std::mutex> lock(state->mutex);
        auto& calls = state->calls;
        for (auto call = calls.begin(); call != calls.end(); ++call) {
          if (*call == kept) {
            calls.erase(call);
            return;
          }
        }
      }
    });
  }
  template <class... A>
  void call(const A&... arguments) const {
    std::vector<std::shared_ptr<Call>> calls;
    {
      const std::lock_guard<std::mutex> lock(state_->mutex);
      calls = state_->calls;
    }
    for (const auto& call : calls) (*call)(arguments...);
  }

 private:
  struct State {
    std::mutex mutex;
    std::vector<std::shared_ptr<Call>> calls;
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

// A callback of known parameters, which takes as many events as it has.
template <class... P>
struct Typed {
  template <class F, class Events>
  static auto bound(F function) {
    return [function](const Events& events) mutable {
      call(function, events, std::index_sequence_for<P...>{});
    };
  }

 private:
  template <class F, class Events, std::size_t... I>
  static void call(F& function, const Events& events, std::index_sequence<I...>) {
    function(platform::Adapter<P>::getParameter(std::get<I>(events))...);
  }
};

template <class Event>
auto pointer_of(const Event& event) {
  return event.getConstMessage();
}

// A callable whose parameters only trying shows: the first messages as pointers, as references or
// as events, or all places of a synchronizer (bound functions leave out what they do not need).
template <std::size_t Count>
struct Untyped {
  template <class F, class Events>
  static auto bound(F function) {
    return [function](const Events& events) mutable {
      call(function, events, std::make_index_sequence<Count>{},
           std::make_index_sequence<std::tuple_size_v<Events>>{});
    };
  }

 private:
  template <class F, class Events, std::size_t... I, std::size_t... All>
  static void call(F& function, const Events& events, std::index_sequence<I...>,
                   std::index_sequence<All...>) {
    if constexpr (std::is_invocable_v<F&, decltype(pointer_of(std::get<I>(events)))...>) {
      function(pointer_of(std::get<I>(events))...);
    } else if constexpr (std::is_invocable_v<F&, decltype(*pointer_of(std::get<I>(events)))...>) {
      function(*pointer_of(std::get<I>(events))...);
    } else if constexpr (std::is_invocable_v<F&, decltype(std::get<I>(events))...>) {
      function(std::get<I>(events)...);
    } else {
      function(pointer_of(std::get<All>(events))...);
    }
  }
};

// registerCallback() in all its forms, over a list of calls with a tuple of events.
template <class Events, std::size_t Count>
class Registers {
 public:
  template <class C, class = std::enable_if_t<!std::is_function_v<C>>>
  Connection registerCallback(const C& callback) {
    return add(Untyped<Count>::template bound<C, Events>(callback));
  }
  template <class R, class... P>
  Connection registerCallback(const std::function<R(P...)>& callback) {
    return add(Typed<P...>::template bound<std::function<R(P...)>, Events>(callback));
  }
  template <class R, class... P>
  Connection registerCallback(R (*callback)(P...)) {
    return add(Typed<P...>::template bound<R (*)(P...), Events>(callback));
  }
  template <class R, class T, class U, class... P>
  Connection registerCallback(R (T::*method)(P...), U* object) {
    return of_method<P...>(
        [method, object](auto&&... a) { (object->*method)(std::forward<decltype(a)>(a)...); });
  }
  template <class R, class T, class U, class... P>
  Connection registerCallback(R (T::*method)(P...) const, U* object) {
    return of_method<P...>(
        [method, object](auto&&... a) { (object->*method)(std::forward<decltype(a)>(a)...); });
  }
#ifdef GAZELLE_MESSAGE_FILTERS_BOOST
  template <class R, class... P>
  Connection registerCallback(const boost::function<R(P...)>& callback) {
    return add(Typed<P...>::template bound<boost::function<R(P...)>, Events>(callback));
  }
#endif

 protected:
  void tell(const Events& events) const { calls_.call(events); }

 private:
  template <class... P, class F>
  Connection of_method(F function) {
    return add(Typed<P...>::template bound<F, Events>(std::move(function)));
  }
  Connection add(std::function<void(const Events&)> call) { return calls_.add(std::move(call)); }

  CallList<std::function<void(const Events&)>> calls_;
};

}  // namespace detail
}  // namespace message_filters
