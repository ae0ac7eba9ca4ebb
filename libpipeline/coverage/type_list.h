#pragma once

#include <variant>

namespace pipeline {

/// A type as a value.
template <typename T>
struct TypeValue {
  friend bool operator==(const TypeValue&, const TypeValue&) = default;
};

/// A list of types from which one is chosen at run time: coverage rules, depth formats.
template <typename... Types>
struct TypeList {
  /// One of the types, the first by default. std::visit hands a visitor its TypeValue, so that code is
  /// compiled for every type of the list and run for the chosen one.
  using Choice = std::variant<TypeValue<Types>...>;
  using Object = std::variant<Types...>;

  /// An object of the chosen type.
  static Object made(const Choice& choice, const auto& argument) {
    return std::visit([&]<typename T>(TypeValue<T>) -> Object { return T(argument); }, choice);
  }
};

}  // namespace pipeline
