// SPDX-License-Identifier: BSD-3-Clause
#include "model/svg_path.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "text/float_chars.h"

namespace flbc::io {
namespace {

void skip_blanks(std::string_view& text) {
  const auto first = text.find_first_not_of(" \t\r\n\f");
  text.remove_prefix(first == std::string_view::npos ? text.size() : first);
}

void skip_separator(std::string_view& text) {
  skip_blanks(text);
  if (!text.empty() && text.front() == ',') text.remove_prefix(1), skip_blanks(text);
}

// A flag of an arc is one character, and the next number may follow without a blank.
bool take_flag(std::string_view& text, double& flag) {
  skip_separator(text);
  if (text.empty() || (text.front() != '0' && text.front() != '1')) return false;
  flag = text.front() - '0';
  text.remove_prefix(1);
  return true;
}

// By its center (SVG 1.1, appendix F.6).
std::vector<Cubic> arc_between(const Vector<2>& from, const Vector<2>& to, Vector<2> radii,
                               double degrees, bool is_large, bool is_sweep) {
  radii = radii.cwiseAbs();
  if (from == to) return {};
  const Eigen::Rotation2Dd turn(degrees * kPi / 180);
  const Vector<2> half = turn.inverse() * Vector<2>((from - to) / 2);
  const double excess = half.cwiseQuotient(radii).squaredNorm();
  if (excess > 1) radii *= std::sqrt(excess);
  const Vector<2> on_circle = half.cwiseQuotient(radii);
  const double distance = std::sqrt(std::max(0.0, 1 / on_circle.squaredNorm() - 1));
  const double side = is_large == is_sweep ? -distance : distance;
  const Vector<2> middle = side * Vector<2>(on_circle.y(), -on_circle.x());  // of the unit circle
  const auto angle = [](const Vector<2>& p) { return std::atan2(p.y(), p.x()); };
  const double begin = angle(on_circle - middle);
  double end = angle(-on_circle - middle);
  if (is_sweep && end < begin) end += 2 * kPi;
  if (!is_sweep && end > begin) end -= 2 * kPi;
  const Vector<2> center = middle.cwiseProduct(radii);
  // A radius is zero, or too small or too large to compute with.
  if (!std::isfinite(end - begin) || !center.allFinite() || !radii.allFinite()) {
    return {Cubic::line(from, to)};
  }
  auto cubics = arc(center, radii, begin, end);
  for (auto& cubic : cubics) {
    cubic.points = (turn.toRotationMatrix() * cubic.points).colwise() + (from + to) / 2;
  }
  cubics.front().points.col(0) = from;
  cubics.back().points.col(3) = to;
  return cubics;
}

// Reads path data command by command.
class PathReader {
 public:
  explicit PathReader(std::string_view text) : text_(text) {}

  // \return whether there was no error
  bool read() {
    for (skip_blanks(text_); !text_.empty(); skip_blanks(text_)) {
      if (std::isalpha(static_cast<unsigned char>(text_.front())) != 0) {
        command_ = text_.front();
        text_.remove_prefix(1);
      } else if (std::tolower(command_) == 'm') {
        command_ = command_ == 'm' ? 'l' : 'L';  // more pairs are lines
      } else if (std::tolower(command_) == 'z') {
        return false;
      }
      if (path_.empty() && std::tolower(command_) != 'm') return false;
      if (!step()) return false;
    }
    return true;
  }

  Path path() && {
    // A single point draws nothing.
    const auto is_empty = [](const SubPath& part) { return part.cubics.empty(); };
    path_.erase(std::remove_if(path_.begin(), path_.end(), is_empty), path_.end());
    return std::move(path_);
  }

 private:
  bool take(int count) {
    for (int k = 0; k < count; ++k) {
      const bool is_flag = std::tolower(command_) == 'a' && (k == 3 || k == 4);
      if (!(is_flag ? take_flag(text_, numbers_[k]) : take_number(text_, numbers_[k])))
        return false;
    }
    return true;
  }

  // The point of a pair of numbers.
  Vector<2> point(int k) const {
    const Vector<2> pair(numbers_[k], numbers_[k + 1]);
    return std::islower(command_) != 0 ? Vector<2>(at_ + pair) : pair;
  }

