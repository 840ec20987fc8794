#pragma once
#include "post/files/sinks/kept.hpp"
#include "post/files/sinks/sink.hpp"

namespace post {

/// Keeps results in a value that outlives it.
class KeptSink : public Sink {
public:
  explicit KeptSink(Kept& kept) : kept_(kept) {}

  bool draws() const override { return kept_.wants_fields; }
  bool stores() const override { return false; }
  bool plots() const override { return false; }
  void open(const Mesh& mesh) override { mesh_ = mesh; }
  void frame(Frame frame, std::optional<Mesh> mesh, plate::State velocity) override;
  void final_state(const Mesh&, const Frame&) override {}
  void cracks(const Cracks& cracks) override;
  void plot(const std::string&, const std::string&) override {}
  void tables(const Tables& tables) override;
  void summary(const std::string& json) override { kept_.summary = json; }

private:
  Kept& kept_;
  Mesh mesh_;
};

}  // namespace post
