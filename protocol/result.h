// Value or error, for code that does not throw. Holds one of the two; reading the wrong one is a programming
// error (checked by assert).
#pragma once

#include <cassert>
#include <type_traits>
#include <utility>
#include <variant>

namespace skyig::protocol {

/// Marks a return value as the error of a Result: `return Error{text};`.
template <class E>
struct Error {
    E value;
};
template <class E>
Error(E) -> Error<E>;

template <class T, class E>
class [[nodiscard]] Result {
  public:
    Result(T value) noexcept(std::is_nothrow_move_constructible_v<T>)
        : state_(std::in_place_index<0>, std::move(value)) {}
    template <class F>
    requires std::is_constructible_v<E, F> Result(Error<F> error)
        : state_(std::in_place_index<1>, std::move(error.value)) {}

    [[nodiscard]] bool has_value() const noexcept { return state_.index() == 0; }
    [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }

    [[nodiscard]] T& value() & noexcept {
        assert(has_value());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] const T& value() const& noexcept {
        assert(has_value());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] T&& value() && noexcept {
        assert(has_value());
        return std::move(*std::get_if<0>(&state_));
    }
    [[nodiscard]] const E& error() const noexcept {
        assert(!has_value());
        return *std::get_if<1>(&state_);
    }

    [[nodiscard]] T& operator*() & noexcept { return value(); }
    [[nodiscard]] const T& operator*() const& noexcept { return value(); }
    [[nodiscard]] T&& operator*() && noexcept { return std::move(*this).value(); }
    [[nodiscard]] T* operator->() noexcept { return &value(); }
    [[nodiscard]] const T* operator->() const noexcept { return &value(); }

  private:
    std::variant<T, E> state_;
};

}  // namespace skyig::protocol
