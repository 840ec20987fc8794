#include "post/report/pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "post/files/data_arrays.hpp"
#include "post/files/frame.hpp"
#include "post/report/html_page.hpp"

namespace post {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

Raster::Raster(const plate::Mesh& mesh, std::size_t pixels) {
  const auto points = vertices(mesh);
  const auto [low, high] = geometry::bounding_box(points);
  const geometry::Point size = high - low;
  low_ = low;
  pitch_ = std::sqrt(size.x() * size.y() / double(pixels));
  pitch_ = std::max(pitch_, size.maxCoeff() / double(pixels));  // of a plate as thin as a line
  columns_ = std::size_t(std::ceil(size.x() / pitch_)), rows_ = std::size_t(std::ceil(size.y() / pitch_));
  sources_.resize(columns_ * rows_);
  for (const auto& q : mesh.quads) draw(points, {q[0], q[1], q[2]}), draw(points, {q[0], q[2], q[3]});
  for (const auto& t : mesh.triangles) draw(points, t);
  widen();
}

void Raster::draw(const std::vector<geometry::Point>& points, const Triangle& triangle) {
  std::array<Eigen::Vector2d, 3> x;  // in pixels
  for (std::size_t i = 0; i < 3; ++i) x[i] = (points[triangle[i]] - low_) / pitch_;
  const Eigen::Vector2d to_b = x[1] - x[0], to_c = x[2] - x[0];
  const double area = cross(to_b, to_c);
  if (area == 0) return;
  const Eigen::Vector2d least = x[0].cwiseMin(x[1]).cwiseMin(x[2]), most = x[0].cwiseMax(x[1]).cwiseMax(x[2]);
  constexpr double middle = 0.5, slack = 1e-9;  // a pixel between two triangles belongs to one of them at least
  const auto from = [](double at) { return std::ptrdiff_t(std::ceil(std::max(at - middle, 0.0))); };
  const auto to = [](double at, std::size_t size) {
    return std::min(std::ptrdiff_t(at - middle), std::ptrdiff_t(size) - 1);
  };
  for (auto j = from(least.y()); j <= to(most.y(), rows_); ++j)
    for (auto i = from(least.x()); i <= to(most.x(), columns_); ++i) {
      const Eigen::Vector2d at = Eigen::Vector2d(double(i) + middle, double(j) + middle) - x[0];
      const double of_b = cross(at, to_c) / area, of_c = cross(to_b, at) / area;
      if (of_b < -slack || of_c < -slack || of_b + of_c > 1 + slack) continue;
      sources_[std::size_t(j) * columns_ + std::size_t(i)] = {triangle[0], triangle[1], triangle[2], float(of_b),
                                                              float(of_c)};
    }
}

void Raster::widen() {
  const auto inside = sources_;
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    if (inside[k].a != nowhere) continue;
    const auto column = k % columns_, row = k / columns_;
    for (auto j = row > 0 ? row - 1 : row; j <= std::min(row + 1, rows_ - 1); ++j)
      for (auto i = column > 0 ? column - 1 : column; i <= std::min(column + 1, columns_ - 1); ++i)
        if (const auto& beside = inside[j * columns_ + i]; beside.a != nowhere) sources_[k] = beside;
  }
}

namespace {

// A page of 2.5 MB: 7 fields of one frame and 3 of six others take 1.0 million numbers of 16 bits; in the plane 3 more.
constexpr std::size_t pixels_of_last = 300 * 300;
constexpr std::size_t most_earlier = 6, coarser = 2;
constexpr std::array shares{0.005, 0.995};  // percentiles of the pixels at the ends of the colours
constexpr int significant_digits = 7;

bool is_kept_of_earlier(const std::string& name) {
  return name == "w" || name == "von_mises" || name == "damage";
}

/// Every second pixel each way.
std::vector<float> thinned(const std::vector<float>& pixels, std::size_t columns, std::size_t rows) {
  std::vector<float> result;
  for (std::size_t j = 0; j < rows; j += coarser)
    for (std::size_t i = 0; i < columns; i += coarser) result.push_back(pixels[j * columns + i]);
  return result;
}

std::string pair(double a, double b) {
  return json_list({json_number(a, significant_digits), json_number(b, significant_digits)});
}

}  // namespace

struct Pictures::Scale {
  double from = 0, to = 0;   // of the colours
  double low = 0, high = 0;  // of the codes

  std::vector<std::uint16_t> codes(const std::vector<float>& pixels) const {
    constexpr double largest = 65535;
    const double step = high > low ? (largest - 1) / (high - low) : 0;
    std::vector<std::uint16_t> result;
    result.reserve(pixels.size());
    for (const float value : pixels)
      result.push_back(std::isnan(value)
                           ? std::uint16_t(0)
                           : std::uint16_t(std::lround(1 + step * (std::clamp(double(value), low, high) - low))));
    return result;
  }
};

Pictures::Pictures() = default;
Pictures::~Pictures() = default;

void Pictures::open(const Mesh& mesh) {
  mesh_ = mesh;
  raster_.reset();
  if (!mesh.positions.empty()) raster_ = std::make_unique<Raster>(mesh, pixels_of_last);
}

