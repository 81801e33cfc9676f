// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <salebra/contact/law/law.hpp>
#include <vector>

namespace salebra::detail {

/// What a law that comes from a table is below its lowest sample.
enum class BelowTable {
  opens,       ///< the law's own continuation, which ends at first touch
  exponential  ///< F = F1 exp((δ − δ1)/l), which never opens: another guess, to see what it changes
};

/// Continues a table above its highest indentation δ1, and below its lowest if asked, by F = F1
/// exp((δ − δ1)/l) with l = F1/K1, where F1 and K1 are F and K at δ1. K_t grows by the same
/// exponential. Laws that are not tables stay as they are.
class ContinuedLaw final : public ContactLaw {
 public:
  explicit ContinuedLaw(const ContactLaw& law, BelowTable below = BelowTable::opens)
      : ContactLaw(law.modulus_ratio()),
        law_(law),
        is_table_(std::isfinite(law.lowest_indentation())),
        low_(law, below == BelowTable::exponential ? law.lowest_indentation() : -infinite),
        // Above its highest indentation the law of an indenter is not continued: the contact may
        // have reached the side of the indenter, or its shape is unknown there.
        high_(law, is_table_ ? law.highest_indentation() : infinite) {}
  double force(double indentation) const override {
    const End* end = beyond(indentation);
    return end ? end->force * end->growth(indentation) : law_.force(indentation);
  }
  double normal_stiffness(double indentation) const override {
    const End* end = beyond(indentation);
    return end ? end->force / end->length * end->growth(indentation)
               : law_.normal_stiffness(indentation);
  }
  double force_curvature(double indentation) const override {
    const End* end = beyond(indentation);
    return end ? end->force / (end->length * end->length) * end->growth(indentation)
               : law_.force_curvature(indentation);
  }
  double tangential_stiffness(double indentation) const override {
    const End* end = beyond(indentation);
    return end ? end->stiffness * end->growth(indentation) : law_.tangential_stiffness(indentation);
  }
  double tangential_curvature(double indentation) const override {
    const End* end = beyond(indentation);
    return end ? end->stiffness / end->length * end->growth(indentation)
               : law_.tangential_curvature(indentation);
  }
  double stiffness_ratio(double indentation) const override {
    return law_.stiffness_ratio(indentation);
  }
  double first_touch() const override {
    return std::isfinite(low_.end) ? -infinite : law_.first_touch();
  }
  double lowest_indentation() const override { return law_.lowest_indentation(); }
  double highest_indentation() const override {
    return is_table_ ? infinite : law_.highest_indentation();
  }
  double indentation_of(double force) const override { return law_.indentation_of(force); }
  std::vector<double> break_points() const override { return law_.break_points(); }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  struct End {
    End(const ContactLaw& law, double at) : end(at) {
      if (!std::isfinite(at)) return;
      force = law.force(at);
      length = force / law.normal_stiffness(at);
      stiffness = law.tangential_stiffness(at);
    }
    double growth(double indentation) const { return std::exp((indentation - end) / length); }
    double end, force = 0, length = 1, stiffness = 0;
  };
  const End* beyond(double indentation) const {
    return indentation < low_.end ? &low_ : indentation > high_.end ? &high_ : nullptr;
  }
  const ContactLaw& law_;
  bool is_table_;
  End low_, high_;
};

}  // namespace salebra::detail
