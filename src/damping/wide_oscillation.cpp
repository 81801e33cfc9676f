// SPDX-License-Identifier: GPL-3.0-or-later
// Losses of a surface under wide oscillations, from a law through contacts between first touch and
// the largest force of the motions.
#include "wide_oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/damping/dissipation.hpp>
#include <utility>

#include "continued_law.hpp"
#include "max_motion.hpp"
#include "phase_quadrature.hpp"

namespace salebra::detail {
namespace {

constexpr int max_intervals = 64;
// The lowest contact carries this fraction of the lowest load. What the law is below it changes the
// loss by less than 0.1 % in most motions.
constexpr double lowest_share = 0.01;
// Halving the intervals ends when it changes each loss by less than this fraction.
constexpr double enough = 0.01;
// Tolerance of the contact solver. The correction of each force leaves its square.
constexpr double contact_tolerance = 1e-8;
constexpr double quadrature_tolerance = 1e-6;

/// Law of springs whose K_t jumps from one value to the next: the sum of w over the springs.
struct SpringSum {
  double total = 0, opening = 0;
};

/// ∫w dK_t over the springs of a law between its first touch and the largest indentation, and its
/// part by springs that open.
SpringSum sum_over_springs(const ContactLaw& law, double lowest_contact, double mean,
                           double amplitude, const LossOfSpring& loss) {
  constexpr int parts = 16;
  const double least = mean - amplitude, top = mean + amplitude;
  // A law that never opens carries nothing at 20 F/K below its lowest contact.
  const double end =
      lowest_contact - 20 * law.force(lowest_contact) / law.normal_stiffness(lowest_contact);
  const double bottom = std::max({law.first_touch(), least - loss.depth(), end});
  std::vector<double> ends = law.break_points();
  ends.insert(ends.end(), {bottom, least, least - loss.depth(), top});
  std::erase_if(ends, [&](double point) { return !(point >= bottom && point <= top); });
  std::ranges::sort(ends);
  SpringSum sum;
  double below = law.tangential_stiffness(bottom);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (int part = 1; part <= parts; ++part) {
      const double width = ends[i + 1] - ends[i];
      if (!(width > 0)) continue;
      const double above = law.tangential_stiffness(ends[i] + width * part / parts);
      const double middle = ends[i] + width * (part - 0.5) / parts;
      const double work = (above - below) * loss(middle - mean);
      sum.total += work;
      if (middle > least) sum.opening += work;
      below = above;
    }
  return sum;
}

}  // namespace

WideOscillation::WideOscillation(const Body& body, const Oscillation& motion,
                                 const SurfaceDampingOptions& options, Hold hold, double direction,
                                 std::vector<Load> loads, RatioOfLoads of_curve)
    : body_(body),
      modulus_ratio_(modulus_ratio_of(body)),
      motion_(motion),
      options_(options),
      hold_(hold),
      direction_(direction),
      loads_(std::move(loads)),
      ratio_(std::move(of_curve)),
      sticks_(!ratio_.empty()),
      amplitude_(normal_amplitude(motion)),
      possible_amplitude_(loads_.size(), Loss::unknown) {
  if (!sticks_) ratio_ = RatioOfLoads({{.force = 1, .ratio = 1}});
}

/// Solves further contacts, each at a higher indentation, until the law through the contacts covers
/// the motion about a load. Returns false if only a surface in full contact would.
bool WideOscillation::reach(SurfaceContacts& contacts_at, std::vector<StiffnessSample>& contacts,
                            std::size_t load) {
  constexpr int max_steps = 40;
  const double force = loads_[load].force;
  for (int step = 0; step < max_steps && contacts_at.usable(); ++step) {
    const SurfaceLaw law(contacts, ratio_, modulus_ratio_);
    const double needed = mean_indentation(law, force, amplitude_, hold_) + amplitude_;
    if (needed <= law.highest_indentation()) return true;
    const auto next = further_indentation(law, needed, contacts_at.limit(), hold_);
    if (!next) {
      possible_amplitude_[load] = detail::possible_amplitude(
          law, force, amplitude_, hold_,
          hold_ == Hold::force ? law.highest_indentation() : contacts_at.limit());
      return false;
    }
    contacts.push_back(contacts_at.at(*next));
  }
  return false;
}

/// Finds the range of indentations that all possible motions pass on the first grid.
void WideOscillation::find_range(SurfaceContacts& contacts_at) {
  const auto [low, high] = std::ranges::minmax(loads_, {}, &Load::pressure);
  lowest_ = contacts_at.indentation_at(lowest_share * low.pressure);
  const double at_rest = contacts_at.indentation_at(high.pressure);
  // The highest load must lie within the law through these contacts.
  const double rest =
      at_rest + std::min(0.1 * (at_rest - lowest_), (contacts_at.limit() - at_rest) / 2);
  std::vector<StiffnessSample> contacts;
  for (int k = 0; k <= 4 && contacts_at.usable(); ++k)
    contacts.push_back(contacts_at.at(std::lerp(lowest_, rest, k / 4.0)));
  bool possible = false;
  for (std::size_t k = 0; k < loads_.size(); ++k)
    possible = reach(contacts_at, contacts, k) || possible;
  if (!possible || !contacts_at.usable()) return;
  const SurfaceLaw law(contacts, ratio_, modulus_ratio_);
  highest_ = lowest_;
  for (std::size_t k = 0; k < loads_.size(); ++k)
    if (std::isnan(possible_amplitude_[k]))
      highest_ = std::max(highest_,
                          mean_indentation(law, loads_[k].force, amplitude_, hold_) + amplitude_);
  // The law through other contacts, or on other cells, may need a little more.
  peak_force_ = law.force(highest_);
  const double margin = 0.1 * law.force(highest_) / law.normal_stiffness(highest_);
  highest_ += std::min(margin, (contacts_at.limit() - highest_) / 2);
}

std::vector<StiffnessSample> WideOscillation::contacts_on(SurfaceContacts& contacts_at,
                                                          int intervals) const {
  const double shift = contacts_at.peak() - peak_;
  std::vector<StiffnessSample> contacts;
  for (int k = intervals; k >= 0 && contacts_at.usable(); --k) {
    // The same expression for every number of intervals, so that contacts are found again.
    const int part = k * (max_intervals / intervals);
    contacts.push_back(contacts_at.at(shift + lowest_ +
                                      (highest_ - lowest_) * double(part) / double(max_intervals)));
  }
  return contacts;
}

/// Computes K_t by stick solves at loads that the curve does not have.
void WideOscillation::add_ratios(SurfaceContacts& contacts_at,
                                 const std::vector<StiffnessSample>& contacts) {
  std::vector<StiffnessRatio::Point> points;
  const std::size_t quarter = (contacts.size() - 1) / 4;
  for (std::size_t k = 0; k < 4 * quarter; k += quarter)
    if (!ratio_.knows(contacts[k].force))
      points.push_back(contacts_at.ratio_at(contacts[k].indentation, direction_));
  ratio_.add(points);
}

WideLoss WideOscillation::loss_of(const std::vector<StiffnessSample>& contacts, std::size_t load,
                                  const RatioOfLoads& ratio, bool exponential) const {
  const SurfaceLaw table(contacts, ratio, modulus_ratio_);
  const ContinuedLaw continued(table, BelowTable::exponential);
  const ContactLaw& law = exponential ? static_cast<const ContactLaw&>(continued) : table;
  WideLoss loss;
  const double mean = mean_indentation(law, loads_[load].force, amplitude_, hold_);
  const DampingResult result =
      damping_about(law, mean, std::visit([](const auto& m) { return Motion(m); }, motion_),
                    quadrature_tolerance);
  loss.without_slip.work = result.work_per_cycle;
  loss.indentation = mean;
  loss.mean_force = result.mean_force;
  loss.max_force = result.max_force;
  loss.contact_time = result.contact_time;
  loss.converged = result.error_estimate <= 100 * quadrature_tolerance * result.work_per_cycle;
  const double lowest = table.lowest_indentation();
  if (const auto spring = spring_of(table, ratio, mean + amplitude_)) {
    const SpringSum springs = sum_over_springs(law, lowest, mean, amplitude_, *spring);
    loss.with_slip.work = springs.total;
    loss.relaxation_work = springs.opening;
  }
  return loss;
}

/// The loss of one spring with friction; empty if it is not known.
std::optional<LossOfSpring> WideOscillation::spring_of(const ContactLaw& law,
                                                       const RatioOfLoads& ratio,
                                                       double top) const {
  const double friction = options_.friction_coefficient;
  // The loss with slip under a drag depends on the distance between its turning points.
  if (std::isnan(friction) ||
      (std::holds_alternative<Drag>(motion_) && std::isnan(options_.excursion)))
    return {};
  // With this mean of ρ over the springs, their stretch limits add up to μF at the largest force.
  constexpr int parts = 64;
  const double lowest = law.lowest_indentation();
  double before = law.force(lowest), sum = ratio.at(before) * before;
  for (int part = 1; part <= parts; ++part) {
    const double force = law.force(std::lerp(lowest, top, double(part) / parts));
    sum += ratio.at((force + before) / 2) * (force - before);
    before = force;
  }
  return LossOfSpring(motion_, friction / (modulus_ratio_ * sum / before), options_.excursion);
}

/// The relative scatter of K about the indentation `least`. Cells and contact patches enter singly,
/// so that K scatters about a smooth function. Simpson's rule gives the differences of the forces
/// from the stiffnesses of three contacts; its deviations about `least` show how much K scatters.
double WideOscillation::scatter(const std::vector<StiffnessSample>& contacts, double least) {
  constexpr std::size_t triples_above = 3;
  if (!(least > 0)) return 0;
  const auto first_below = std::ranges::find_if(
      contacts, [&](const StiffnessSample& one) { return one.indentation < least; });
  const auto at = std::size_t(first_below - contacts.begin());
  double sum = 0;
  int count = 0;
  for (std::size_t k = at > triples_above ? at - triples_above : 0;
       k + 2 < contacts.size() && k <= at; ++k) {
    const StiffnessSample &high = contacts[k], &middle = contacts[k + 1], &low = contacts[k + 2];
    if (!(low.force > 0)) break;
    const double part = (high.indentation - low.indentation) / 6;
    const double by_stiffness = part * (high.stiffness + 4 * middle.stiffness + low.stiffness);
    // The variance of the weighted sum is 18 times that of one stiffness.
    const double deviation = (high.force - low.force - by_stiffness) / (part * middle.stiffness);
    sum += deviation * deviation / 18;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

/// Adds the noise of a loss. The scatter of K averages out over the springs that open; but the loss
/// also depends on K at the smallest indentation, above which springs open.
void WideOscillation::add_noise(WideLoss& loss,
                                const std::vector<StiffnessSample>& contacts) const {
  const double least = loss.indentation - amplitude_;
  const SurfaceLaw law(contacts, ratio_, modulus_ratio_);
  const double deviation = scatter(contacts, least) * law.tangential_stiffness(least);
  const double step = contacts[0].indentation - contacts[1].indentation;
  static const std::vector<Node> nodes = gauss_nodes(8);
  loss.without_slip.deviation =
      std::abs(deviation * detail::loss(motion_, nodes, [](std::size_t) { return 0.0; }, 1.0));
  if (const auto spring = spring_of(law, ratio_, loss.indentation + amplitude_))
    loss.with_slip.deviation =
        deviation * std::abs((*spring)(-amplitude_) - (*spring)(-amplitude_ - step));
}

NormalContactOptions WideOscillation::contact_options(const Progress& progress) const {
  NormalContactOptions contact;
  contact.boundary = options_.boundary;
  contact.on_progress = progress;
  contact.tolerance = contact_tolerance;
  return contact;
}

/// Finds the range of the contacts on the first grid. Returns whether this is the first grid.
bool WideOscillation::begin(SurfaceContacts& contacts_at) {
  if (begun_) return false;
  begun_ = true;
  peak_ = contacts_at.peak();
  find_range(contacts_at);
  return true;
}

std::vector<StiffnessSample> WideOscillation::contacts(const Surface& surface,
                                                       const Progress& progress) {
  SurfaceContacts contacts_at(surface, body_, contact_options(progress), direction_ == 0);
  const bool first = begin(contacts_at);
  if (!(highest_ > lowest_) || !contacts_at.usable()) return {};
  std::vector<StiffnessSample> contacts = contacts_on(contacts_at, 32);
  if (first && sticks_ && contacts_at.usable()) add_ratios(contacts_at, contacts);
  if (!contacts_at.usable() || !reach(contacts_at, contacts, 0)) return {};
  std::ranges::sort(contacts, std::greater(), &StiffnessSample::indentation);
  return contacts;
}

double WideOscillation::peak_force(const Surface& surface, const Progress& progress) {
  SurfaceContacts contacts_at(surface, body_, contact_options(progress));
  find_range(contacts_at);
  return contacts_at.usable() ? peak_force_ : Loss::unknown;
}

ResidualSurface loaded_by_motion(Surface surface, double contact_modulus, double pressure,
                                 const NormalContactOptions& options, double amplitude, Hold hold) {
  if (hold != Hold::force || !(amplitude > 0))
    return after_first_loading(std::move(surface), contact_modulus, pressure, options, amplitude);
  constexpr int max_loadings = 20;
  // The first loading goes a little beyond the motion, so that the motion stays elastic.
  constexpr double beyond = 1.01;
  const Material material = Material::of_contact_modulus(contact_modulus, 0);
  const Oscillation motion = Drag{amplitude, 1e-6, 1};
  const SurfaceDampingOptions damping{.boundary = options.boundary};
  double load = pressure;
  for (int loading = 0; loading < max_loadings; ++loading) {
    require(load < options.hardness, "hardness",
            format_quantity(options.hardness, Dimension::pressure),
            "must exceed the largest mean pressure of the oscillation, " +
                format_quantity(load, Dimension::pressure, 3) +
                "; reduce the load or the normal amplitude");
    ResidualSurface residual = after_first_loading(surface, contact_modulus, load, options);
    if (!residual.converged()) return residual;
    WideOscillation oscillation(material, motion, damping, Hold::force, 0,
                                {{pressure, pressure * surface.grid.area()}}, {});
    const double peak =
        oscillation.peak_force(residual.surface, options.on_progress) / surface.grid.area();
    // A motion that presses beyond full contact is refused later.
    if (!(peak > load)) return residual;
    load = beyond * peak;
  }
  return {.surface = std::move(surface)};
}

std::vector<WideLoss> WideOscillation::on(SurfaceContacts& contacts_at) {
  std::vector<WideLoss> losses(loads_.size());
  const bool first = begin(contacts_at);
  for (std::size_t k = 0; k < loads_.size(); ++k)
    losses[k].possible_amplitude = possible_amplitude_[k];
  if (!(highest_ > lowest_) || !contacts_at.usable()) return losses;
  // Without the loss of the first grid, that of another grid has no intervals and no error.
  if (!first && own_.empty()) return losses;

  const bool chooses =
      first && (options_.choose_intervals || options_.coarsen || options_.refinements > 0);
  const double target =
      options_.relative_error > 0 ? std::max(options_.relative_error / 3, 1e-3) : enough;
  if (first) intervals_ = std::max(chooses ? 16 : 32, options_.intervals);
  for (int intervals = first ? intervals_ : intervals_ / 2;; intervals *= 2) {
    const std::vector<StiffnessSample> contacts = contacts_on(contacts_at, intervals);
    if (!contacts_at.usable()) return losses;
    if (first) intervals_ = intervals;
    if (first && sticks_) add_ratios(contacts_at, contacts);
    std::vector<StiffnessSample> extra;
    double solver = 0;
    for (const StiffnessSample& one : contacts)
      if (one.force > 0) solver = std::max(solver, one.force_correction / one.force);
    const auto with_extra = [&](std::vector<StiffnessSample> some) {
      some.insert(some.end(), extra.begin(), extra.end());
      return some;
    };
    const std::vector<StiffnessSample> coarse = every_other(contacts);
    bool precise = true;
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      if (!std::isnan(possible_amplitude_[k])) continue;
      for (const auto& some : {contacts, coarse}) {
        std::vector<StiffnessSample> all = with_extra(some);
        const std::size_t before = all.size();
        if (!reach(contacts_at, all, k)) return losses;
        extra.insert(extra.end(), all.begin() + std::ptrdiff_t(before), all.end());
      }
      const std::vector<StiffnessSample> all = with_extra(contacts);
      WideLoss& loss = losses[k] = loss_of(all, k, ratio_, false);
      const WideLoss half = loss_of(with_extra(coarse), k, ratio_, false),
                     straight = loss_of(all, k, ratio_.straight(), false),
                     exponential = loss_of(all, k, ratio_, true);
      for (WideLoss::Part WideLoss::*part : {&WideLoss::without_slip, &WideLoss::with_slip}) {
        WideLoss::Part& own = loss.*part;
        own.by_intervals = std::abs(own.work - (half.*part).work);
        own.by_ratio = std::abs(own.work - (straight.*part).work);
        own.below = std::abs(own.work - (exponential.*part).work);
        own.by_solver = solver * std::abs(own.work);
        // Without friction the loss with slip is unknown, and so is its change.
        precise = precise && !(own.by_intervals > target * std::abs(own.work));
      }
      add_noise(loss, contacts);
      if (first) {
        by_half_.resize(loads_.size());
        by_half_[k] = half;
      } else {
        // Both grids see the same intervals, so their difference is that of the cells.
        for (WideLoss::Part WideLoss::*part : {&WideLoss::without_slip, &WideLoss::with_slip}) {
          const double change = (loss.*part).work - (by_half_[k].*part).work;
          loss.*part = own_[k].*part;
          (loss.*part).work += change;
        }
        for (double WideLoss::*number :
             {&WideLoss::relaxation_work, &WideLoss::indentation, &WideLoss::mean_force,
              &WideLoss::max_force, &WideLoss::contact_time})
          loss.*number += own_[k].*number - by_half_[k].*number;
        loss.contact_time = std::min(loss.contact_time, 1.0);
      }
    }
    if (!contacts_at.usable()) return std::vector<WideLoss>(loads_.size());
    if (!chooses || precise || intervals >= max_intervals) break;
  }
  if (first) own_ = losses;
  return losses;
}

}  // namespace salebra::detail
