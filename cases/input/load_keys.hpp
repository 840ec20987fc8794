#pragma once
#include <functional>
#include <unordered_set>
#include <variant>

#include "cases/input/key_forms.hpp"
#include "plate/model/loads.hpp"

/// Keys of places of supports, springs and loads: edges by name, and points.
namespace cases {

/// A member of what acts of a load: `member` finds it where the load has it. For a load without it, it is `nothing`,
/// and what is read goes nowhere: its kind is unknown.
template <class U, class Member>
class OfAction {
public:
  OfAction(U nothing, Member member) : nothing_(std::move(nothing)), member_(member) {}

  U& operator()(plate::Load& load) const { return in<U>(load.action); }
  const U& operator()(const plate::Load& load) const { return in<const U>(load.action); }

private:
  template <class V, class Action>
  V& in(Action& action) const {
    static thread_local std::remove_const_t<V> nowhere;
    nowhere = nothing_;
    V* found = &nowhere;
    std::visit(
        [&](auto& one) {
          if constexpr (std::is_invocable_v<Member, decltype(one)>) found = &member_(one);
        },
        action);
    return *found;
  }

  U nothing_;
  Member member_;
};

/// Names of edges: a list that is not empty and names none twice.
template <class T, class Project>
Field<T> edges(const std::string& help, Project project) {
  return value<T>(
      {"edges", "-", "a list of edge names", "", help},
      [=](const Value& given, T& object) {
        const auto names = given.texts();
        if (!names) return;
        if (names->empty()) given.refuse("a list of at least one edge name");
        std::unordered_set<std::string> before;
        for (const auto& name : *names)
          if (!before.insert(name).second) given.report_error(fmt::format("\"{}\" is named twice", name));
        std::invoke(project, object) = *names;
      },
      [=](const T& object) {
        const auto& names = std::invoke(project, object);
        return names.empty() ? "" : text_of(names);
      });
}
template <class T>
Field<T> edges(const std::string& help) {
  return edges<T>(help, &T::edges);
}

/// A list of at least some points.
template <class T, class Project>
Field<T> points(const std::string& name, Project project, std::size_t least, const std::string& help) {
  const auto read = [=](const Value& given, T& object) {
    const auto points = given.points();
    if (points && points->size() < least) given.refuse(fmt::format("a list of {} points or more", least));
    if (points) std::invoke(project, object) = *points;
  };
  const auto text = [=](const T& object) {
    const auto& points = std::invoke(project, object);
    return points.empty() ? "" : text_of(points);
  };
  return value<T>({name, "length", "[[x, y], ...]", "", help}, read, text);
}

}  // namespace cases
