// SPDX-License-Identifier: GPL-3.0-or-later
// Indenter profile interpolated from a table of radii and heights, and its image.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <sstream>

#include "base/numerics/hermite.hpp"

namespace salebra {
namespace {

// Gauss's quadrature rule with eight points, for the interval [−1, 1]: the positive nodes and their
// weights.
constexpr std::array<double, 4> gauss_node{0.1834346424956498, 0.5255324099163290,
                                           0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> gauss_weight{0.3626837833783620, 0.3137066458778873,
                                             0.2223810344533745, 0.1012285362903763};

// The image g(x) = x ∫_0^x f'(r)/√(x² − r²) dr of a profile f(r) that is made of cubic pieces, the
// slope g'(x) and the integral ∫_0^x g.
class Image {
 public:
  struct Point {
    double value, slope, integral;  // g, g', ∫_0^x g
  };

  explicit Image(detail::MonotoneHermite profile) : f_(std::move(profile)) {
    const std::vector<double>& radii = f_.nodes();
    double clear = 0;
    for (std::size_t i = 0; i + 1 < radii.size(); ++i) {
      const double half = 0.5 * (radii[i + 1] - radii[i]), middle = radii[i] + half;
      for_each_node(half, middle, [&](double r, double weight) {
        const auto f = f_.on(i, r);
        nodes_.push_back({r, weight * f.slope, weight * (f.slope + r * f.curvature)});
      });
      clear_.push_back(clear = std::max(clear, middle + 4 * half));
    }
  }

  const detail::MonotoneHermite& profile() const { return f_; }

  Point at(double x) const {
    // On a piece of half width h whose middle is 4h or more from the singularity r = x, Gauss's
    // points are exact to 64/15 (4 + √15)^{−16} = 2e-14 (Trefethen, Approximation Theory and
    // Approximation Practice, theorem 19.3), and their radii do not depend on x.
    const std::size_t far = static_cast<std::size_t>(
        std::upper_bound(clear_.begin(), clear_.end(), x) - clear_.begin());
    double value = 0, slope = 0, integral = 0;
    for (std::size_t k = 0; k < far * 2 * gauss_node.size(); ++k) {
      const Node& node = nodes_[k];
      const double root = std::sqrt((x - node.r) * (x + node.r));
      value += node.slope / root;
      slope += node.image_slope / root;
      integral += node.slope * root;
    }
    // Pieces nearer to r = x are integrated over the angle φ with r = x sinφ, in which f' is smooth
    // up to r = x.
    const std::vector<double>& radii = f_.nodes();
    double from = std::asin(std::min(radii[far] / x, 1.0));
    for (std::size_t i = far; i + 1 < radii.size() && from < std::numbers::pi / 2; ++i) {
      const double to = radii[i + 1] < x ? std::asin(radii[i + 1] / x) : std::numbers::pi / 2;
      for_each_node(0.5 * (to - from), 0.5 * (to + from), [&](double angle, double weight) {
        const double r = std::min(x * std::sin(angle), radii.back());
        const auto f = f_.on(i, r);
        value += weight * f.slope;
        slope += weight * (f.slope + r * f.curvature);
        integral += weight * f.slope * std::pow(x * std::cos(angle), 2);
      });
      from = to;
    }
    return {x * value, slope, integral};
  }

 private:
  struct Node {
    double r, slope, image_slope;  // r; f' and f' + r f'' times weight
  };
  template <class Visit>
  static void for_each_node(double half, double middle, const Visit& visit) {
    for (std::size_t j = 0; j < gauss_node.size(); ++j)
      for (const double side : {-1.0, 1.0})
        visit(middle + side * half * gauss_node[j], half * gauss_weight[j]);
  }

  detail::MonotoneHermite f_;
  std::vector<Node> nodes_;
  std::vector<double> clear_;  // the minimum x from which this piece and all pieces below count as
                               // far
};

}  // namespace

struct TabulatedProfile::Table {
  Image image, of_every_other;
  std::vector<double> images;  // image g at the radii of the table
  double flat_radius = 0;

