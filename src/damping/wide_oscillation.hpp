// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <vector>

#include "spring_loss.hpp"
#include "surface_law.hpp"

/// Losses of a surface under oscillations so wide that a law of the surface from first touch to the
/// largest force describes them better than contacts about each load.
namespace salebra::detail {

/// Whether an oscillation about a load is wide: the contact lifts off, or F changes by about a
/// factor of two or more, over which no parabola describes K.
inline bool is_wide(const ForceSample& load, double amplitude) {
  return amplitude > load.indentation || amplitude > 0.75 * load.force / load.normal_stiffness;
}

/// The loss of one load on one grid.
struct WideLoss {
  struct Part {
    double work = Loss::unknown;  // J
    // Changes of the loss: with half as many intervals, with ρ linear in ln F, with the exponential
    // continuation below the lowest contact, and by the tolerance of the solver.
    double by_intervals = 0, by_ratio = 0, below = 0, by_solver = 0;
    // Standard deviation by the cells and contact patches that enter singly.
    double deviation = 0;
  };
  Part without_slip, with_slip;
  double relaxation_work = Loss::unknown;  // part of the loss with slip, J
  double indentation = Loss::unknown, mean_force = Loss::unknown, max_force = Loss::unknown,
         contact_time = Loss::unknown;
  double possible_amplitude = Loss::unknown;  // if the motion presses beyond full contact, m
  bool converged = false;
};

/// Losses of all loads of a surface from one law, grid by grid.
class WideOscillation {
 public:
  struct Load {
    double pressure, force;
  };
  /// direction    of the tangential motion, from the x axis, rad
  /// loads        from the lowest to the highest
  /// of_curve     K_t of the curve, if it comes from stick solves; otherwise empty, and ρ = 1
  WideOscillation(const Body& body, const Oscillation& motion, const SurfaceDampingOptions& options,
                  Hold hold, double direction, std::vector<Load> loads, RatioOfLoads of_curve);

  /// The losses on one grid. The first grid chooses the range of the contacts and their number; on
  /// every other grid half as many contacts change the loss of the first grid. `contacts_at` are
  /// the contacts of this grid, with contact_options().
  std::vector<WideLoss> on(SurfaceContacts& contacts_at);
  NormalContactOptions contact_options(const Progress& progress) const;
  /// Contacts of the law of one load on one grid, in 32 intervals, from the highest to the lowest;
  /// empty if the motion presses beyond full contact or a contact did not converge.
  std::vector<StiffnessSample> contacts(const Surface& surface, const Progress& progress);
  /// The relative standard deviation of K about an indentation, from such contacts.
  static double scatter(const std::vector<StiffnessSample>& contacts, double least);
  double possible_amplitude() const { return possible_amplitude_.front(); }
  const RatioOfLoads& ratio() const { return ratio_; }
  /// The largest force of all possible motions, N; NaN if none is possible.
  double peak_force(const Surface& surface, const Progress& progress);
  int intervals() const { return intervals_; }
  /// Half the range of indentations of the contacts, m.
  double window() const { return (highest_ - lowest_) / 2; }

 private:
  bool begin(SurfaceContacts& contacts_at);
  void find_range(SurfaceContacts& contacts_at);
  bool reach(SurfaceContacts& contacts_at, std::vector<StiffnessSample>& contacts,
             std::size_t load);
  std::vector<StiffnessSample> contacts_on(SurfaceContacts& contacts_at, int intervals) const;
  WideLoss loss_of(const std::vector<StiffnessSample>& contacts, std::size_t load,
                   const RatioOfLoads& ratio, bool exponential) const;
  void add_noise(WideLoss& loss, const std::vector<StiffnessSample>& contacts) const;
  std::optional<LossOfSpring> spring_of(const ContactLaw& law, const RatioOfLoads& ratio,
                                        double top) const;
  void add_ratios(SurfaceContacts& contacts_at, const std::vector<StiffnessSample>& contacts);

  Body body_;
  double modulus_ratio_;
  const Oscillation& motion_;
  const SurfaceDampingOptions& options_;
  Hold hold_;
  double direction_;
  std::vector<Load> loads_;
  RatioOfLoads ratio_;
  bool sticks_;
  double amplitude_;
  bool begun_ = false;
  int intervals_ = 16;
  double peak_ = 0;                  // height of the highest point of the first grid, m
  double lowest_ = 0, highest_ = 0;  // range of the contacts on the first grid, m
  double peak_force_ = Loss::unknown;
  std::vector<double> possible_amplitude_;  // of each load; NaN: the motion is possible
  std::vector<WideLoss> own_, by_half_;     // of the first grid
};

/// As after_first_loading(), but the oscillation may keep the mean force: the first loading then
/// ends at its largest load.
ResidualSurface loaded_by_motion(Surface surface, double contact_modulus, double pressure,
                                 const NormalContactOptions& options, double amplitude, Hold hold);

}  // namespace salebra::detail
