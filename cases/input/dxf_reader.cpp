#include "cases/input/dxf_reader.hpp"

#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>
#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>

#include "geometry/shape/smooth_curve.hpp"

namespace cases {
namespace {

using geometry::Point;
using geometry::Polyline;

constexpr double degree = std::numbers::pi / 180;

/// The arc from a to b that turns by 4 atan(bulge), counter-clockwise where that is positive.
DrawnPiece bulge_arc(const Point& a, const Point& b, double bulge) {
  const Point chord = b - a, left(-chord.y(), chord.x());
  const Point centre = (a + b) / 2 + (1 - bulge * bulge) / (4 * bulge) * left;
  const double radius = (a - centre).norm(), from = std::atan2(a.y() - centre.y(), a.x() - centre.x());
  DrawnPiece result{geometry::arc(centre, radius, from, from + 4 * std::atan(bulge)),
                    geometry::Circle{centre, radius, ""}};
  result.points.front() = a, result.points.back() = b;
  return result;
}

/// A rational B-spline as SPLINE has it.
struct Spline {
  std::size_t degree = 0;
  std::vector<double> knots, weights;
  Polyline control, fit;

  bool complete() const {
    return degree > 0 && degree < 20 && control.size() > degree && knots.size() == control.size() + degree + 1 &&
           std::ranges::is_sorted(knots) && knots[degree] < knots[control.size()] &&
           std::ranges::all_of(weights, [](double w) { return w > 0; });
  }
  /// De Boor's algorithm in the span that begins at knot k.
  Point at(double u, std::size_t k) const {
    std::vector<Eigen::Vector3d> d;
    for (std::size_t j = k - degree; j <= k; ++j)
      d.emplace_back(weights[j] * control[j].x(), weights[j] * control[j].y(), weights[j]);
    for (std::size_t r = 1; r <= degree; ++r)
      for (std::size_t j = degree; j >= r; --j) {
        const std::size_t i = j + k - degree;
        const double t = (u - knots[i]) / (knots[i + degree + 1 - r] - knots[i]);
        d[j] = (1 - t) * d[j - 1] + t * d[j];
      }
    return d[degree].head<2>() / d[degree].z();
  }
};

/// Smooth parts of a spline, which has corners at knots as many as its degree.
std::vector<Polyline> parts_of(const Spline& spline) {
  constexpr int places = 32;  // in a span
  std::vector<Polyline> result;
  const auto add = [&](const Point& x) {
    if (result.back().empty() || result.back().back() != x) result.back().push_back(x);
  };
  for (std::size_t k = spline.degree; k < spline.control.size(); ++k) {
    const double from = spline.knots[k], to = spline.knots[k + 1];
    if (!(from < to)) continue;
    const auto same = std::size_t(std::ranges::count(spline.knots, from));
    if (result.empty() || same >= spline.degree) result.emplace_back();
    const int last = spline.degree == 1 ? 1 : places;
    for (int i = 0; i <= last; ++i) add(spline.at(from + (to - from) * i / last, k));
  }
  for (auto& part : result)
    if (part.size() > 2) part = geometry::curve_through(part);
  std::erase_if(result, [](const Polyline& part) { return part.size() < 2; });
  return result;
}

bool is_number(const std::string& text) {
  const auto first = text.find_first_not_of(" +");
  if (first == std::string::npos) return false;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data() + first, text.data() + text.size(), value);
  return error == std::errc() && std::isfinite(value) &&
         std::all_of(end, text.data() + text.size(), [](char c) { return c == ' '; });
}

/// Collects curves as dxflib finds them, and checks the groups that it reads them from.
class Collector : public DL_CreationAdapter {
public:
  Collector(const std::set<std::string>& layers, std::size_t lines, DxfDrawing& found)
      : layers_(layers), lines_(lines), found_(found) {}

  bool ended() const { return ended_; }

  void processCodeValuePair(unsigned int code, const std::string& value) override {
    line_ += 2;
    if (ended_) return;
    if (code == 0) return begin(value);
    auto& now = current_;
    if (code == 2 && now.name == "SECTION") section_ = value;
    if (section_ != "ENTITIES" && section_ != "BLOCKS") return;
    if (code == 2) now.refers_to = value;
    if (code == 8) now.spelling = value, now.layer = layer_key(value);
    if (code == 67 && value.find('1') != std::string::npos) now.in_model = false;
    if (is_curve(now.name) && ((code >= 10 && code < 60) || (code >= 210 && code <= 230))) note_number(code, value);
    check_count(code, value);
    ++now.count[int(code)];
  }

