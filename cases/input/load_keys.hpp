#pragma once
#include <unordered_set>

#include "cases/input/key_forms.hpp"

/// Where supports, springs and loads are: edges by name, and points.
namespace cases {

/// Names of edges: a list that is not empty and names none twice.
template <class T>
Field<T> edges(const std::string& help) {
  return value<T>(
      {"edges", "-", "a list of edge names", "", help},
      [](const Value& given, T& object) {
        const auto names = given.texts();
        if (!names) return;
        if (names->empty()) given.refuse("a list of at least one edge name");
        std::unordered_set<std::string> before;
        for (const auto& name : *names)
          if (!before.insert(name).second) given.complain(fmt::format("\"{}\" is named twice", name));
        object.edges = *names;
      },
      [](const T& object) { return object.edges.empty() ? "" : text_of(object.edges); });
}

/// A list of at least some points.
template <class T>
Field<T> points(const std::string& name, std::vector<geometry::Point> T::*member, std::size_t least,
                const std::string& help) {
  const auto read = [=](const Value& given, T& object) {
    const auto points = given.points();
    if (points && points->size() < least) given.refuse(fmt::format("a list of {} points or more", least));
    object.*member = points.value_or(object.*member);
  };
  const auto text = [=](const T& object) { return (object.*member).empty() ? "" : text_of(object.*member); };
  return value<T>({name, "length", "[[x, y], ...]", "", help}, read, text);
}

}  // namespace cases
