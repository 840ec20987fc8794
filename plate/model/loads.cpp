#include "plate/model/loads.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <sstream>
#include <string_view>
#include <vector>

#include "geometry/cells/triangulation.hpp"

namespace plate {
namespace {

double interpolate(const std::vector<std::pair<double, double>>& table, double time) {
  const auto after =
      std::upper_bound(table.begin(), table.end(), time, [](double t, const auto& entry) { return t < entry.first; });
  if (after == table.begin()) return table.front().second;
  if (after == table.end()) return table.back().second;
  const auto before = after - 1;
  const double share = (time - before->first) / (after->first - before->first);
  return before->second + share * (after->second - before->second);
}

}  // namespace

double factor(const History& history, double time) {
  switch (history.kind) {
    case History::Kind::step:
    case History::Kind::constant:
      return 1;
    case History::Kind::ramp:
      return std::min(1.0, time / history.rise_time);
    case History::Kind::sine:
      return std::sin(2 * std::numbers::pi * history.frequency * time);
    case History::Kind::table:
      return interpolate(history.table, time);
  }
  return 1;
}

namespace {

using geometry::Point;

struct Row {
  Point x;
  double pressure;
  std::size_t line;
};

/// Message about a line and what is wrong with it.
std::string error_of(std::size_t line, std::string what) {
  std::ranges::replace(what, '\0', '?');  // where it is printed it would end there
  return fmt::format("line {}: {}", line, what);
}

/// Fields between commas, without blanks about them.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> result;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) {
    const auto first = field.find_first_not_of(" \t\r"), last = field.find_last_not_of(" \t\r");
    result.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
  }
  return result;
}

/// Parses a decimal number (0x10 is none), or says what is wrong with it.
std::variant<double, std::string> number_of(const std::string& text) {
  double value = 0;
  const char *begin = text.data() + (text.starts_with('+') ? 1 : 0), *end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (begin == end || rest != end || error == std::errc::invalid_argument || text.starts_with("+-"))
    return fmt::format("\"{}\" is no number", text);
  if (error == std::errc::result_out_of_range) value = std::strtod(text.c_str(), nullptr);  // too small, or too large
  if (!std::isfinite(value)) return fmt::format("{} is not finite", text);
  return value;
}

/// Parses the three numbers of a row, or says what is wrong with them.
std::variant<Row, std::string> row_of(const std::vector<std::string>& fields, std::size_t line) {
  constexpr double farthest = 1e100;
  if (fields.size() != 3)
    return error_of(line, fmt::format("{} values given, must be x, y and pressure", fields.size()));
  std::array<double, 3> numbers{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = number_of(fields[i]);
    if (const auto* error = std::get_if<std::string>(&found)) return error_of(line, *error);
    numbers[i] = std::get<double>(found);
  }
  const Point x(numbers[0], numbers[1]);
  if (x.cwiseAbs().maxCoeff() > farthest)
    return error_of(line, fmt::format("a place beyond {:g} is given, ({:g}, {:g})", farthest, x.x(), x.y()));
  return Row{x, numbers[2], line};
}

/// Lines that begin with # and empty ones say nothing; the first that says something names the columns.
std::variant<std::vector<Row>, std::string> rows_of(const std::string& content) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of the order of bytes, with which spreadsheets begin UTF-8
  std::vector<Row> rows;
  std::stringstream stream(content.starts_with(mark) ? content.substr(mark.size()) : content);
  std::string line;
  bool headed = false;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const auto fields = fields_of(line);
    if (fields.empty() || (fields.size() == 1 && fields[0].empty()) || fields[0].starts_with('#')) continue;
    if (!headed) {
      if (fields != std::vector<std::string>{"x", "y", "pressure"})
        return error_of(number, fmt::format("\"{}\" given, the first line must be x,y,pressure", line));
      headed = true;
      continue;
    }
    const auto found = row_of(fields, number);
    if (const auto* error = std::get_if<std::string>(&found)) return *error;
    rows.push_back(std::get<Row>(found));
  }
  if (rows.size() < 3) return fmt::format("{} places given, must be 3 or more", rows.size());
  return rows;
}

