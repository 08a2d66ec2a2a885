// What this project uses of tl::expected, for builds that find no tl-expected. A program that also
// uses the whole of it must give it to this project, so that both have the same.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>
#include <variant>

namespace tl {

/// The error of an expected.
template <class E>
class unexpected {
 public:
  explicit constexpr unexpected(E error) : error_(std::move(error)) {}

  constexpr const E& value() const& { return error_; }
  constexpr E& value() & { return error_; }
  constexpr E&& value() && { return std::move(error_); }

 private:
  E error_;
};

/// A T or, in place of one, an E. Asking for the one that is not there has no meaning.
template <class T, class E>
class expected {
  static constexpr bool kIsVoid = std::is_void_v<T>;
  using Value = std::conditional_t<kIsVoid, std::monostate, T>;

 public:
  using value_type = T;
  using error_type = E;

  constexpr expected() requires std::is_default_constructible_v<Value>
  = default;
  template <class U = Value>
  requires(!kIsVoid && std::is_convertible_v<U, Value> &&
           !std::is_same_v<std::remove_cvref_t<U>, expected>) constexpr expected(U&& value)
      : either_(std::in_place_index<0>, std::forward<U>(value)) {}
  template <class G>
  requires std::is_convertible_v<G, E>
  constexpr expected(unexpected<G> error)
      : either_(std::in_place_index<1>, std::move(error).value()) {}
  template <class U, class G>
  requires std::is_convertible_v<U, Value> && std::is_convertible_v<G, E>
  constexpr expected(expected<U, G> other)
      : expected(other ? expected(*std::move(other))
                       : expected(unexpected<E>(std::move(other).error()))) {}

  constexpr bool has_value() const { return either_.index() == 0; }
  constexpr explicit operator bool() const { return has_value(); }

  constexpr const Value& operator*() const& { return *std::get_if<0>(&either_); }
  constexpr Value& operator*() & { return *std::get_if<0>(&either_); }
  constexpr Value&& operator*() && { return std::move(**this); }
  constexpr const Value* operator->() const { return std::get_if<0>(&either_); }
  constexpr Value* operator->() { return std::get_if<0>(&either_); }
  constexpr const Value& value() const& { return std::get<0>(either_); }
  constexpr const E& error() const& { return *std::get_if<1>(&either_); }
  constexpr E& error() & { return *std::get_if<1>(&either_); }
  constexpr E&& error() && { return std::move(*std::get_if<1>(&either_)); }

  template <class U>
  constexpr Value value_or(U&& other) const& {
    return has_value() ? **this : static_cast<Value>(std::forward<U>(other));
  }

  /// f(value), or the same error.
  template <class F>
  constexpr auto map(F&& f) && {
    using Result = expected<std::remove_cvref_t<std::invoke_result_t<F, Value&&>>, E>;
    if (!has_value()) return Result(unexpected<E>(std::move(error())));
    return Result(std::invoke(std::forward<F>(f), *std::move(*this)));
  }

 private:
  std::variant<Value, E> either_;
};

}  // namespace tl