Pictures::Picture Pictures::picture(const Frame& frame) const {
  Picture result{frames_, frame.time, raster_->columns(), raster_->rows(), raster_->pitch(), raster_->corner(), {}};
  constexpr auto linear = &Mesh::Source::linear, mean = &Mesh::Source::mean;
  const auto add = [&](const char* name, const Eigen::RowVectorXd& values, CornerWeight weight) {
    result.fields.push_back(
        {name, raster_->pixels(at_vertices(mesh_, values, weight).reshaped()), values.minCoeff(), values.maxCoeff()});
  };
  const auto add_tensor = [&](const std::array<const char*, 3>& of, const Eigen::Matrix3Xd& values) {
    for (Eigen::Index i = 0; i < 3; ++i) add(of[std::size_t(i)], values.row(i), mean);
  };
  const auto& in_plane = frame.in_plane;
  const bool bends = !in_plane || !earlier_.empty() || !frame.state.isZero(0);
  if (bends) add("w", frame.state.row(0), linear);
  const auto& moments = frame.resultants.moments;
  const auto& von_mises = frame.resultants.von_mises;
  if (von_mises.size() > 0) add("von_mises", von_mises.transpose(), mean);
  if (bends && von_mises.size() > 0) add_tensor({"Mxx", "Myy", "Mxy"}, moments);
  if (!bends) {
    add("u", in_plane->displacement.row(0), linear);
    add("v", in_plane->displacement.row(1), linear);
  }
  if (in_plane && in_plane->force.cols() > 0) add_tensor({"Nxx", "Nyy", "Nxy"}, in_plane->force);
  if (std::ranges::any_of(frame.damage, [](double damage) { return damage > 0; }))
    add("damage", row_of(frame.damage), mean);
  return result;
}

void Pictures::look(const Frame& frame, bool last) {
  if (!raster_ || frame.state.cols() == 0) return;
  auto now = picture(frame);
  if (last || !last_) last_ = now;
  if (frames_++ % stride_ != 0 || frame.state.row(0).isZero(0)) return;
  auto& kept = earlier_.emplace_back(std::move(now));
  std::erase_if(kept.fields, [](const Field& field) { return !is_kept_of_earlier(field.name); });
  for (auto& field : kept.fields) field.pixels = thinned(field.pixels, kept.columns, kept.rows);
  kept.columns = (kept.columns + 1) / coarser, kept.rows = (kept.rows + 1) / coarser;
  kept.corner -= geometry::Point::Constant((coarser - 1) * kept.pitch / 2), kept.pitch *= coarser;
  if (earlier_.size() <= most_earlier) return;
  stride_ *= 2;
  std::erase_if(earlier_, [&](const Picture& one) { return one.number % stride_ != 0; });
}

Pictures::Scale Pictures::scale_of(const Field& field) const {
  std::vector<float> values;
  const auto take = [&](const Picture& picture) {
    for (const auto& one : picture.fields)
      if (one.name == field.name)
        std::ranges::copy_if(one.pixels, std::back_inserter(values), [](float x) { return !std::isnan(x); });
  };
  for (const auto& picture : earlier_) take(picture);
  take(*last_);
  if (values.empty()) return {};
  const auto percentile = [&](double share) -> double {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
  };
  const auto [least, largest] = std::ranges::minmax(values);
  Scale scale{percentile(shares[0]), percentile(shares[1]), least, largest};
  if (field.name == "damage") scale.from = 0, scale.to = largest;
  constexpr double beyond =
      3;  // ranges of colours on either side, so that 16 bits are fine enough beside a singularity
  const double span = scale.to - scale.from;
  if (span > 0) {
    scale.low = std::max(scale.low, scale.from - beyond * span);
    scale.high = std::min(scale.high, scale.to + beyond * span);
  }
  return scale;
}

std::string Pictures::json() const {
  if (!last_) return "null";
  std::vector<std::string> fields, frames;
  std::vector<Scale> scales;
  for (const auto& field : last_->fields) {
    const auto& s = scales.emplace_back(scale_of(field));
    fields.push_back(json_object({{"name", json_text(field.name)},
                                  {"least", json_number(field.least)},
                                  {"largest", json_number(field.largest)},
                                  {"range", pair(s.from, s.to)},
                                  {"low", json_number(s.low)},
                                  {"high", json_number(s.high)}}));
  }
  const auto add = [&](const Picture& picture) {
    Members data;
    for (const auto& field : picture.fields)
      for (std::size_t i = 0; i < scales.size(); ++i)
        if (last_->fields[i].name == field.name) {
          const auto codes = scales[i].codes(field.pixels);  // the low byte first
          data.emplace_back(field.name, json_text(base64(std::as_bytes(std::span(codes)))));
        }
    frames.push_back(json_object({{"time", json_number(picture.time, significant_digits)},
                                  {"columns", std::to_string(picture.columns)},
                                  {"rows", std::to_string(picture.rows)},
                                  {"pitch", json_number(picture.pitch)},
                                  {"corner", pair(picture.corner.x(), picture.corner.y())},
                                  {"data", json_object(data)}}));
  };
  for (const auto& picture : earlier_)
    if (picture.time != last_->time) add(picture);
  add(*last_);
  return json_object({{"fields", json_list(fields)},
                      {"frames", json_list(frames)},
                      {"shares", json_list({json_number(shares[0], significant_digits),
                                            json_number(shares[1], significant_digits)})}});
}

}  // namespace post