  void add(const Cubic& cubic) {
    if (path_.back().is_closed) path_.push_back({});
    path_.back().cubics.push_back(cubic);
    at_ = cubic.last();
  }

  void add_cubic(const Vector<2>& one, const Vector<2>& two, const Vector<2>& end) {
    Cubic cubic;
    cubic.points << at_, one, two, end;
    handle_ = two;
    add(cubic);
  }

  void add_quadratic(const Vector<2>& handle, const Vector<2>& end) {
    const Vector<2> begin = at_;
    add_cubic(begin + 2 * (handle - begin) / 3, end + 2 * (handle - end) / 3, end);
    handle_ = handle;
  }

  // The handle of a smooth curve: that of the curve before, mirrored.
  Vector<2> mirrored(const char* kinds) const {
    const bool continues = std::string_view(kinds).find(before_) != std::string_view::npos;
    return continues ? Vector<2>(2 * at_ - handle_) : at_;
  }

  void close() {
    auto& part = path_.back();
    if (part.is_closed) return;
    if (at_ != begin_) add(Cubic::line(at_, begin_));
    path_.back().is_closed = !path_.back().cubics.empty();
    at_ = begin_;
  }

  bool step() {
    const bool is_relative = std::islower(command_) != 0;
    const char kind = static_cast<char>(std::tolower(command_));
    constexpr std::string_view kKinds = "mlhvcsqtaz";
    constexpr int kCounts[] = {2, 2, 1, 1, 6, 4, 4, 2, 7, 0};
    const auto number = kKinds.find(kind);
    if (number == std::string_view::npos || !take(kCounts[number])) return false;
    switch (kind) {
      case 'm':
        at_ = begin_ = path_.empty() ? Vector<2>(numbers_[0], numbers_[1]) : point(0);
        path_.push_back({});
        break;
      case 'l':
        add(Cubic::line(at_, point(0)));
        break;
      case 'h':
        add(Cubic::line(at_, {numbers_[0] + (is_relative ? at_.x() : 0), at_.y()}));
        break;
      case 'v':
        add(Cubic::line(at_, {at_.x(), numbers_[0] + (is_relative ? at_.y() : 0)}));
        break;
      case 'c':
        add_cubic(point(0), point(2), point(4));
        break;
      case 's':
        add_cubic(mirrored("cs"), point(0), point(2));
        break;
      case 'q':
        add_quadratic(point(0), point(2));
        break;
      case 't':
        add_quadratic(mirrored("qt"), point(0));
        break;
      case 'a': {
        const auto end = point(5);
        for (const auto& cubic : arc_between(at_, end, {numbers_[0], numbers_[1]}, numbers_[2],
                                             numbers_[3] != 0, numbers_[4] != 0)) {
          add(cubic);
        }
        at_ = end;
        break;
      }
      default:
        close();
    }
    before_ = kind;
    return true;
  }

  std::string_view text_;
  Path path_{};
  char command_ = ' ', before_ = ' ';
  double numbers_[7] = {};
  Vector<2> at_{0, 0}, begin_{0, 0}, handle_{0, 0};
};

Vector<2> direction(const Vector<2>& vector) {
  const double length = vector.norm();
  return length > 0 ? Vector<2>(vector / length) : Vector<2>::Zero();
}

Eigen::RowVector4d bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

// Fits cubics to a row of samples.
class Fitter {
 public:
  // \param samples  of one cubic at rest, moved \param first, last  their directions at the ends
  Fitter(const Vector<2>* samples, std::size_t count, double tolerance, std::vector<Cubic>& cubics)
      : samples_(samples), count_(count), tolerance_(tolerance), cubics_(cubics) {}

  void fit(const Vector<2>& first, const Vector<2>& last) { fit(0, count_ - 1, first, last); }

 private:
  static constexpr std::size_t kFewest = 2;  // steps of a cubic that is not halved

  void fit(std::size_t begin, std::size_t end, const Vector<2>& first, const Vector<2>& last) {
    double error = 0;
    const auto cubic = best(begin, end, first, last, error);
    if (error <= tolerance_ || end - begin <= kFewest) return cubics_.push_back(cubic);
    const std::size_t middle = (begin + end) / 2;
    const auto across = direction(samples_[middle + 1] - samples_[middle - 1]);
    fit(begin, middle, first, across);
    fit(middle, end, across, last);
  }

