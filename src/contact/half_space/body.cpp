// SPDX-License-Identifier: GPL-3.0-or-later
// Surface responses of linear bodies: half-spaces, layers, graded and anisotropic half-spaces,
// tables.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/body.hpp>

#include "anisotropic.hpp"
#include "base/checksum.hpp"
#include "base/numerics/hermite.hpp"
#include "base/special_values.hpp"
#include "poisson.hpp"

namespace salebra {
namespace {

using detail::infinity;
using detail::unknown;
using std::numbers::pi;

void require_finite_positive(double value, const char* name) {
  require(value > 0 && std::isfinite(value), name, value, "must be > 0 and finite");
}

SurfaceCompliance operator*(double factor, const SurfaceCompliance& c) {
  return {factor * c.normal, factor * c.in_plane, factor * c.across, factor * c.coupling,
          factor * c.mixed};
}

// q times the response of a half-space, 1/Pa, which does not depend on q.
SurfaceCompliance times_wave_number(const ElasticBody& body) {
  const double shear = body.shear(), poisson = body.poisson;
  return {(1 - poisson) / shear, (1 - poisson) / shear, 1 / shear, (1 - 2 * poisson) / (2 * shear)};
}

SurfaceCompliance sum(const SurfaceCompliance& first, const SurfaceCompliance& second) {
  return {first.normal + second.normal, first.in_plane + second.in_plane,
          first.across + second.across, first.coupling - second.coupling,
          first.mixed + second.mixed};
}

// x cosh x − sinh x times e^−x, without the cancellation at small x.
double cosh_less_sinh(double x) {
  if (x > 1) return (x * (1 + std::exp(-2 * x)) + std::expm1(-2 * x)) / 2;
  // Σ 2n x^(2n+1)/(2n+1)!; the terms beyond n = 9 are below 1e-17 of the first.
  double term = x, series = 0;
  for (int n = 1; n <= 9; ++n) {
    term *= x * x / (2 * n * (2 * n + 1));
    series += 2 * n * term;
  }
  return series * std::exp(-x);
}

// Beyond this x = qt, e^−2x x² is below rounding, and nothing below the layer is felt.
constexpr double deep = 25;

// The response q·C of a layer on a body with the response q·C `below`, 1/Pa. The equations of plane
// strain for displacements (in plane, normal) and tractions over µq are y' = Ay with the depth times
// q as variable. A has the double eigenvalues ±1, hence exp(−Ax) = p0 − p1 A + p2 A² − p3 A³.
SurfaceCompliance on_top(const ElasticLayer& layer, double q, const SurfaceCompliance& below) {
  const ElasticBody material{layer.young, layer.poisson};
  const double x = q * layer.thickness;
  if (x > deep) return times_wave_number(material);
  using Matrix = Eigen::Matrix2d;
  const auto matrix = [](double xx, double xz, double zx, double zz) {
    return Matrix{{xx, xz}, {zx, zz}};
  };
  const double poisson = layer.poisson, shear = material.shear();
  const double a = poisson / (1 - poisson), b = (1 - 2 * poisson) / (2 * (1 - poisson)),
               c = 2 / (1 - poisson);
  const double cosh = (1 + std::exp(-2 * x)) / 2, sinh = -std::expm1(-2 * x) / 2;  // times e^−x
  const double p0 = cosh - x * sinh / 2, p1 = (3 * sinh - x * cosh) / 2, p2 = x * sinh / 2,
               p3 = cosh_less_sinh(x) / 2;
  const Matrix square = matrix(p2 * (c - a), 0, 0, -p2 * a);
  const Matrix uu =
      matrix(p0, p1 - p3 * (a - c), -p1 * a - p3 * (a * (c - a) + b * c), p0) + square;
  const Matrix ff =
      matrix(p0, p1 * a - p3 * (a * a - c * (a + b)), -p1 - p3 * (c - a), p0) + square;
  const Matrix uf = matrix(-p1 - p3 * (c - 2 * a - b), -p2 * (a + b), p2 * (a + b),
                           -p1 * b + p3 * a * (a + 2 * b));
  const Matrix fu = matrix(-p1 * c - p3 * c * (c - 2 * a), -p2 * c, p2 * c, p3 * c);
  const Matrix m = shear * matrix(below.in_plane, below.coupling, below.coupling, below.normal);
  const Matrix displacement = uu * m - uf, load = ff - fu * m;
  const double determinant = load(0, 0) * load(1, 1) - load(0, 1) * load(1, 0);
  const Matrix adjugate = matrix(load(1, 1), -load(0, 1), -load(1, 0), load(0, 0));
  const Matrix top = displacement * adjugate / (determinant * shear);
  const double tanh = std::tanh(x), across = shear * below.across;
  return {top(1, 1), top(0, 0), (across + tanh) / (1 + across * tanh) / shear,
          (top(0, 1) + top(1, 0)) / 2};
}

void validate(const GradedHalfSpace& half_space) {
  require_finite_positive(half_space.modulus, "modulus");
  require_finite_positive(half_space.depth, "depth");
  require(half_space.exponent >= 0 && half_space.exponent < 1, "exponent", half_space.exponent,
          "must satisfy 0 <= exponent < 1");
  detail::require_poisson(half_space.poisson);
}

}  // namespace

struct Body::Parts {
  std::function<SurfaceCompliance(double q)> response;
  SurfaceCompliance uniform = {infinity, infinity, infinity, 0};
  std::optional<Material> material = {};
  bool tangential = true;
  Datum datum = Datum::mean_plane;
  // Of a wave vector, if its direction matters; `response` is then the mean over the directions.
  std::function<SurfaceCompliance(double qx, double qy)> directional = {};

