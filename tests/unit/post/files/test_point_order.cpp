#include "post/files/point_order.hpp"

#include "tests/catch.hpp"
#include "tests/unit/plate/model/thread_ranks.hpp"
#include "tests/unit/post/files/lattice_in_boxes.hpp"

TEST_CASE("the order of points: any part of it, of any number of processes, is that of one, others get nothing") {
  const auto whole = lattice_in_boxes::own_mesh(0, 1);
  const auto points = whole.positions.size();
  const std::pair<std::size_t, std::size_t> parts[] = {{0, points}, {0, 1}, {points - 1, 1}, {777, 0}, {12345, 40000}};
  for (const int processes : {1, 2, 4, 6}) {
    thread_ranks::run(processes, [&](const plate::Communicator& all) {
      const auto own = lattice_in_boxes::own_mesh(all.rank(), processes);
      const post::PointOrder order(all, own.positions);
      if (order.points() != points) throw std::runtime_error("points are missing");
      for (const auto& [first, count] : parts) {
        const auto found = order.at_first(
            first, count, 2, [&](std::size_t k, double* to) { to[0] = own.positions[k].x(), to[1] = own.areas[k]; });
        if (found.size() != (all.rank() == 0 ? 2 * count : 0)) throw std::runtime_error("not what was asked for");
        for (std::size_t i = 0; i < found.size() / 2; ++i)
          if (found[2 * i] != whole.positions[first + i].x() || found[2 * i + 1] != whole.areas[first + i])
            throw std::runtime_error("a point is out of its place");
      }
    });
  }
}

TEST_CASE("the order of points: a process may have none") {
  thread_ranks::run(3, [&](const plate::Communicator& all) {
    const auto own = all.rank() == 1 ? lattice_in_boxes::own_mesh(0, 1) : post::Mesh{};
    const post::PointOrder order(all, own.positions);
    const auto found = order.at_first(7, 3, 1, [&](std::size_t k, double* to) { *to = own.areas[k]; });
    if (all.rank() == 0 && found != std::vector<double>{8, 9, 10}) throw std::runtime_error("not those points");
  });
}

TEST_CASE("the order of points: by their numbers, where they are in no rows") {
  constexpr std::uint32_t points = 1000;
  for (const int processes : {1, 3, 4})
    thread_ranks::run(processes, [&](const plate::Communicator& all) {
      std::vector<std::uint32_t> own;  // stretches of 1 to 7 points, dealt out
      for (std::uint32_t k = 0, length = 1; k < points; k += length, length = 1 + length % 7)
        if (int((k / 5) % std::uint32_t(processes)) == all.rank())
          for (auto i = k; i < std::min(points, k + length); ++i) own.push_back(i);
      const post::PointOrder order(all, own);
      if (order.points() != points) throw std::runtime_error("points are missing");
      for (const auto& [first, count] : {std::pair(0u, points), {13u, 1u}, {999u, 1u}, {250u, 333u}}) {
        const auto found = order.at_first(first, count, 1, [&](std::size_t k, double* to) { *to = own[k]; });
        if (found.size() != (all.rank() == 0 ? count : 0)) throw std::runtime_error("not what was asked for");
        for (std::size_t i = 0; i < found.size(); ++i)
          if (found[i] != double(first + i)) throw std::runtime_error("a point is out of its place");
      }
    });
}
