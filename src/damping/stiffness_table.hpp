// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <salebra/contact/law/law.hpp>
#include <vector>

namespace salebra::detail {

/// K_t of a law over the indentations [lowest, highest] as piecewise polynomials of degree 5, on
/// cells that are halved until the polynomials fit. The tangential problem needs integrals of K_t';
/// they are exact for the table and cost tens of nanoseconds each, however expensive the law is.
/// The table is immutable. Its memory depends only on the law and the tolerance.
class StiffnessTable {
 public:
  /// ∫K_t'(ζ)(ζ − low)^k dζ over [low, high], k = 0, 1, 2.
  struct Moments {
    double zeroth = 0, first = 0, second = 0;
    /// Adds the moments of the range that follows this one. offset: width of this range.
    void append(const Moments& next, double offset);
  };

  /// relative_tolerance: allowed error of K_t, relative to the change of K_t over the range.
  StiffnessTable(const ContactLaw& law, double lowest, double highest, double relative_tolerance);

  double lowest() const { return starts_.front(); }
  double highest() const { return highest_; }
  /// K_t(lowest). at() and moments() do not contain it.
  double core() const { return core_; }
  /// K_t(δ) − K_t(lowest); δ is clamped to the range.
  double at(double indentation) const;
  Moments moments(double low, double high) const;
  std::size_t cells() const { return starts_.size(); }

 private:
  struct Cell {
    double middle = 0, half_width = 0;
    std::array<double, 6> coefficients{};  // of K_t − core in powers of s = (δ − middle)/half_width
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
