// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <salebra/base/row_partition.hpp>

namespace salebra::detail {

// Extrapolates a fixed-point iteration x → x + f(x) to the combination of its last steps whose
// residual f is smallest [Anderson (1965)]. Fields hold the rows of this process; calls are
// collective, and results have the same bits for every number of processes and threads.
class Anderson {
 public:
  // depth: number of earlier steps kept, in single precision.
  Anderson(const RowPartition& rows, std::size_t depth) : rows_(rows), depth_(depth) {}

  // Returns the next x, or x + f if there is no earlier step. Keeps x and f for the next call.
  Field extrapolate(const Field& x, const Field& f);
  void forget() { steps_.clear(); }

 private:
  using Rows = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Step {
    Rows x, f;  // changes of x and f over one step
  };
  RowPartition rows_;
  std::size_t depth_;
  Field last_x_, last_f_;
  std::deque<Step> steps_;
  Eigen::MatrixXd gram_;
};

}  // namespace salebra::detail