  SurfaceCompliance at(double qx, double qy) const {
    return directional ? directional(qx, qy) : response(std::hypot(qx, qy));
  }
};

Body::Body(Parts parts) : parts_(std::make_shared<const Parts>(std::move(parts))) {}

Body Body::half_space(const ElasticBody& first, const ElasticBody& second) {
  const Material material = Material::of_bodies(first, second);
  const auto times_q = [](const ElasticBody& body) {
    return std::isinf(body.young) ? SurfaceCompliance{} : times_wave_number(body);
  };
  const SurfaceCompliance constants = sum(times_q(first), times_q(second));
  return Body({.response = [=](double q) { return 1 / q * constants; }, .material = material});
}

Body::Body(const Material& material)
    : Body(Parts{
          .response = [constants =
                           SurfaceCompliance{
                               2 / material.contact_modulus, 2 * pi * material.cerruti_isotropic,
                               2 * pi * (material.cerruti_isotropic + material.cerruti_directed),
                               std::numeric_limits<double>::quiet_NaN()}](
                          double q) { return 1 / q * constants; },
          .material = material,
          .tangential = !std::isnan(material.cerruti_isotropic)}) {}

Body Body::layered(const std::vector<ElasticLayer>& layers, const ElasticBody& base) {
  require_that(!layers.empty(), "layers", "not given; give at least one");
  require(base.young > 0, "young", base.young, "must be > 0 (infinity: rigid)");
  detail::require_poisson(base.poisson);
  const bool rigid = std::isinf(base.young);
  SurfaceCompliance uniform;
  for (const ElasticLayer& layer : layers) {
    require_finite_positive(layer.thickness, "thickness");
    require_finite_positive(layer.young, "young");
    detail::require_poisson(layer.poisson);
    const double per_shear = layer.thickness / ElasticBody{layer.young, layer.poisson}.shear();
    const SurfaceCompliance part{(1 - 2 * layer.poisson) / (2 * (1 - layer.poisson)) * per_shear,
                                 per_shear, per_shear, 0};
    uniform = sum(uniform, part);
  }
  const SurfaceCompliance lowest = rigid ? SurfaceCompliance{} : times_wave_number(base);
  Parts parts{.response = [=](double q) {
    // Layers below one that is deep for this wave are not felt.
    auto first = std::ranges::find_if(
        layers, [=](const ElasticLayer& layer) { return q * layer.thickness > deep; });
    if (first != layers.end()) ++first;
    SurfaceCompliance response = lowest;
    for (auto layer = first; layer != layers.begin();) response = on_top(*--layer, q, response);
    return 1 / q * response;
  }};
  if (rigid) parts.uniform = uniform;
  return Body(std::move(parts));
}

double Body::graded_modulus(const GradedHalfSpace& half_space) {
  validate(half_space);
  const double k = half_space.exponent, poisson = half_space.poisson;
  const double beta = std::sqrt((1 + k) * (1 - k * poisson / (1 - poisson)));
  const double c = std::pow(2, 1 + k) * std::tgamma((3 + k + beta) / 2) *
                   std::tgamma((3 + k - beta) / 2) / (pi * std::tgamma(2 + k));
  return half_space.modulus / (1 - poisson * poisson) * 2 * (1 + k) * std::cos(k * pi / 2) *
         std::tgamma(1 + k / 2) /
         (std::sqrt(pi) * c * beta * std::sin(beta * pi / 2) * std::tgamma((1 + k) / 2));
}

Body Body::graded(const GradedHalfSpace& half_space) {
  const double c_n = graded_modulus(half_space);
  const double k = half_space.exponent, poisson = half_space.poisson;
  const double shear = ElasticBody{half_space.modulus, poisson}.shear();
  const double across = std::pow(2, -k) * std::tgamma((1 - k) / 2) / std::tgamma((1 + k) / 2) *
                        std::pow(half_space.depth, k);
  const double normal = 2 * std::cos(k * pi / 2) * across / c_n;
  const SurfaceCompliance at_one{normal, normal * (1 + k) / (1 - k * poisson / (1 - poisson)),
                                 across / shear, unknown};
  return Body({.response = [=](double q) { return std::pow(q, k - 1) * at_one; }});
}

Body Body::transversely_isotropic(const TransverseStiffness& stiffness) {
  const auto& [c11, c33, c13, c44, c66] = stiffness;
  for (const auto& [value, name] :
       {std::pair(c11, "c11"), {c33, "c33"}, {c44, "c44"}, {c66, "c66"}})
    require_finite_positive(value, name);
  require(c11 > c66, "c66", c66, "must be below c11");
  require(c33 * (c11 - c66) > c13 * c13, "c13", c13, "must satisfy c13² < c33(c11 − c66)");
  const double root = std::sqrt(c11 * c33);
  const double modulus =
      2 * std::sqrt((root - c13) * (root + c13) / c11 / (1 / c44 + 2 / (root + c13)));
  const SurfaceCompliance at_one{2 / modulus, 2 / modulus * std::sqrt(c33 / c11),
                                 1 / std::sqrt(c44 * c66), 1 / (c13 + root)};
  return Body({.response = [=](double q) { return 1 / q * at_one; }});
}

Body Body::anisotropic(const AnisotropicStiffness& stiffness) {
  const auto times_q = std::make_shared<const detail::AngularResponse>(stiffness);
  return Body({.response = [=](double q) { return 1 / q * times_q->mean(); },
               .directional =
                   [=](double qx, double qy) {
                     const double q = std::hypot(qx, qy);
                     return 1 / q * times_q->along(qx / q, qy / q);
                   }});
}

Body Body::tabulated(const ComplianceTable& table) {
  const std::vector<double>& q = table.wavenumber;
  require(q.size() >= 4, "wavenumber", q.size(), "values given; give at least 4");
  for (std::size_t k = 0; k < q.size(); ++k) {
    require_finite_positive(q[k], "wavenumber");
    require(k == 0 || q[k] > q[k - 1], "wavenumber", q[k], "must increase");
  }
  for (const auto& [values, name] : {std::pair(&table.normal, "normal"),
                                     {&table.in_plane, "in_plane"},
                                     {&table.across, "across"}}) {
    if (values != &table.normal && table.in_plane.empty() && table.across.empty()) continue;
    require(values->size() == q.size(), name, values->size(),
            "values given; give one for each wave number");
    for (const double value : *values) require_finite_positive(value, name);
  }
  for (const auto& [value, name] : {std::pair(table.uniform_normal, "uniform_normal"),
                                    {table.uniform_tangential, "uniform_tangential"}})
    require(value >= 0, name, value, "must be >= 0 (infinity: no base)");
  const auto logarithms = [](std::vector<double> values) {
    for (double& value : values) value = std::log(value);
    return values;
  };
  using Curve = detail::MonotoneHermite;
  const auto curve_of = [&](const std::vector<double>& values) {
    return values.empty() ? std::optional<Curve>()
                          : Curve(logarithms(table.wavenumber), logarithms(values));
  };
  const auto value = [](const std::optional<Curve>& curve, double log_q) {
    return curve ? std::exp(curve->at(log_q).value) : unknown;
  };
  Parts parts{.response = [=, normal = curve_of(table.normal), in_plane = curve_of(table.in_plane),
                           across = curve_of(table.across), first = q.front(),
                           last = q.back()](double wave) {
    // A solve asks for the waves of its grid in other units, with rounding.
    constexpr double rounding = 1e-12;
    require(wave >= first * (1 - rounding) && wave <= last * (1 + rounding), "wavenumber", wave,
            "is beyond the table of the body; let the table cover all waves of the grid");
    const double log_q = std::clamp(std::log(wave), normal->front(), normal->back());
    return SurfaceCompliance{value(normal, log_q), value(in_plane, log_q), value(across, log_q),
                             unknown};
  }};
  parts.uniform = {table.uniform_normal, table.uniform_tangential, table.uniform_tangential, 0};
  parts.tangential = !table.in_plane.empty();
  return Body(std::move(parts));
}

Body Body::pair(const Body& first, const Body& second) {
  require(first.datum() == second.datum(), "datum", name_of(second.datum()),
          "differs from that of the first body; measure both from the same");
  const auto a = first.parts_, b = second.parts_;
  Parts parts{.response = [=](double q) { return sum(a->response(q), b->response(q)); },
              .uniform = sum(a->uniform, b->uniform),
              .tangential = a->tangential && b->tangential,
              .datum = a->datum};
  if (a->directional || b->directional)
    parts.directional = [=](double qx, double qy) { return sum(a->at(qx, qy), b->at(qx, qy)); };
  return Body(std::move(parts));
}

Body Body::measured_from(Datum datum) const {
  require(
      datum == Datum::mean_plane ||
          (std::isfinite(parts_->uniform.normal) && std::isfinite(parts_->uniform.in_plane)),
      "datum", name_of(datum),
      "needs a rigid base, because a uniform load displaces a half-space without limit; measure "
      "from the mean plane");
  if (datum == parts_->datum) return *this;
  Parts changed = *parts_;
  changed.datum = datum;
  return Body(std::move(changed));
}

Datum Body::datum() const { return parts_->datum; }

SurfaceCompliance Body::compliance(double wavenumber) const {
  require(wavenumber >= 0 && std::isfinite(wavenumber), "wavenumber", wavenumber,
          "must be >= 0 and finite");
  if (wavenumber > 0) return parts_->response(wavenumber);
  return parts_->datum == Datum::base ? parts_->uniform : SurfaceCompliance{};
}

SurfaceCompliance Body::compliance(double qx, double qy) const {
  const double q = std::hypot(qx, qy);
  return parts_->directional && q > 0 && std::isfinite(q) ? parts_->directional(qx, qy)
                                                          : compliance(q);
}

bool Body::is_directional() const { return parts_->directional != nullptr; }

bool Body::has_tangential_response() const { return parts_->tangential; }

const std::optional<Material>& Body::half_space_material() const { return parts_->material; }

std::string Body::fingerprint() const {
  if (parts_->material) return {};
  std::string text(name_of(datum()));
  const auto add = [&](double q, double angle) {
    SurfaceCompliance one{unknown, unknown, unknown, unknown};
    try {
      one = compliance(q * std::cos(angle), q * std::sin(angle));
    } catch (const InvalidInput&) {
      // A table ends at this wave.
    }
    text += fmt::format(" {:.8e} {:.8e} {:.8e}", one.normal, one.in_plane, one.across);
    // Without the rounding of what is zero by symmetry.
    if (is_directional()) text += fmt::format(" {:.8f}", one.mixed / one.normal);
  };
  for (int k = 0; k <= 40; ++k) add(2e9 * pi * std::pow(10, -k / 4.0), 0);
  for (int k = 1; k < 8 && is_directional(); ++k) add(1e6, k * pi / 8);
  return detail::Checksum(text).digits();
}

double Body::modulus_ratio() const {
  return parts_->material ? parts_->material->modulus_ratio() : unknown;
}

}  // namespace salebra