/// FNV-1a of 64 bits.
std::string digest_of(const std::string& content) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : content) hash = (hash ^ std::uint8_t(c)) * 0x100000001b3U;
  return fmt::format("{:016x}", hash);
}

std::vector<double> distinct(const std::vector<Row>& rows, int axis) {
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(row.x[axis]);
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

double turn(const Point& a, const Point& b, const Point& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

}  // namespace

struct PressureTable::Values {
  std::filesystem::path file;
  std::string digest;
  std::vector<double> columns, rows;  // of a grid: x and y, ascending
  std::vector<double> pressures;      // of a grid by rows, else of every place
  std::vector<Point> places;          // without a grid
  geometry::Triangulated triangles;   // of them
  mutable std::size_t last = 0;       // triangle: where the next search begins
  Point low{0, 0}, size{1, 1};        // of the box of all places

  bool grid(const std::vector<Row>& given);
  /// Places on a straight border of them all are seldom on a line to the last bit, and the flat triangles between them
  /// tell nothing. Triangles are found with the places drawn towards the middle, those on borders most, and flat ones
  /// are left out: so every place on a border is a corner of one that is not flat. Returns what is wrong with the
  /// places, empty where nothing is.
  std::string triangulate(const std::vector<Row>& given);
  /// The triangle about x, by a walk from the last one; none outside.
  std::optional<std::size_t> about(const Point& x) const;
  double nearest(const Point& x) const;
};

/// True where every x of the file goes with every y of it.
bool PressureTable::Values::grid(const std::vector<Row>& given) {
  columns = distinct(given, 0), rows = distinct(given, 1);
  if (columns.size() < 2 || rows.size() < 2 || columns.size() * rows.size() != given.size()) return false;
  pressures.assign(given.size(), 0);
  const auto at = [](const std::vector<double>& values, double value) {
    return std::size_t(std::ranges::lower_bound(values, value) - values.begin());
  };
  for (const auto& row : given) pressures[at(rows, row.x.y()) * columns.size() + at(columns, row.x.x())] = row.pressure;
  return true;
}

std::string PressureTable::Values::triangulate(const std::vector<Row>& given) {
  columns.clear(), rows.clear(), pressures.clear();
  low = given.front().x;
  Point high = low;
  for (const auto& row : given) low = low.cwiseMin(row.x), high = high.cwiseMax(row.x);
  size = high - low;
  if (!(size.minCoeff() > 0)) return "all places lie on one line";
  for (const auto& row : given) places.push_back((row.x - low).cwiseQuotient(size)), pressures.push_back(row.pressure);
  constexpr double drawn = 1e-6, flat = 1e-12;
  const Point middle(0.5, 0.5);
  std::vector<Point> inwards;
  for (const Point& u : places) inwards.push_back(u + drawn * (u - middle).squaredNorm() * (u - middle));
  auto found = geometry::delaunay(inwards, {});
  if (auto* error = std::get_if<std::string>(&found)) return std::move(*error);
  triangles = std::get<geometry::Triangulated>(std::move(found));
  const auto is_flat = [&](std::size_t triangle) {
    const auto& [a, b, c] = triangles.corners[triangle];
    return !(turn(places[a], places[b], places[c]) > flat);
  };
  for (auto& across : triangles.across)
    for (auto& next : across)
      if (next != geometry::Triangulated::none && is_flat(std::size_t(next))) next = geometry::Triangulated::none;
  while (last < triangles.corners.size() && is_flat(last)) ++last;
  return last == triangles.corners.size() ? "all places lie on one line" : "";
}

std::optional<std::size_t> PressureTable::Values::about(const Point& x) const {
  constexpr double rounding = 1e-12;
  std::size_t now = last;
  for (std::size_t n = 0; n <= 4 * triangles.corners.size(); ++n) {
    const auto& c = triangles.corners[now];
    int beyond = -1;
    double most = -rounding;
    for (int i = 0; i < 3; ++i) {
      const double side = turn(places[c[std::size_t(i + 1) % 3]], places[c[std::size_t(i + 2) % 3]], x);
      if (side < most) most = side, beyond = i;
    }
    if (beyond < 0) return last = now;
    const auto next = triangles.across[now][std::size_t(beyond)];
    if (next == geometry::Triangulated::none) return std::nullopt;
    now = std::size_t(next);
  }
  return std::nullopt;
}

double PressureTable::Values::nearest(const Point& x) const {
  const auto found =
      std::ranges::min_element(places, {}, [&](const Point& place) { return (place - x).squaredNorm(); });
  return pressures[std::size_t(found - places.begin())];
}

PressureTable::PressureTable(const std::string& content, const std::filesystem::path& file) {
  auto found = parsed(content, file);
  if (const auto* error = std::get_if<std::string>(&found)) throw std::invalid_argument(*error);
  *this = std::get<PressureTable>(std::move(found));
}

std::variant<PressureTable, std::string> PressureTable::parsed(const std::string& content,
                                                               const std::filesystem::path& file) {
  const auto found = rows_of(content);
  if (const auto* error = std::get_if<std::string>(&found)) return *error;
  const auto& rows = std::get<std::vector<Row>>(found);
  std::map<std::pair<double, double>, std::size_t> seen;
  for (const auto& row : rows)
    if (const auto [first, fresh] = seen.emplace(std::pair(row.x.x(), row.x.y()), row.line); !fresh)
      return error_of(row.line, fmt::format("the place ({:g}, {:g}) is given in line {} already", row.x.x(), row.x.y(),
                                            first->second));
  auto values = std::make_shared<Values>();
  values->file = std::filesystem::absolute(file).lexically_normal(), values->digest = digest_of(content);
  if (!values->grid(rows))
    if (auto error = values->triangulate(rows); !error.empty()) return error;
  PressureTable result;
  result.values_ = std::move(values);
  return result;
}

const std::filesystem::path& PressureTable::file() const {
  return values_->file;
}

const std::string& PressureTable::digest() const {
  return values_->digest;
}

bool PressureTable::gridded() const {
  return !values_->columns.empty();
}

PressureTable PressureTable::times(double factor) const {
  PressureTable result = *this;
  result.factor_ *= factor;
  return result;
}

bool PressureTable::reaches(const Point& x) const {
  constexpr double rounding = 1e-9;
  const auto& v = *values_;
  const auto within = [&](const std::vector<double>& values, double value) {
    const double slack = rounding * (values.back() - values.front());
    return value >= values.front() - slack && value <= values.back() + slack;
  };
  if (gridded()) return within(v.columns, x.x()) && within(v.rows, x.y());
  const Point u = (x - v.low).cwiseQuotient(v.size);
  if (v.about(u)) return true;
  const Point inward = u + rounding * (Point(0.5, 0.5) - u) * 2;
  return v.about(inward).has_value();
}

double PressureTable::operator()(const Point& x) const {
  const auto& v = *values_;
  if (!gridded()) {
    const Point u = (x - v.low).cwiseQuotient(v.size);
    const auto triangle = v.about(u);
    if (!triangle) return factor_ * v.nearest(u);
    const auto& corners = v.triangles.corners[*triangle];
    double all = 0, sum = 0;  // of triangles between two corners and x, which may lie beyond a side by rounding
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = std::max(0.0, turn(v.places[corners[(i + 1) % 3]], v.places[corners[(i + 2) % 3]], u));
      all += share, sum += share * v.pressures[corners[i]];
    }
    return factor_ * sum / all;
  }
  const auto place = [](const std::vector<double>& values, double value) {
    const auto next = std::ranges::upper_bound(values, value) - values.begin();
    const auto i = std::size_t(std::clamp<std::ptrdiff_t>(next - 1, 0, std::ptrdiff_t(values.size()) - 2));
    return std::pair(i, std::clamp((value - values[i]) / (values[i + 1] - values[i]), 0.0, 1.0));
  };
  const auto [i, s] = place(v.columns, x.x());
  const auto [j, t] = place(v.rows, x.y());
  const auto at = [&](std::size_t column, std::size_t row) { return v.pressures[row * v.columns.size() + column]; };
  return factor_ * ((1 - s) * (1 - t) * at(i, j) + s * (1 - t) * at(i + 1, j) + (1 - s) * t * at(i, j + 1) +
                    s * t * at(i + 1, j + 1));
}

