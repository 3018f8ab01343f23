#pragma once

#include <cstddef>
#include <functional>
#include <tuple>
#include <type_traits>

namespace rclcpp {
namespace function_traits {

/// What a callable takes and returns.
template <typename FunctionT>
struct function_traits
    : function_traits<decltype(&std::remove_reference_t<FunctionT>::operator())> {};

#define GAZELLE_RCLCPP_TRAITS                                              \
  {                                                                        \
    using arguments = std::tuple<Args...>;                                 \
    static constexpr std::size_t arity = sizeof...(Args);                  \
    template <std::size_t N>                                               \
    using argument_type = typename std::tuple_element<N, arguments>::type; \
    using return_type = ReturnT;                                           \
  }
template <typename ReturnT, typename... Args>
struct function_traits<ReturnT(Args...)> GAZELLE_RCLCPP_TRAITS;
template <typename ReturnT, typename... Args>
struct function_traits<ReturnT (*)(Args...)> GAZELLE_RCLCPP_TRAITS;
template <typename ReturnT, typename... Args>
struct function_traits<ReturnT (&)(Args...)> GAZELLE_RCLCPP_TRAITS;
template <typename ClassT, typename ReturnT, typename... Args>
struct function_traits<ReturnT (ClassT::*)(Args...)> GAZELLE_RCLCPP_TRAITS;
template <typename ClassT, typename ReturnT, typename... Args>
struct function_traits<ReturnT (ClassT::*)(Args...) const> GAZELLE_RCLCPP_TRAITS;
#undef GAZELLE_RCLCPP_TRAITS

template <std::size_t Arity, typename FunctorT>
struct arity_comparator
    : std::bool_constant<Arity == function_traits<std::decay_t<FunctorT>>::arity> {};

}  // namespace function_traits
}  // namespace rclcpp
