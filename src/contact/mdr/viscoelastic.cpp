// SPDX-License-Identifier: GPL-3.0-or-later
// Prony series, the springs of a viscoelastic foundation, and normal contact along a path.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/viscoelastic.hpp>
#include <string>
#include <utility>

#include "base/numerics/dense_systems.hpp"
#include "base/stop_check.hpp"
#include "viscoelastic_spring.hpp"

namespace salebra {
namespace detail {

MaxwellSpring::MaxwellSpring(const PronySeries& prony) {
  prony.validate();
  const Index count = static_cast<Index>(prony.terms.size());
  ratio_.resize(count);
  time_.resize(count);
  for (Index i = 0; i < count; ++i) {
    const PronyTerm& term = prony.terms[static_cast<std::size_t>(i)];
    ratio_[i] = term.modulus / prony.relaxed_modulus;
    time_[i] = term.relaxation_time;
  }
  unrelaxed_ = 1 + ratio_.sum();
  // A spring without force: w is its displacement, y_i the stretch of Maxwell branch i, r_i its
  // stiffness ratio and τ_i its relaxation time. Then w' = Σ r_i y_i/τ_i / (1 + Σ r_i) and y_i' =
  // w' − y_i/τ_i, a system with a symmetric matrix in the variables √(r_i/τ_i) y_i.
  const Eigen::VectorXd scale = (ratio_ / time_).sqrt();
  const Eigen::MatrixXd rates = Eigen::MatrixXd(time_.inverse().matrix().asDiagonal()) -
                                scale * scale.transpose() / unrelaxed_;
  if (count > 0) {
    const Modes modes = symmetric_modes(rates);
    mode_rates_ = modes.values.array();
    to_modes_ = modes.vectors.transpose() * scale.asDiagonal();
    from_modes_ = scale.cwiseInverse().asDiagonal() * modes.vectors;
  } else {
    mode_rates_ = ratio_;
    to_modes_ = from_modes_ = rates;
  }
  mode_displacement_ = -(from_modes_.transpose() * ratio_.matrix()).array();
}

Stretching MaxwellSpring::stretching(double duration) const {
  Stretching step{Branches(terms()), Branches(terms()), Branches(terms())};
  for (Index i = 0; i < terms(); ++i) {
    const double a = duration / time_[i];
    step.decay[i] = std::exp(-a);
    step.gain[i] = a > 0 ? -std::expm1(-a) / a : 1;
    // (1 − gain)/a, for small a by its series in a, because the difference cancels; the first
    // omitted term is a⁴/720.
    step.mean_gain[i] =
        a > 1e-3 ? (1 - step.gain[i]) / a : 0.5 - a * (1.0 / 6 - a * (1.0 / 24 - a / 120));
  }
  return step;
}

SpringPath::SpringPath(const MaxwellSpring& spring, std::span<const double> time,
                       std::span<const double> springs)
    : indentation(springs.begin(), springs.end()) {
  for (std::size_t i = 1; i < time.size(); ++i) {
    duration.push_back(time[i] - time[i - 1]);
    stretching.push_back(spring.stretching(duration.back()));
    mode_decay.push_back(spring.mode_decay(duration.back()));
  }
}

SpringLayout::SpringLayout(const IndenterProfile& profile, double from, double to, int springs) {
  if (!(to > from)) return;
  const double flat = std::min(profile.flat_radius(), to);
  if (from < flat) cells.push_back({0.5 * (from + flat), flat, flat - from, 0});
  const double begin = std::max(from, flat), width = (to - begin) / springs;
  if (!(width > 0)) return;
  for (int i = 0; i < springs; ++i) {
    const double middle = begin + (i + 0.5) * width;
    cells.push_back({middle, middle, width, profile.image(middle)});
  }
}

}  // namespace detail

PronySeries PronySeries::of_body(const Material& relaxed, std::vector<PronyTerm> terms) {
  const double ratio = relaxed.modulus_ratio();
  return {relaxed.contact_modulus * ratio / (2 * (2 - ratio)), std::move(terms)};
}

double PronySeries::unrelaxed_modulus() const {
  double sum = relaxed_modulus;
  for (const PronyTerm& term : terms) sum += term.modulus;
  return sum;
}

std::complex<double> PronySeries::complex_modulus(double angular_frequency) const {
  std::complex<double> sum = relaxed_modulus;
  for (const PronyTerm& term : terms) {
    const std::complex<double> phase(0, angular_frequency * term.relaxation_time);
    sum += term.modulus * phase / (1.0 + phase);
  }
  return sum;
}

void PronySeries::validate() const {
  require_positive(relaxed_modulus, "relaxed_modulus");
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::string which = " of term " + std::to_string(i + 1) + " of the series must be ";
    require(std::isfinite(terms[i].modulus) && terms[i].modulus > 0, "prony", terms[i].modulus,
            "Pa, the modulus" + which + "> 0; leave the term out");
    require(std::isfinite(terms[i].relaxation_time) && terms[i].relaxation_time > 0, "prony",
            terms[i].relaxation_time, "s, the relaxation time" + which + "> 0; leave the term out");
  }
}

