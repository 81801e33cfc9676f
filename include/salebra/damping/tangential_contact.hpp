// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <salebra/contact/law/law.hpp>

namespace salebra {

struct TangentialContactOptions {
  /// μ >= 0; infinite: full stick, the case of the paper.
  double friction_coefficient = std::numeric_limits<double>::infinity();
  /// Allowed deviation of the stored history from the motion, m, >= 0. 0 keeps every turning point
  /// and every bend of the path; a positive value limits the number of pieces stored while δ rises
  /// to about (path curvature/tolerance)^{1/2}, whatever the number of steps.
  double merge_tolerance = 0;
  /// Relative tolerance of the table of K_t that is used instead of the law; 1e-14 to 1e-3.
  double table_tolerance = 1e-12;
  /// Largest distance in x between any two positions of the motion, m, or infinity for slide(). It
  /// limits the depth that slip can reach. It must be > 0 if the friction coefficient is finite and
  /// > 0; otherwise it is not used.
  double tangential_range = 0;
  /// K_t/K of the springs, which sets their friction limit; NaN: that of the law in the middle of
  /// the range of δ.
  double stiffness_ratio = std::numeric_limits<double>::quiet_NaN();
};

/// Tangential state, along any path, of any contact whose contact set at a smaller indentation lies
/// inside the set at a larger indentation (docs/theory.md, sections 7 and 8):
///     F_x = ∫_{−∞}^{δ} K_t'(ζ)[x − x0(ζ)]dζ,
/// with the anchor x0(ζ) of the springs at depth ζ.
///
///     TangentialContact contact(law, 0, 2e-8);
///     contact.start(1e-8, 0);
///     contact.move_to(2e-8, 1e-9);
///
/// A spring is anchored at the x at which it touches. With finite friction its stretch is limited,
/// |x − x0| <= (μK/K_t)(δ − ζ), with K/K_t of the law in the middle of the range of δ; at the limit
/// the anchor slips along with the body. In full stick a spring is released at once, with its full
/// stretch, when δ falls below ζ. The result is exact for motion in straight steps, apart from the
/// error of the table of K_t: x0 is piecewise linear in ζ, and its pieces form a stack (a memory of
/// turning points). A step adds at most two pieces and removes the pieces that it overwrites, so it
/// costs O(1) on average, and the memory does not grow with the number of cycles. A copy saves the
/// state, and copies share the table: a thousand equal contacts are copies of one. ContactElement
/// handles both tangential directions at once and returns derivatives.
class TangentialContact {
 public:
  /// The motion must stay within lowest <= δ <= highest, in m; it may go below `lowest` only if
  /// F(lowest) = 0. Throws InvalidInput if the law does not cover this range, and for options out
  /// of range.
  TangentialContact(const ContactLaw& law, double lowest, double highest,
                    const TangentialContactOptions& options = {});
  TangentialContact(const TangentialContact& other);
  TangentialContact(TangentialContact&&) noexcept;
  TangentialContact& operator=(const TangentialContact& other);
  TangentialContact& operator=(TangentialContact&&) noexcept;
  ~TangentialContact();

  /// Puts the indenter down at (indentation, x), with all springs free of stress, and sets the
  /// losses and the external work to 0.
  void start(double indentation, double x);
  /// Sets the state of gross sliding at this indentation, towards +x (direction = 1) or −x
  /// (direction = −1): every spring is at its stretch limit. Losses and external work become 0. All
  /// springs below the range of the law are kept as a single spring as long as they slip in that
  /// direction; stored_energy() is then known except for a constant. Throws InvalidInput where
  /// friction is infinite.
  void slide(double indentation, double x, int direction);
  /// Moves on a straight line in (δ, x). Throws InvalidInput outside the range given to the
  /// constructor, and if slip would reach springs below the range of the law.
  void move_to(double indentation, double x);
  /// Moves to where the tangential force is `force`. Throws InvalidInput if no displacement gives
  /// this force, because |force| is not below μF(δ).
  /// cost     some tens of trial moves of a copy of the memory
  void move_to_force(double indentation, double force);

  double displacement() const;      ///< x, m
  double tangential_force() const;  ///< F_x, N
  double stored_energy() const;     ///< ½∫K_t'(x − x0)²dζ, J
  double dissipated() const;  ///< energy lost since start() or slide(), J, by release and by slip
  /// Part of dissipated() from springs below `lowest`, which never leave contact, J: the slip loss
  /// of Cattaneo and Mindlin. The rest of dissipated() is lost by springs that open and close, and
  /// becomes the relaxation loss for μ → ∞.
  double dissipated_in_permanent_contact() const;
  double external_work()
      const;  ///< ∫F_x dx since start() or slide(), J: dissipated() plus the change of
              ///< stored_energy()
  double permanent_stiffness() const;  ///< K_t at `lowest`, of the springs that never separate, N/m
  std::size_t memory() const;          ///< number of pieces of x0(ζ)

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace salebra