  const detail::MonotoneHermite& profile() const { return image.profile(); }
  double largest() const { return profile().back(); }
  void require_known(double r) const {
    std::ostringstream constraint;
    constraint << "m lies outside the profile, 0 to " << largest() << " m";
    require(r >= 0 && r <= largest() * (1 + 1e-12), "radius", r, constraint.str());
  }
};

TabulatedProfile::TabulatedProfile(std::vector<double> radii, std::vector<double> heights) {
  constexpr std::size_t fewest = 7;
  require(radii.size() == heights.size(), "profile", radii.size(),
          "radii need the same number of heights");
  require(radii.size() >= fewest, "profile", radii.size(), "points given; give at least seven");
  require(radii.front() == 0, "profile", radii.front(),
          "m is the first radius; the profile must begin on the axis, at 0");
  const double tip = heights.front();
  double flat_radius = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    heights[i] -= tip;
    require(std::isfinite(radii[i]) && std::isfinite(heights[i]), "profile", i + 1,
            "is a row whose radius or height is not a finite number");
    if (i == 0) continue;
    require(radii[i] > radii[i - 1], "profile", i + 1,
            "is a row whose radius is not larger than the one before; sort the rows");
    require(heights[i] >= heights[i - 1], "profile", i + 1,
            "is a row whose height is below the one before, so that the contact would not be a "
            "disc; smooth the profile or cut it there");
    if (heights[i] == 0) flat_radius = radii[i];
  }
  require(heights.back() > 0, "profile", heights.back(),
          "m is the rise of the whole profile; use a flat punch instead");
  std::vector<double> fewer_radii, fewer_heights;
  for (std::size_t i = 0; i < radii.size(); i += 2) {
    fewer_radii.push_back(radii[i]);
    fewer_heights.push_back(heights[i]);
  }
  if (radii.size() % 2 == 0) {
    fewer_radii.push_back(radii.back());
    fewer_heights.push_back(heights.back());
  }
  auto table =
      std::make_unique<Table>(Table{Image({radii, std::move(heights)}),
                                    Image({std::move(fewer_radii), std::move(fewer_heights)}),
                                    {},
                                    flat_radius});
  for (const double radius : radii)
    table->images.push_back(radius > 0 ? table->image.at(radius).value : 0);
  table_ = std::move(table);
  for (const double radius : radii) {
    if (radius < 0.25 * radii.back()) continue;
    const double error = image_error(radius);
    require(error < 0.2, "profile", error,
            "is the relative change of the image g(x) when every other point is left out; give "
            "more points");
  }
}

TabulatedProfile::~TabulatedProfile() = default;

double TabulatedProfile::height(double r) const {
  table_->require_known(r);
  return table_->profile().at(std::min(r, max_radius())).value;
}

double TabulatedProfile::image(double x) const {
  table_->require_known(x);
  return x > 0 ? table_->image.at(x).value : 0;
}

// The slope of the image, g'(x) = ∫ (f' + r f'') dφ over 0 … π/2, with the profile f at r = x sin
// φ.
double TabulatedProfile::image_slope(double x) const {
  table_->require_known(x);
  return x > 0 ? table_->image.at(x).slope : std::numbers::pi / 2 * table_->profile().at(0).slope;
}

// The integral of the image, ∫_0^x g = ∫_0^x f'(r) √(x² − r²) dr, by exchanging the order of the
// two integrals.
double TabulatedProfile::image_integral(double x) const {
  table_->require_known(x);
  return x > 0 ? table_->image.at(x).integral : 0;
}

double TabulatedProfile::flat_radius() const { return table_->flat_radius; }

double TabulatedProfile::max_radius() const { return table_->largest(); }

std::vector<double> TabulatedProfile::breaks() const {
  const std::vector<double>& radii = table_->profile().nodes();
  return {radii.begin() + 1, radii.end()};
}

double TabulatedProfile::contact_radius(double indentation) const {
  require_positive(indentation, "indentation");
  const std::vector<double>& images = table_->images;
  if (indentation >= images.back()) return IndenterProfile::contact_radius(indentation);
  const auto above = std::upper_bound(images.begin(), images.end(), indentation);
  const std::size_t i = static_cast<std::size_t>(above - images.begin());
  const std::vector<double>& radii = table_->profile().nodes();
  // Newton's method, kept in the bracket by bisection: the slope of the image is 0 where a flat end
  // begins.
  double low = radii[i - 1], high = radii[i];
  double x = low + (high - low) * (indentation - images[i - 1]) / (images[i] - images[i - 1]);
  for (int step = 0; step < 200; ++step) {
    const Image::Point point = table_->image.at(x);
    const double excess = point.value - indentation;
    (excess > 0 ? high : low) = x;
    double next = x - excess / point.slope;
    if (!(next >= low && next <= high)) next = low + (high - low) / 2;
    if (std::abs(next - x) <= 2 * std::numeric_limits<double>::epsilon() * x) return next;
    x = next;
  }
  return x;
}

double TabulatedProfile::image_error(double x) const {
  const double full = image(x);
  return full > 0 ? std::abs(table_->of_every_other.at(x).value / full - 1) : 0;
}

}  // namespace salebra