  // The cubic with given ends and directions there that is nearest to the samples, in the sense of
  // least squares (Schneider 1990).
  Cubic best(std::size_t begin, std::size_t end, const Vector<2>& first, const Vector<2>& last,
             double& error) const {
    constexpr int kSteps = 20;
    const std::size_t steps = end - begin;
    std::vector<double> at(steps + 1);
    for (std::size_t k = 0; k <= steps; ++k)
      at[k] = static_cast<double>(k) / static_cast<double>(steps);
    Cubic cubic;
    for (int step = 0; step < kSteps; ++step) {
      cubic = solved(begin, end, first, last, at);
      error = 0;
      for (std::size_t k = 1; k < steps; ++k) {
        error = std::max(error, (cubic.at(at[k]) - samples_[begin + k]).norm());
      }
      if (error <= tolerance_) break;
      for (std::size_t k = 1; k < steps; ++k) at[k] = nearer(cubic, samples_[begin + k], at[k]);
    }
    return cubic;
  }

  Cubic solved(std::size_t begin, std::size_t end, const Vector<2>& first, const Vector<2>& last,
               const std::vector<double>& at) const {
    const Vector<2>&from = samples_[begin], &to = samples_[end];
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Vector<2> right = Vector<2>::Zero();
    for (std::size_t k = 1; k + 1 < at.size(); ++k) {
      const auto b = bernstein(at[k]);
      Eigen::Matrix2d rows;
      rows << b[1] * first, -b[2] * last;
      const Vector<2> rest = samples_[begin + k] - (b[0] + b[1]) * from - (b[2] + b[3]) * to;
      normal += rows.transpose() * rows;
      right += rows.transpose() * rest;
    }
    Vector<2> lengths = normal.determinant() > 1e-12 * normal.squaredNorm()
                            ? Vector<2>(normal.inverse() * right)
                            : Vector<2>(-1, -1);
    const double third = (to - from).norm() / 3;
    if (!(lengths.minCoeff() > 1e-3 * third)) lengths.setConstant(third);
    Cubic cubic;
    cubic.points << from, from + lengths[0] * first, to - lengths[1] * last, to;
    return cubic;
  }

  // One step of Newton's method to the nearest point.
  static double nearer(const Cubic& cubic, const Vector<2>& sample, double t) {
    const auto& p = cubic.points;
    const Eigen::Matrix<double, 2, 3> d1 = 3 * (p.rightCols<3>() - p.leftCols<3>());
    const Eigen::Matrix<double, 2, 2> d2 = 2 * (d1.rightCols<2>() - d1.leftCols<2>());
    const double s = 1 - t;
    const Vector<2> miss = cubic.at(t) - sample;
    const Vector<2> slope = s * s * d1.col(0) + 2 * s * t * d1.col(1) + t * t * d1.col(2);
    const Vector<2> bend = s * d2.col(0) + t * d2.col(1);
    const double denominator = slope.squaredNorm() + miss.dot(bend);
    return denominator > 0 ? std::clamp(t - miss.dot(slope) / denominator, 0.0, 1.0) : t;
  }

