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
  /// m, >= 0: how far the stored history may deviate from the motion. 0 keeps every turning point
  /// and every bend of the path; a positive value bounds the memory of one rise by (path
  /// curvature/tolerance)^{1/2}, whatever the number of its steps.
  double merge_tolerance = 0;
  /// Relative, of the table of K_t that the law is replaced by; 1e-14 … 1e-3.
  double table_tolerance = 1e-12;
  /// m, largest |x − x'| between two positions of the motion, or infinity for slide(). Must be > 0
  /// where friction is finite and > 0, and is not used otherwise: it says how deep below the edge
  /// slip may reach.
  double tangential_range = 0;
};

/// The tangential state of any contact with nested contact sets, along any path (docs/theory.md,
/// sections 7 and 8):
///     F_x = ∫_{−∞}^{δ} K_t'(ζ)[x − x0(ζ)]dζ,
/// x0(ζ): where the springs of indentation level ζ are anchored. A level is anchored where it
/// touches. With finite friction its stretch obeys |x − x0| <= (μK/K_t)(δ − ζ), and its anchor
/// slips along otherwise, K/K_t the law's in the middle of the motion; without, it is let go at once
/// with all its stretch when δ falls through ζ. Exact for motion in straight steps, up to the table of K_t: x0 is piecewise linear in ζ, and
/// the pieces form a stack (a memory of turning points) on which every step pushes at most two and
/// removes those that it wipes out, so that a step costs O(1) on average and the memory does not
/// grow with the number of cycles. A copy is a state to come back to, and copies share the table, so
/// that a thousand equal contacts are copies of one. ContactElement has both directions at once, and
/// derivatives.
class TangentialContact {
 public:
  /// The motion must stay within lowest <= δ <= highest, but that below a `lowest` without force
  /// nothing touches. Throws InvalidInput where the law does not cover the range, and for options
  /// out of range.
  TangentialContact(const ContactLaw& law, double lowest, double highest,
                    const TangentialContactOptions& options = {});
  TangentialContact(const TangentialContact& other);
  TangentialContact(TangentialContact&&) noexcept;
  TangentialContact& operator=(const TangentialContact& other);
  TangentialContact& operator=(TangentialContact&&) noexcept;
  ~TangentialContact();

  /// Puts the indenter down at (indentation, x), all springs free of stress; sets the energies to
  /// 0.
  void start(double indentation, double x);
  /// The state after endless sliding towards +x (direction 1) or −x (−1) at this indentation: every
  /// level at the limit of its stretch. Sets the losses and the external work to 0. Levels below
  /// the law's range are carried along as one spring, as long as they slip in that direction;
  /// stored_energy() is then known up to a constant. Throws InvalidInput where friction is
  /// infinite.
  void slide(double indentation, double x, int direction);
  /// Moves on a straight line in (δ, x). Throws InvalidInput outside the range, and where slip
  /// would reach levels below the law's own range.
  void move_to(double indentation, double x);
  /// Moves to where the tangential force is `force`. Throws InvalidInput where no displacement has
  /// it: |force| is not below μF(δ).
  /// cost     some tens of moves of a copy of the memory
  void move_to_force(double indentation, double force);

  double displacement() const;      ///< x, m
  double tangential_force() const;  ///< F_x, N
  double stored_energy() const;     ///< ½∫K_t'(x − x0)²dζ, J
  double dissipated() const;  ///< lost since start() or slide(), J: by levels let go and by slip
  /// The part of dissipated() that levels below `lowest` lost, which never leave contact: slip as
  /// of Cattaneo and Mindlin. The rest is what levels lost that open and close; it becomes the
  /// relaxation loss for μ → ∞.
  double dissipated_in_permanent_contact() const;
  double external_work()
      const;  ///< ∫F_x dx since start() or slide(), J: what is dissipated and added to
              ///< stored_energy()
  double permanent_stiffness() const;  ///< K_t at `lowest`: what is never let go, N/m
  std::size_t memory() const;          ///< pieces of x0(ζ) now held

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace salebra