  void setVariableInt(const std::string& key, int value, int) override {
    if (key == "$INSUNITS") found_.unit = value;
  }
  void addLine(const DL_LineData& x) override {
    if (done_.wanted) add({{{x.x1, x.y1}, {x.x2, x.y2}}});
  }
  void addArc(const DL_ArcData& x) override {
    double turn = std::fmod(x.angle2 - x.angle1, 360.0);
    if (turn <= 0) turn += 360;
    add_arc({x.cx, x.cy}, x.radius, x.angle1, turn);
  }
  void addCircle(const DL_CircleData& x) override { add_arc({x.cx, x.cy}, x.radius, 0, 360); }
  void addPolyline(const DL_PolylineData& data) override {
    vertices_.clear(), bulges_.clear();
    flags_ = data.flags;
    whole_ = done_;
    const auto given = done_.count[10];
    if (done_.wanted && done_.name == "LWPOLYLINE" && (done_.count[90] != 1 || given != data.number))
      problem(whole_, fmt::format("has {} vertices, and says another number", given));
  }
  void addVertex(const DL_VertexData& x) override {
    vertices_.emplace_back(x.x, x.y), bulges_.push_back(x.bulge);
    if (done_.spoilt) whole_.wanted = false;
  }
  void addSpline(const DL_SplineData& data) override {
    spline_ = {}, whole_ = done_;
    spline_.degree = data.degree;
  }
  void addKnot(const DL_KnotData& x) override { spline_.knots.push_back(x.k); }
  void addControlPoint(const DL_ControlPointData& x) override {
    spline_.control.emplace_back(x.x, x.y), spline_.weights.push_back(x.w);
  }
  void addFitPoint(const DL_FitPointData& x) override { spline_.fit.emplace_back(x.x, x.y); }
  void endEntity() override {
    if (whole_.wanted) whole_.name == "SPLINE" ? end_spline() : end_polyline();
    whole_ = {};
  }

private:
  /// Group codes of an entity, before dxflib makes a curve of them.
  struct Entity {
    std::string name, layer, spelling, refers_to;
    std::size_t line = 0;
    std::map<int, std::size_t> count;         // values by code
    double low = INFINITY, high = -INFINITY;  // z
    double normal = 1;                        // z component of the extrusion direction
    bool in_model = true, spoilt = false, wanted = false;
  };