ViscoelasticIndentation viscoelastic_indentation(const IndenterLaw& law, const PronySeries& prony,
                                                 std::span<const double> time,
                                                 std::span<const double> indentation, int springs) {
  require(time.size() >= 2, "time", time.size(), "samples given; give at least 2");
  require(indentation.size() == time.size(), "indentation", indentation.size(),
          "values do not match the times; give one for each");
  for (std::size_t i = 0; i < time.size(); ++i) {
    require(std::isfinite(time[i]) && (i == 0 || time[i] > time[i - 1]), "time", time[i],
            "s must be finite and later than the sample before");
    require(std::isfinite(indentation[i]), "indentation", indentation[i], "must be finite");
  }
  require(springs >= 8, "springs", springs, "must be >= 8");
  const detail::MaxwellSpring spring(prony);
  const detail::SpringPath path(spring, time, indentation);
  const double largest = law.contact_radius(std::ranges::max(indentation));
  detail::SpringLayout layout(law.profile(), 0, largest, springs);
  // The outermost cell has no width, so its spring carries no load; it serves to interpolate the
  // contact radius between springs.
  layout.cells.push_back({largest, largest, 0, law.profile().image(largest)});

  ViscoelasticIndentation result;
  const std::size_t samples = time.size();
  result.force.resize(samples);
  result.contact_radius.resize(samples);
  // At each time, the clearance of the next spring towards the axis; the first spring has none.
  std::vector<double> inner_clearance(samples, 0);
  double inner_edge = 0;
  for (const detail::SpringLayout::Cell& cell : layout.cells) {
    detail::NormalSpring state(spring, cell.spring_depth);
    state.start(indentation[0], detail::Branches::Zero(spring.terms()));
    for (std::size_t i = 0; i < samples; ++i) {
      detail::stop_if_asked();
      if (i > 0) state.advance(path, i - 1, [](bool, double, double) {});
      result.force[i] += 2 * law.contact_modulus() * cell.width * state.force(indentation[i]);
      const double inner = inner_clearance[i], clearance = state.clearance(indentation[i]);
      if (clearance < 0)
        result.contact_radius[i] = cell.edge;
      else if (inner < 0)
        result.contact_radius[i] =
            inner_edge + (cell.edge - inner_edge) * inner / (inner - clearance);
      inner_clearance[i] = clearance;
    }
    inner_edge = cell.edge;
    result.spring_position.push_back(cell.middle);
    result.spring_load.push_back(2 * law.contact_modulus() * state.force(indentation.back()));
    result.spring_displacement.push_back(state.displacement(indentation.back()));
  }
  return result;
}

}  // namespace salebra
