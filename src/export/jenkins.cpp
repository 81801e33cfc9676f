// SPDX-License-Identifier: GPL-3.0-or-later
// Jenkins sliders (springs in series with Coulomb sliders) in parallel, known as Iwan's model, that
// represent a contact under a constant normal force.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <salebra/base/error.hpp>

#include "base/numerics/quadrature.hpp"
#include "damping/joint_loop.hpp"
#include "formats.hpp"

namespace salebra::detail {
namespace {

/// First loading of the mean of several contacts: the derivative T'(x) of the tangential force T
/// with respect to the displacement x, and the displacement at which the last spring slips.
class Backbone {
 public:
  Backbone(const std::vector<DeckContact>& contacts, double friction_coefficient)
      : contacts_(contacts), friction_(friction_coefficient) {
    for (const DeckContact& contact : contacts) {
      depth_.push_back(stiffness_ratio_of_whole(*contact.law, contact.indentation) / friction_);
      end_ = std::max(end_, (contact.indentation - contact.law->first_touch()) / depth_.back());
      force_ += friction_ * contact.law->force(contact.indentation) / double(contacts.size());
      for (const double depth : contact.law->break_points())
        if (depth < contact.indentation)
          bends_.push_back((contact.indentation - depth) / depth_.back());
    }
    std::ranges::sort(bends_);
  }

  double slip_force() const { return force_; }
  double stiffness(double x) const {
    double sum = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      sum += contacts_[i].law->tangential_stiffness(contacts_[i].indentation - depth_[i] * x);
    return sum / double(contacts_.size());
  }
  /// ∫ weight(x) T'(x) dx between the displacements `from` and `to`.
  double integral(double from, double to, const std::function<double(double)>& weight) const {
    std::vector<double> points{from};
    for (const double bend : bends_)
      if (bend > from && bend < to) points.push_back(bend);
    points.push_back(to);
    return integrate([&](double x) { return weight(x) * stiffness(x); }, points, 1e-12).value;
  }
  double force(double from, double to) const {
    return integral(from, to, [](double) { return 1.; });
  }
  /// The displacement at a tangential force smaller than the largest known one.
  double displacement(double force_there) const {
    double high = force_there / stiffness(0);
    while (high < end_ && force(0, high) < force_there) high *= 2;
    return find_root([&](double x) { return force(0, x) - force_there; }, 0, std::min(high, end_));
  }
  double end() const { return end_; }

 private:
  const std::vector<DeckContact>& contacts_;
  std::vector<double> depth_;  // depth of slip divided by the displacement, for each contact
  double friction_, force_ = 0, end_ = 0;
  std::vector<double> bends_;
};

/// `count` displacements that divide the springs into groups. A slider represents the springs that
/// begin to slip between two of these displacements, and one more slider those that slip later. The
/// steps are constant up to about `first`, then proportional to the displacement.
std::vector<double> edges(double first, double last, int count) {
  // x_i = first · sinh(i h). The relative error of the loss at the amplitude x is half the square
  // of the step over x. If the step at x = first is an eighth of `first`, the error is below 1 %;
  // 60 sliders are enough for this if `first` is a hundredth of `last`.
  std::vector<double> x{0};
  const double a = first, top = std::asinh(last / a);
  for (int i = 1; i < count; ++i) x.push_back(a * std::sinh(top * i / (count - 1)));
  return x;
}

/// Loss of a cycle between the displacements ±amplitude. By Masing's rule it is 8 times the area
/// between the curve of first loading and its chord.
double loss(const Backbone& backbone, double amplitude) {
  // Uses ∫_0^X T dx = ∫_0^X (X − x) T' dx
  return 8 * backbone.integral(0, amplitude, [&](double x) { return amplitude / 2 - x; });
}

/// The displacement amplitude at which the sliders carry a tangential force.
double amplitude_of(const std::vector<Slider>& sliders, double force) {
  double amplitude = 0, held = 0, stiffness = 0;
  for (const Slider& slider : sliders) stiffness += slider.stiffness;
  // The sliders slip one after another; `held` is the total force of those that slip.
  for (const Slider& slider : sliders) {
    amplitude = (force - held) / stiffness;
    if (amplitude <= slider.slider_force / slider.stiffness) break;
    held += slider.slider_force;
    stiffness -= slider.stiffness;
  }
  return amplitude;
}

double loss(const std::vector<Slider>& sliders, double amplitude) {
  double work = 0;
  for (const Slider& slider : sliders)
    work +=
        4 * slider.slider_force * std::max(0., amplitude - slider.slider_force / slider.stiffness);
  return work;
}

/// The largest relative error of the loss: at the forces of displacements at and between some of the
/// edges from `first` on, where the error has its extremes, and at displacements beyond the last
/// edge, where the contact slides as a whole.
double error_of_loss(const SliderSet& set, const Backbone& backbone,
                     const std::vector<double>& edges, double first) {
  double worst = 0;
  const auto compare = [&](double of_sliders, double amplitude) {
    const double error = loss(set.sliders, of_sliders) / loss(backbone, amplitude) - 1;
    if (std::abs(error) > std::abs(worst)) worst = error;
  };
  constexpr std::size_t most = 40;
  const auto begin =
      static_cast<std::size_t>(std::ranges::lower_bound(edges, first * (1 - 1e-9)) - edges.begin());
  const std::size_t step = std::max<std::size_t>(1, (edges.size() - begin) / most);
  for (std::size_t k = begin; k + 1 < edges.size(); k += step)
    for (const double amplitude : {edges[k], (edges[k] + edges[k + 1]) / 2})
      compare(amplitude_of(set.sliders, backbone.force(0, amplitude)), amplitude);
  for (const double factor : {1., 2., 10.}) compare(factor * edges.back(), factor * edges.back());
  return worst;
}

}  // namespace

SliderSet jenkins_sliders(const std::vector<DeckContact>& contacts, double friction_coefficient,
                          int count, double min_force) {
  const Backbone backbone(contacts, friction_coefficient);
  SliderSet set{.sliders = {}, .stiffness = backbone.stiffness(0), .force = backbone.slip_force()};
  // Fraction of the force of all springs that is resolved; the last slider represents all springs
  // that slip later.
  set.resolved = 0.999;
  require(min_force < set.resolved, "min_force", min_force,
          fmt::format("must be below {:.4g}, beyond which one slider holds all that sticks",
                      set.resolved));
  const double smallest = backbone.displacement(min_force * set.force);
  const double last = backbone.displacement(set.resolved * set.force);
  const std::vector<double> x = edges(smallest, last, count);
  double force = 0, stiffness = set.stiffness;  // T and T' at the current displacement
  double rest_force = set.force, rest_stiffness = set.stiffness;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double next_stiffness = backbone.stiffness(x[i]);
    const double next_force = force + backbone.force(x[i - 1], x[i]);
    const Slider slider{stiffness - next_stiffness,
                        next_force - x[i] * next_stiffness - (force - x[i - 1] * stiffness)};
    force = next_force;
    stiffness = next_stiffness;
    if (!(slider.stiffness > 0) || !(slider.slider_force > 0)) continue;  // no spring slips there
    rest_stiffness -= slider.stiffness;
    rest_force -= slider.slider_force;
    set.sliders.push_back(slider);
  }
  set.sliders.push_back({rest_stiffness, rest_force});
  set.loss_error = error_of_loss(set, backbone, x, smallest);
  return set;
}

}  // namespace salebra::detail
