// What a callback's parameter is made from: the message, a pointer to it, or an event of it.
#pragma once

#include <message_filters/message_event.hpp>

#include <memory>
#include <type_traits>

namespace message_filters {

namespace detail {
template <typename M, typename P, bool Const>
struct AdapterBase {
  using Message = std::remove_const_t<M>;
  using Event = MessageEvent<Message const>;
  using Parameter = P;
  static constexpr bool is_const = Const;
};
}  // namespace detail

template <typename M>
struct ParameterAdapter
    : detail::AdapterBase<std::remove_const_t<std::remove_reference_t<M>>, M, true> {
  using Base = detail::AdapterBase<std::remove_const_t<std::remove_reference_t<M>>, M, true>;
  static typename Base::Parameter getParameter(const typename Base::Event& event) {
    return *event.getMessage();
  }
};

#define GAZELLE_CONST_POINTER(P)                                                        \
  template <typename M>                                                                 \
  struct ParameterAdapter<P> : detail::AdapterBase<M, std::shared_ptr<M const>, true> { \
    static std::shared_ptr<M const> getParameter(const MessageEvent<M const>& event) {  \
      return event.getMessage();                                                        \
    }                                                                                   \
  };
#define GAZELLE_POINTER(P)                                                         \
  template <typename M>                                                            \
  struct ParameterAdapter<P> : detail::AdapterBase<M, std::shared_ptr<M>, false> { \
    static std::shared_ptr<M> getParameter(const MessageEvent<M const>& event) {   \
      return MessageEvent<M>(event).getMessage();                                  \
    }                                                                              \
  };
GAZELLE_CONST_POINTER(std::shared_ptr<M const>)
GAZELLE_CONST_POINTER(const std::shared_ptr<M const>)
GAZELLE_CONST_POINTER(const std::shared_ptr<M const>&)
GAZELLE_POINTER(std::shared_ptr<M>)
GAZELLE_POINTER(const std::shared_ptr<M>&)
#undef GAZELLE_CONST_POINTER
#undef GAZELLE_POINTER

template <typename M>
struct ParameterAdapter<const MessageEvent<M const>&>
    : detail::AdapterBase<M, const MessageEvent<M const>&, true> {
  static const MessageEvent<M const>& getParameter(const MessageEvent<M const>& event) {
    return event;
  }
};
template <typename M>
struct ParameterAdapter<MessageEvent<M const>>
    : detail::AdapterBase<M, MessageEvent<M const>, true> {
  static MessageEvent<M const> getParameter(const MessageEvent<M const>& event) { return event; }
};
template <typename M>
struct ParameterAdapter<const MessageEvent<M>&> : detail::AdapterBase<M, MessageEvent<M>, false> {
  static MessageEvent<M> getParameter(const MessageEvent<M const>& event) {
    return MessageEvent<M>(event);
  }
};
template <typename M>
struct ParameterAdapter<MessageEvent<M>> : detail::AdapterBase<M, MessageEvent<M>, false> {
  static MessageEvent<M> getParameter(const MessageEvent<M const>& event) {
    return MessageEvent<M>(event);
  }
};

}  // namespace message_filters