std::string Load::name() const {
  return std::visit([](const auto& one) { return one.name; }, action);
}

namespace {

template <class... Actions>
std::vector<Load::Action> one_of_each(const std::variant<Actions...>&) {
  return {Actions{}...};
}

/// A member of what acts, as `member` reads it, or else `nothing`.
template <class T, class Member>
const T& member_or(const Load::Action& action, const Member& member, const T& nothing) {
  return std::visit(
      [&](const auto& one) -> const T& {
        if constexpr (std::is_invocable_v<Member, decltype(one)>)
          return member(one);
        else
          return nothing;
      },
      action);
}

}  // namespace

std::vector<Load::Action> Load::kinds() {
  return one_of_each(Action());
}

const std::vector<std::string>& Load::edges() const {
  static const std::vector<std::string> none;
  return member_or(
      action, [](const auto& one) -> decltype((one.edges)) { return one.edges; }, none);
}

const geometry::Polyline& Load::line() const {
  static const geometry::Polyline none;
  return member_or(
      action, [](const auto& one) -> decltype((one.along)) { return one.along; }, none);
}

const geometry::Polyline& Load::path() const {
  static const geometry::Polyline none;
  return member_or(
      action, [](const auto& one) -> decltype((one.path)) { return one.path; }, none);
}

