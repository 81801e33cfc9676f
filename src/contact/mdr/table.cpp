// SPDX-License-Identifier: GPL-3.0-or-later
// Indenter profile interpolated from a table of radii and heights, and its image.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <sstream>

#include "contact/hermite.hpp"
#include "contact/quadrature.hpp"

namespace salebra {
namespace {

template <int Pairs>
struct GaussRule {
  double node[Pairs], weight[Pairs];  // of the half above the middle
};
constexpr GaussRule<2> four_points{{0.3399810435848563, 0.8611363115940526},
                                   {0.6521451548625461, 0.3478548451374538}};
constexpr GaussRule<4> eight_points{
    {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363},
    {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763}};

// Σ over the pieces of f below x of ∫ integrand(r, f', f'') dφ, r = x sinφ. On each piece f' is a parabola in r,
// hence smooth in φ. Its eighth derivative in φ is at most 2⁷x²f''' ≈ 2⁷f'/w² on a piece of width w, and four Gauss
// points leave 5.6e-10 w⁸ of it: less than round-off for w < 0.05. Eight points are exact to round-off on any piece.
template <class Integrand>
double sum_of_pieces(const detail::MonotoneHermite& f, double x, const Integrand& integrand) {
  const std::vector<double>& radii = f.nodes();
  double sum = 0, from = 0;
  for (std::size_t i = 1; i < radii.size() && from < std::numbers::pi / 2; ++i) {
    const double to = radii[i] < x ? std::asin(radii[i] / x) : std::numbers::pi / 2;
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    const auto add = [&]<int Pairs>(const GaussRule<Pairs>& rule) {
      for (int j = 0; j < Pairs; ++j)
        for (const double side : {-1.0, 1.0}) {
          const double angle = middle + side * half * rule.node[j];
          const double r = std::min(x * std::sin(angle), radii.back());
          sum += rule.weight[j] * half * integrand(angle, r, f.on(i - 1, r));
        }
    };
    if (half < 0.025)
      add(four_points);
    else
      add(eight_points);
    from = to;
  }
  return sum;
}

double image_of(const detail::MonotoneHermite& f, double x) {
  return x * sum_of_pieces(f, x, [](double, double, const auto& point) { return point.slope; });
}

}  // namespace

struct TabulatedProfile::Table {
  detail::MonotoneHermite height, every_other;
  std::vector<double> images;  // g at the radii
  double flat_radius = 0;

  void require_known(double r) const {
    std::ostringstream constraint;
    constraint << "m lies outside the profile, 0 to " << height.back() << " m";
    require(r >= 0 && r <= height.back() * (1 + 1e-12), "radius", r, constraint.str());
  }
};

TabulatedProfile::TabulatedProfile(std::vector<double> radii, std::vector<double> heights) {
  constexpr std::size_t fewest = 7;
  require(radii.size() == heights.size(), "profile", radii.size(),
          "radii must come with as many heights");
  require(radii.size() >= fewest, "profile", radii.size(),
          "points are too few; give at least seven");
  require(radii.front() == 0, "profile", radii.front(),
          "m is the first radius, but the profile must begin on the axis, at 0");
  const double tip = heights.front();
  double flat_radius = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    heights[i] -= tip;
    require(std::isfinite(radii[i]) && std::isfinite(heights[i]), "profile", i + 1,
            "is a row whose radius or height is not a finite number");
    if (i == 0) continue;
    require(radii[i] > radii[i - 1], "profile", i + 1,
            "is a row whose radius is not larger than the one before; sort the rows");
    require(
        heights[i] >= heights[i - 1], "profile", i + 1,
        "is a row whose height is below the one before: the contact would not be a disc; smooth "
        "the profile or cut it there");
    if (heights[i] == 0) flat_radius = radii[i];
  }
  require(heights.back() > 0, "profile", heights.back(),
          "m is the whole rise; use a flat punch instead");
  std::vector<double> fewer_radii, fewer_heights;
  for (std::size_t i = 0; i < radii.size(); i += 2) {
    fewer_radii.push_back(radii[i]);
    fewer_heights.push_back(heights[i]);
  }
  if (radii.size() % 2 == 0) {
    fewer_radii.push_back(radii.back());
    fewer_heights.push_back(heights.back());
  }
  auto table = std::make_unique<Table>(
      Table{detail::MonotoneHermite(radii, std::move(heights)),
            detail::MonotoneHermite(std::move(fewer_radii), std::move(fewer_heights)),
            {},
            flat_radius});
  for (const double radius : radii) table->images.push_back(image_of(table->height, radius));
  table_ = std::move(table);
  for (const double radius : radii) {
    if (radius < 0.25 * radii.back()) continue;
    const double error = image_error(radius);
    require(
        error < 0.2, "profile", error,
        "is the relative change of its image g(x) when every other point is left out; sample it "
        "more finely");
  }
}

TabulatedProfile::~TabulatedProfile() = default;

double TabulatedProfile::height(double r) const {
  table_->require_known(r);
  return table_->height.at(std::min(r, largest_radius())).value;
}

double TabulatedProfile::image(double x) const {
  table_->require_known(x);
  return image_of(table_->height, x);
}

// g' = ∫ (f' + r f'') dφ.
double TabulatedProfile::image_slope(double x) const {
  table_->require_known(x);
  return sum_of_pieces(table_->height, x, [](double, double r, const auto& point) {
    return point.slope + r * point.curvature;
  });
}

// ∫_0^x g = ∫_0^x f'(r) √(x² − r²) dr, by exchange of the integrals.
double TabulatedProfile::image_integral(double x) const {
  table_->require_known(x);
  return x * x * sum_of_pieces(table_->height, x, [](double angle, double, const auto& point) {
           return point.slope * std::cos(angle) * std::cos(angle);
         });
}

double TabulatedProfile::flat_radius() const { return table_->flat_radius; }

double TabulatedProfile::largest_radius() const { return table_->height.back(); }

std::vector<double> TabulatedProfile::breaks() const {
  const std::vector<double>& radii = table_->height.nodes();
  return {radii.begin() + 1, radii.end()};
}

double TabulatedProfile::contact_radius(double indentation) const {
  require_positive(indentation, "indentation");
  const std::vector<double>& images = table_->images;
  if (indentation >= images.back()) return IndenterProfile::contact_radius(indentation);
  const auto above = std::upper_bound(images.begin(), images.end(), indentation);
  const std::size_t i = static_cast<std::size_t>(above - images.begin());
  const std::vector<double>& radii = table_->height.nodes();
  return detail::find_root([&](double x) { return image_of(table_->height, x) - indentation; },
                           radii[i - 1], radii[i]);
}

double TabulatedProfile::image_error(double x) const {
  const double full = image(x);
  return full > 0 ? std::abs(image_of(table_->every_other, x) / full - 1) : 0;
}

}  // namespace salebra