  const Vector<2>* samples_;
  std::size_t count_;
  double tolerance_;
  std::vector<Cubic>& cubics_;
};

// The direction at an end of a row of samples, of second order. \param first, second, third  from
// the end on \param last  the other end
Vector<2> direction_from(const Vector<2>& first, const Vector<2>& second, const Vector<2>& third,
                         const Vector<2>& last) {
  const auto found = direction(4 * second - 3 * first - third);
  return found.isZero() ? direction(last - first) : found;
}
// \param count  at least 5, as PathSamples has
Vector<2> direction_at_begin(const Vector<2>* samples, std::size_t count) {
  return direction_from(samples[0], samples[1], samples[2], samples[count - 1]);
}
Vector<2> direction_at_end(const Vector<2>* samples, std::size_t count) {
  const Vector<2>* const end = samples + count;
  return -direction_from(end[-1], end[-2], end[-3], end[-3]);
}

bool is_straight(const Vector<2>* samples, std::size_t count, double tolerance) {
  const Vector<2> along = direction(samples[count - 1] - samples[0]);
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const Vector<2> offset = samples[k] - samples[0];
    if ((offset - along.dot(offset) * along).norm() > tolerance) return false;
  }
  return true;
}

// A number rounded to a multiple of the unit, a power of ten, without zeros at its end. \param
// decimals  of the unit
void append(std::string& text, double value, int decimals) {
  const double rounded = std::round(value * std::pow(10.0, decimals));
  constexpr double kMost = 1e15;  // that fits
  auto number = std::to_string(static_cast<long long>(std::clamp(std::abs(rounded), 0.0, kMost)));
  if (decimals > 0) {
    const auto places = static_cast<std::size_t>(decimals);
    if (number.size() <= places) number.insert(0, places + 1 - number.size(), '0');
    number.insert(number.size() - places, 1, '.');
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
  }
  if (rounded < 0) number.insert(0, 1, '-');
  if (!text.empty() && std::isalpha(static_cast<unsigned char>(text.back())) == 0) text += ' ';
  text += number;
}

}  // namespace

Cubic Cubic::line(const Vector<2>& from, const Vector<2>& to) {
  Cubic cubic;
  cubic.points << from, from + (to - from) / 3, to - (to - from) / 3, to;
  cubic.is_line = true;
  return cubic;
}

Vector<2> Cubic::at(double t) const {
  return points * bernstein(t).transpose();
}

bool take_number(std::string_view& text, double& number) {
  auto rest = text;
  skip_separator(rest);
  if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
  const bool is_digit = !rest.empty() && (rest.front() == '-' || rest.front() == '.' ||
                                          (rest.front() >= '0' && rest.front() <= '9'));
  if (!is_digit) return false;
  const auto [end, error] = from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return false;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  text = rest;
  return true;
}

Path parse_path(std::string_view text, bool& is_whole) {
  PathReader reader(text);
  is_whole = reader.read();
  return std::move(reader).path();
}

std::vector<Cubic> arc(const Vector<2>& center, const Vector<2>& radii, double from, double to) {
  const int count =
      std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / (kPi / 2) - 1e-9)));
  const double step = (to - from) / count, handle = 4.0 / 3 * std::tan(step / 4);
  std::vector<Cubic> cubics;
  for (int k = 0; k < count; ++k) {
    const Vector<2> a(std::cos(from + k * step), std::sin(from + k * step));
    const Vector<2> b(std::cos(from + (k + 1) * step), std::sin(from + (k + 1) * step));
    Cubic cubic;
    cubic.points << a, a + handle * Vector<2>(-a.y(), a.x()), b - handle * Vector<2>(-b.y(), b.x()),
        b;
    cubic.points = (radii.asDiagonal() * cubic.points).colwise() + center;
    cubics.push_back(cubic);
  }
  return cubics;
}

std::string to_text(const Path& path, int decimals) {
  std::string text;
  const auto put = [&](const Vector<2>& point) {
    append(text, point.x(), decimals);
    append(text, point.y(), decimals);
  };
  for (const auto& part : path) {
    text += 'M';
    put(part.cubics.front().first());
    char last = 'M';
    for (std::size_t k = 0; k < part.cubics.size(); ++k) {
      const auto& cubic = part.cubics[k];
      // Closing draws the last line.
      if (cubic.is_line && part.is_closed && k > 0 && k + 1 == part.cubics.size()) break;
      const char command = cubic.is_line ? 'L' : 'C';
      if (command != last) text += command;
      last = command;
      for (int i = cubic.is_line ? 3 : 1; i < 4; ++i) put(cubic.points.col(i));
    }
    if (part.is_closed) text += 'Z';
  }
  return text;
}