double Load::speed() const {
  static const double none = 0;
  return member_or(
      action, [](const auto& one) -> decltype((one.speed)) { return one.speed; }, none);
}

const Formula& Load::formula() const {
  static const Formula none;
  return member_or(
      action, [](const auto& one) -> decltype((one.formula)) { return one.formula; }, none);
}

std::optional<Point> Load::point() const {
  const auto* force = as<PointForce>();
  return force && !moves() ? std::optional(force->position) : std::nullopt;
}

bool Load::in_plane() const {
  const auto* force = as<PointForce>();
  const auto* heat = as<Temperature>();
  return as<EdgeTraction>() || as<BodyForce>() || (force && force->vector != Point(0, 0)) ||
         (heat && (heat->mean != 0 || heat->mean_formula.given()));
}

namespace {

/// A symmetric tensor times the normal n of an edge; by its components along the edge where it is not given.
Point on_edge(const std::optional<std::array<double, 3>>& tensor, double normal, double along, const Point& n) {
  if (!tensor) return normal * n + along * Point(-n.y(), n.x());
  const auto [xx, yy, xy] = *tensor;
  return {xx * n.x() + xy * n.y(), xy * n.x() + yy * n.y()};
}

}  // namespace

Point EdgeMoment::on(const Point& n) const {
  return on_edge(tensor, value, twist, n);
}

Point EdgeTraction::on(const Point& n) const {
  return on_edge(tensor, value, shear, n);
}

void scale(Load& load, double factor) {
  const auto multiply = [factor](auto& x) { x *= factor; };
  const auto scale_formula = [factor](Formula& formula) {
    if (formula.given()) formula = Formula(fmt::format("{:.17g} * ({})", factor, formula.text()));
  };
  std::visit(
      [&](auto& one) {
        if constexpr (requires { one.value; }) multiply(one.value);
        if constexpr (requires { one.vector; }) multiply(one.vector);
        if constexpr (requires { one.shear; }) multiply(one.shear);
        if constexpr (requires { one.formula; }) scale_formula(one.formula);
        if constexpr (requires { one.mean; }) multiply(one.mean), scale_formula(one.mean_formula);
        if constexpr (requires { one.gradient; }) multiply(one.gradient);
        if constexpr (requires { one.twist; }) multiply(one.twist);
        if constexpr (requires { one.slope; }) multiply(one.slope), multiply(one.rotation);
        if constexpr (requires { one.tensor; })
          if (one.tensor)
            for (auto& component : *one.tensor) multiply(component);
      },
      load.action);
  if (auto* pressure = load.as<Pressure>()) {
    if (pressure->table.given()) pressure->table = pressure->table.times(factor);
    if (pressure->gravity) multiply(*pressure->gravity);
  }
}

}  // namespace plate
