// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <salebra/base/row_partition.hpp>

namespace salebra::detail {

// Extrapolation of a fixed-point iteration x → x + f(x) from its last steps: the combination of them
// with the least residual [Anderson (1965)]. Fields hold the rows of this process; calls are
// collective, and results have the same bits for every number of processes and threads.
class Anderson {
 public:
  // depth: differences that are kept, each in single precision.
  Anderson(const RowPartition& rows, std::size_t depth) : rows_(rows), depth_(depth) {}

  // The next x, or x + f where there is no step before. Keeps the pair.
  Field extrapolate(const Field& x, const Field& f);
  void forget() { steps_.clear(); }

 private:
  using Rows = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Step {
    Rows x, f;  // differences of the pairs at its ends
  };
  RowPartition rows_;
  std::size_t depth_;
  Field last_x_, last_f_;
  std::deque<Step> steps_;
  Eigen::MatrixXd gram_;
};

}  // namespace salebra::detail