Affine2 fitted_map(const std::vector<Vector<2>>& from, const std::vector<Vector<2>>& to,
                   bool is_similarity) {
  const auto count = static_cast<double>(from.size());
  Vector<2> middle = Vector<2>::Zero(), moved = Vector<2>::Zero();
  for (std::size_t k = 0; k < from.size(); ++k) middle += from[k] / count, moved += to[k] / count;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero(), cross = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < from.size(); ++k) {
    spread += (from[k] - middle) * (from[k] - middle).transpose();
    cross += (to[k] - moved) * (from[k] - middle).transpose();
  }
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  const double trace = spread.trace();
  if (!is_similarity && spread.determinant() > 1e-9 * trace * trace) {
    linear = cross * spread.inverse();
  } else if (trace > 0) {
    const double a = (cross(0, 0) + cross(1, 1)) / trace, b = (cross(1, 0) - cross(0, 1)) / trace;
    linear << a, -b, b, a;
  }
  Affine2 map = Affine2::Identity();
  map.linear() = linear;
  map.translation() = moved - linear * middle;
  return map;
}

PathSamples::PathSamples(const Path& path, double size) : path_(path) {
  constexpr double kSteps = 64;  // along the size of the drawing
  for (const auto& part : path_) {
    for (const auto& cubic : part.cubics) {
      const auto& p = cubic.points;
      const double length = (p.rightCols<3>() - p.leftCols<3>()).colwise().norm().sum();
      std::size_t steps = 4;
      while (steps < 64 && static_cast<double>(steps) * size < kSteps * length) steps *= 2;
      begins_.push_back(points_.size());
      for (std::size_t k = 0; k <= steps; ++k) {
        points_.push_back(cubic.at(static_cast<double>(k) / static_cast<double>(steps)));
      }
    }
  }
  begins_.push_back(points_.size());
}

Path PathSamples::fitted(const std::vector<Vector<2>>& moved, double tolerance) const {
  constexpr double kSmooth = 0.9998;  // cosine of 1 degree
  const double exact = tolerance / 50;
  Path result;
  std::size_t next = 0;
  for (const auto& part : path_) {
    const std::size_t begin = next, count = part.cubics.size();
    next += count;
    auto& own = result.emplace_back();
    own.is_closed = part.is_closed;
    const auto row = [&](const std::vector<Vector<2>>& points, std::size_t k) {
      return std::pair(points.data() + begins_[begin + k],
                       begins_[begin + k + 1] - begins_[begin + k]);
    };
    std::vector<bool> are_lines(count);
    std::vector<Vector<2>> firsts(count), lasts(count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto [samples, size] = row(moved, k);
      are_lines[k] = part.cubics[k].is_line && is_straight(samples, size, tolerance / 2);
      firsts[k] = direction_at_begin(samples, size);
      lasts[k] = direction_at_end(samples, size);
    }
    for (std::size_t k = part.is_closed ? 0 : 1; k < count; ++k) {
      const std::size_t before = (k + count - 1) % count;
      const auto [rest, size] = row(points_, k);
      const auto [rest_before, size_before] = row(points_, before);
      const bool is_smooth =
          direction_at_begin(rest, size).dot(direction_at_end(rest_before, size_before)) > kSmooth;
      if (is_smooth && !are_lines[k] && !are_lines[before]) {
        firsts[k] = lasts[before] = direction(firsts[k] + lasts[before]);
      } else if (is_smooth && are_lines[before]) {
        firsts[k] = lasts[before];
      } else if (is_smooth) {
        lasts[before] = firsts[k];
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto [samples, size] = row(moved, k);
      const auto [rest, same_size] = row(points_, k);
      const std::vector<Vector<2>> from(rest, rest + same_size), to(samples, samples + size);
      const Affine2 map = fitted_map(from, to);
      bool is_affine = true;
      for (std::size_t i = 0; i < size; ++i) {
        is_affine = is_affine && (map * from[i] - to[i]).norm() <= exact;
      }
      if (is_affine) {
        auto& cubic = own.cubics.emplace_back(part.cubics[k]);
        cubic.points = map * cubic.points;
        cubic.points.col(0) = to.front();
        cubic.points.col(3) = to.back();
      } else if (are_lines[k]) {
        own.cubics.push_back(Cubic::line(samples[0], samples[size - 1]));
      } else {
        Fitter(samples, size, tolerance, own.cubics).fit(firsts[k], lasts[k]);
      }
    }
  }
  return result;
}

}  // namespace flbc::io