  static bool is_curve(const std::string& name) {
    static const std::set<std::string> names{"LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "VERTEX", "SPLINE"};
    return names.contains(name);
  }

  void note_number(unsigned int code, const std::string& value) {
    if (!is_number(value)) {
      if (section_ == "ENTITIES" && layers_.contains(current_.layer) && !current_.spoilt)
        problem(current_, fmt::format("has \"{}\" where a number must be (line {})", value, line_));
      current_.spoilt = true;
      return;
    }
    const double x = std::strtod(value.c_str(), nullptr);
    if (code >= 30 && code < 33) current_.low = std::min(current_.low, x), current_.high = std::max(current_.high, x);
    if (code == 230) current_.normal = x;
  }

  /// Throws where dxflib would reserve or reach room for what is not there.
  void check_count(unsigned int code, const std::string& value) const {
    static const std::set<std::pair<std::string, unsigned int>> counted{
        {"SPLINE", 72}, {"SPLINE", 73}, {"SPLINE", 74}, {"LWPOLYLINE", 90},
        {"LEADER", 76}, {"HATCH", 91},  {"HATCH", 93}};
    const bool bulge_first = current_.name == "LWPOLYLINE" && code == 42 && !current_.count.contains(10);
    const double many = std::strtod(value.c_str(), nullptr);
    if (bulge_first || (counted.contains({current_.name, code}) && !(many >= 0 && many <= double(lines_))))
      throw std::runtime_error(
          fmt::format("line {}: {} with \"{}\" under code {}: the file is damaged", line_, current_.name, value, code));
  }

  /// Begins the next entity; dxflib adds the one before afterwards.
  void begin(const std::string& name) {
    finish();
    done_ = std::move(current_);
    current_ = {};
    current_.name = name, current_.line = line_;
    ended_ = name == "EOF";
    if (name == "ENDSEC") section_.clear();
  }

  /// Looks at the entity whose groups are all read.
  void finish() {
    auto& now = current_;
    const bool on_layer = layers_.contains(now.layer);
    if (section_ == "BLOCKS") {
      if (now.name == "BLOCK")
        block_ = now.refers_to;
      else if (now.name != "ENDBLK" && (on_layer || (now.name == "INSERT" && blocks_.contains(now.refers_to))))
        blocks_.insert(block_);
    }
    if (section_ != "ENTITIES" || !now.in_model) return;
    if (!now.spelling.empty()) found_.layers.insert(now.spelling);
    now.wanted = on_layer && is_curve(now.name) && !now.spoilt;
    if (now.name == "INSERT" && (on_layer || blocks_.contains(now.refers_to)))
      problem(now, fmt::format("puts the block \"{}\" there: explode it", now.refers_to));
    else if (on_layer)
      look_at(now);
  }

  void look_at(Entity& now) {
    static const std::set<std::string> passed{"TEXT",   "MTEXT",       "POINT",  "DIMENSION", "LEADER",
                                              "ATTDEF", "MULTILEADER", "ATTRIB", "VIEWPORT",  "SEQEND"};
    if (!is_curve(now.name) && !passed.contains(now.name))
      problem(now, "is not read: draw it by LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE or SPLINE");
    else if (now.wanted && now.high > now.low && (now.name == "LINE" || now.name == "SPLINE"))
      problem(now, "does not lie in one plane z");
    else if (now.wanted && std::abs(now.normal - 1) > 1e-6)
      problem(now, "is seen from behind or lies on another plane (its extrusion direction is not z)");
  }

  void problem(Entity& of, const std::string& what) {
    of.wanted = false;
    found_.problems.push_back(fmt::format("line {}: {} on layer {} {}", of.line, of.name, of.layer, what));
  }

  void add(DrawnPiece piece, const Entity& of) {
    piece.layer = of.layer, piece.line = of.line;
    if (!piece.straight() || piece.points.front() != piece.points.back()) found_.pieces.push_back(std::move(piece));
  }
  void add(DrawnPiece piece) { add(std::move(piece), done_); }

  void add_arc(const Point& centre, double radius, double from, double turn) {
    if (!done_.wanted) return;
    if (!(radius > 0)) return problem(done_, "has no radius > 0");
    DrawnPiece piece{geometry::arc(centre, radius, degree * from, degree * (from + turn)),
                     geometry::Circle{centre, radius, ""}};
    if (turn == 360) piece.points.back() = piece.points.front();
    add(std::move(piece));
  }

  void end_polyline() {
    constexpr int fitted = 2 | 4 | 8 | 16 | 64;
    if (flags_ & fitted) return problem(whole_, "is a fitted curve, a mesh or in space: draw a plain one");
    const std::size_t n = vertices_.size();
    for (std::size_t i = 0; i + (flags_ & 1 ? 0 : 1) < n; ++i) {
      const Point &a = vertices_[i], &b = vertices_[(i + 1) % n];
      if (a != b) add(bulges_[i] == 0 ? DrawnPiece{{a, b}} : bulge_arc(a, b, bulges_[i]), whole_);
    }
  }

  void end_spline() {
    auto& s = spline_;
    for (const auto& [room, points, size] :
         {std::tuple(72, 40, s.knots.size()), std::tuple(73, 10, s.control.size()), std::tuple(74, 11, s.fit.size())})
      if (whole_.count[room] > 0 ? whole_.count[points] != size : whole_.count[points] > 0)
        return problem(whole_, "has other numbers of knots and points than it says");
    if (whole_.count[73] == 0) s.control.clear();  // those of another spline
    if (whole_.count[74] == 0) s.fit.clear();
    if (!s.control.empty() && (whole_.count[72] == 0 || !s.complete()))
      return problem(whole_, "has knots or weights that do not fit its degree and points");
    if (!s.control.empty())
      for (auto& part : parts_of(s)) add({std::move(part)}, whole_);
    else if (s.fit.size() > 1)
      add({s.fit.size() > 2 ? geometry::curve_through(s.fit) : s.fit}, whole_);
  }

  const std::set<std::string>& layers_;
  std::size_t lines_, line_ = 0;
  DxfDrawing& found_;
  Entity current_, done_, whole_;  // the last: of vertices or knots
  std::string section_, block_;
  std::set<std::string> blocks_;  // blocks with entities on the layers
  bool ended_ = false;
  int flags_ = 0;
  Polyline vertices_;
  std::vector<double> bulges_;
  Spline spline_;
};

/// Lines of a file; throws where dxflib cannot read them.
std::size_t lines_of(const std::filesystem::path& path) {
  constexpr std::uintmax_t most = 200'000'000;
  constexpr std::size_t longest = 1000;  // dxflib reads 1,023 characters
  if (!std::filesystem::is_regular_file(path)) throw std::runtime_error("there is no such file");
  if (std::filesystem::file_size(path) > most) throw std::runtime_error(fmt::format("is larger than {} bytes", most));
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot be read");
  std::size_t lines = 0;
  for (std::string line; std::getline(stream, line); ++lines) {
    if (lines == 0 && line.starts_with("AutoCAD Binary DXF"))
      throw std::runtime_error("is a binary DXF file: save it as ASCII DXF");
    if (line.size() > longest || line.find('\0') != std::string::npos)
      throw std::runtime_error(fmt::format("line {} is no line of an ASCII DXF file", lines + 1));
  }
  return lines;
}

}  // namespace

std::string layer_key(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return name;
}

DxfDrawing read_dxf(const std::filesystem::path& path, const std::set<std::string>& layers) {
  DxfDrawing result;
  try {
    Collector collector(layers, lines_of(path), result);
    DL_Dxf().in(path.string(), &collector);
    if (!collector.ended()) result.problems.push_back("is no ASCII DXF file, or ends before its end (0, EOF)");
  } catch (const std::exception& error) {
    result.problems.push_back(error.what());
  }
  return result;
}

}  // namespace cases
