#pragma once

#include <variant>

namespace pipeline {

/// Types of which one is chosen at run time: coverage rules, depth formats.
template <typename... Types>
struct TypeList {};

/// A type as a value.
template <typename T>
struct TypeValue {
  friend bool operator==(const TypeValue&, const TypeValue&) = default;
};

/// One type of a TypeList, the first by default. std::visit hands a visitor its TypeValue, so that code can
/// be compiled for every type of the list and run for the one chosen.
template <typename List>
struct TypeChoiceOf;
template <typename... Types>
struct TypeChoiceOf<TypeList<Types...>> {
  using Choice = std::variant<TypeValue<Types>...>;
  using Any = std::variant<Types...>;
};
template <typename List>
using TypeChoice = typename TypeChoiceOf<List>::Choice;

/// An object of one type of a TypeList.
template <typename List>
using AnyOf = typename TypeChoiceOf<List>::Any;

}  // namespace pipeline
