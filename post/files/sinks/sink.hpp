#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "post/files/frame.hpp"
#include "post/files/table.hpp"

namespace post {

/// Where the results of a run go as a recorder gets them: a folder, or memory.
class Sink {
public:
  using Tables = std::vector<std::pair<std::string, const Table*>>;  // name, rows

  virtual ~Sink() = default;

  /// Are frames with resultants and cells wanted?
  virtual bool draws() const = 0;
  /// Are states wanted to go on from?
  virtual bool stores() const = 0;
  /// Are plots wanted?
  virtual bool plots() const = 0;

  /// The points and cells of all frames that bring none of their own, and the points of what is stored.
  virtual void open(const Mesh& mesh) = 0;
  /// With cells of its own where they are given.
  virtual void frame(Frame frame, std::optional<Mesh> mesh, plate::State velocity) = 0;
  /// The state of a run whose points are not the same throughout.
  virtual void final_state(const Mesh& mesh, const Frame& frame) = 0;
  /// Lines and tips, with the factors that are known; where frames are wanted.
  virtual void cracks(const Cracks& cracks) = 0;
  /// A drawing or a page: NAME.svg
  virtual void plot(const std::string& name, const std::string& svg) = 0;
  /// All tables; no frame comes after them.
  virtual void tables(const Tables& tables) = 0;
  /// The last.
  virtual void summary(const std::string& json) = 0;

  // Of sinks that keep what they have got when the process is killed:
  /// Times of the frames that have been given, all of which are written when this returns.
  virtual std::vector<double> written() { return {}; }
  /// The frames of these times were written before the run was ended.
  virtual void go_on([[maybe_unused]] const std::vector<double>& times) {}
};

}  // namespace post
