// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <salebra/contact/law/law.hpp>
#include <vector>

namespace salebra::detail {

/// K_t of a law over [lowest, highest] as piecewise polynomials of degree 5 on cells that are
/// halved until they fit, so that every integral of K_t' that the tangential problem needs is exact
/// for the table and costs tens of nanoseconds, whatever the law costs. Immutable; memory depends
/// on the law and the tolerance only.
class StiffnessTable {
 public:
  /// ∫K_t'(ζ)(ζ − low)^k dζ over [low, high], k = 0, 1, 2.
  struct Moments {
    double zeroth = 0, first = 0, second = 0;
    void append(const Moments& next, double offset);  ///< of the range that begins `offset` higher
  };

  /// relative_tolerance: of K_t, against its change over the range.
  StiffnessTable(const ContactLaw& law, double lowest, double highest, double relative_tolerance);

  double lowest() const { return starts_.front(); }
  double highest() const { return highest_; }
  /// K_t(lowest), which at() and moments() leave out.
  double core() const { return core_; }
  /// K_t(δ) − K_t(lowest); δ is clamped to the range.
  double at(double indentation) const;
  Moments moments(double low, double high) const;
  std::size_t cells() const { return starts_.size(); }

 private:
  struct Cell {
    double middle = 0, half_width = 0;
    std::array<double, 6> coefficients{};  // of K_t − core in s = (δ − middle)/half_width
  };
  void add_cells(const ContactLaw& law, double low, double high, double tolerance, int depth);
  std::size_t cell_of(double indentation) const;
  Moments within(const Cell& cell, double low, double high) const;

  std::vector<double> starts_;
  std::vector<Cell> cells_;
  std::vector<Moments> whole_cells_, whole_blocks_;
  double core_ = 0, highest_ = 0;
};

}  // namespace salebra::detail
