// SPDX-License-Identifier: GPL-3.0-or-later
// Anderson's extrapolation of a fixed-point iteration of fields.
#include "anderson.hpp"

#include <Eigen/Cholesky>
#include <span>
#include <utility>
#include <vector>

namespace salebra::detail {
namespace {

// Relative amount added to the diagonal of the Gram matrix of the steps: it suppresses combinations
// of steps that the residuals cannot distinguish.
constexpr double ridge = 1e-13;

}  // namespace

Field Anderson::extrapolate(const Field& x, const Field& f) {
  if (last_x_.size() > 0) {
    if (steps_.size() == depth_) {
      steps_.pop_front();
      const Index kept = gram_.rows() - 1;
      gram_ = gram_.bottomRightCorner(kept, kept).eval();
    }
    steps_.push_back({(x - last_x_).cast<float>(), (f - last_f_).cast<float>()});
  }
  last_x_ = x;
  last_f_ = f;
  if (steps_.empty()) return x + f;
  const std::size_t count = steps_.size();
  const Index columns = f.cols();
  // Scalar products of the newest step of f with all kept steps of f, and of all kept steps with f.
  const std::vector<double> sums =
      parallel::sum_blocks(rows_, 2 * count, [&](Index begin, Index end, std::span<double> all) {
        const Rows& newest = steps_.back().f;
        for (std::size_t s = 0; s < count; ++s) {
          const Rows& step = steps_[s].f;
          double with_newest = 0, with_f = 0;
          for (Index k = begin * columns; k < end * columns; ++k) {
            with_newest += double(step.data()[k]) * double(newest.data()[k]);
            with_f += double(step.data()[k]) * f.data()[k];
          }
          all[s] += with_newest;
          all[count + s] += with_f;
        }
      });
  const auto size = static_cast<Index>(count);
  gram_.conservativeResize(size, size);
  Eigen::VectorXd right(size);
  for (Index s = 0; s < size; ++s) {
    gram_(s, size - 1) = gram_(size - 1, s) = sums[static_cast<std::size_t>(s)];
    right[s] = sums[static_cast<std::size_t>(size + s)];
  }
  const Eigen::MatrixXd damped =
      gram_ + ridge * gram_.trace() * Eigen::MatrixXd::Identity(size, size);
  const Eigen::VectorXd part = damped.ldlt().solve(right);
  if (!part.allFinite()) return x + f;
  Field next(x.rows(), x.cols());
  parallel::for_slabs(
      x.rows(),
      [&](Index begin, Index end) {
        for (Index k = begin * columns; k < end * columns; ++k) {
          double value = x.data()[k] + f.data()[k];
          for (std::size_t s = 0; s < count; ++s)
            value -= part[static_cast<Index>(s)] *
                     (double(steps_[s].x.data()[k]) + double(steps_[s].f.data()[k]));
          next.data()[k] = value;
        }
      },
      x.size());
  return next;
}

}  // namespace salebra::detail
