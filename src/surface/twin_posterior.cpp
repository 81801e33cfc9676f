// SPDX-License-Identifier: GPL-3.0-or-later
// Draws of the posterior of a surface twin by an ensemble of walkers.
#include <Eigen/Cholesky>
#include <cmath>
#include <salebra/base/parallel.hpp>

#include "base/random.hpp"
#include "surface/twin_fit.hpp"

namespace salebra::twin_detail {
namespace {

constexpr int settling = 80;   ///< steps before the first draw
constexpr int min_steps = 30;  ///< minimum number of steps after the first draw
constexpr double apart =
    15;  ///< states of walkers per kept draw, enough for nearly independent draws
constexpr double freedom = 6;  ///< degrees of freedom of the proposals' t distribution
enum Stream : std::uint32_t { choice = 101, chance, normals };

/// Student t distribution with the mean and covariance of half an ensemble of walkers, from which
/// moves of the other half are drawn.
class Proposal {
 public:
  explicit Proposal(const Eigen::MatrixXd& walkers) : mean_(walkers.rowwise().mean()) {
    const Eigen::MatrixXd centred = walkers.colwise() - mean_;
    Eigen::MatrixXd covariance =
        centred.lazyProduct(centred.transpose()) / static_cast<double>(walkers.cols() - 1);
    covariance.diagonal().array() *= 1 + 1e-6;
    covariance.diagonal().array() += 1e-14;
    factor_ = Eigen::LLT<Eigen::MatrixXd>(covariance).matrixL();
  }

  Eigen::VectorXd draw(std::uint64_t seed, std::int32_t step, std::int32_t walker) const {
    Eigen::VectorXd z(mean_.size());
    const std::int32_t first = walker * 64;
    for (Index p = 0; p < z.size(); p += 2) {
      const RandomPair pair =
          gaussian_pair(seed, step, first + static_cast<std::int32_t>(p / 2), normals);
      z[p] = pair.first;
      if (p + 1 < z.size()) z[p + 1] = pair.second;
    }
    double chi_square = 0;  // χ² with 6 degrees of freedom: the sum of three exponential variates
    for (const std::int32_t k : {61, 62, 63})
      chi_square -= 2 * std::log(uniform_pair(seed, step, first + k, normals).first);
    return mean_ + std::sqrt(freedom / chi_square) * (factor_ * z);
  }

  double log_density(const Eigen::VectorXd& at) const {
    const Eigen::VectorXd z = factor_.triangularView<Eigen::Lower>().solve(at - mean_);
    return -(freedom + static_cast<double>(z.size())) / 2 * std::log1p(z.squaredNorm() / freedom);
  }

 private:
  Eigen::VectorXd mean_;
  Eigen::MatrixXd factor_;
};

}  // namespace

Eigen::MatrixXd sampled_posterior(const TwinModel& model, const Eigen::MatrixXd& start, Index draws,
                                  std::uint64_t seed) {
  const Index size = model.size(), walkers = start.cols(), half = walkers / 2;
  Eigen::MatrixXd at = start;
  Eigen::VectorXd density(walkers);
  const auto evaluate_all = [&](const auto& body) {
    parallel::for_slabs(half, [&](Index begin, Index end) {
      TwinModel::Work work;
      for (Index k = begin; k < end; ++k) body(k, work);
    });
  };
  for (const Index first : {Index{0}, half})
    evaluate_all([&](Index k, TwinModel::Work& work) {
      density[first + k] = model.log_posterior(at.col(first + k), work);
    });

  const int steps =
      settling + std::max(min_steps, static_cast<int>(std::ceil(static_cast<double>(draws) * apart /
                                                                static_cast<double>(walkers))));
  Eigen::MatrixXd kept(size, (steps - settling) * walkers);
  for (int step = 0; step < steps; ++step) {
    for (const Index first : {Index{0}, half}) {
      const Index others = half - first;
      const Eigen::MatrixXd fixed = at.middleCols(others, half);
      const Proposal proposal(fixed);
      const Eigen::MatrixXd before = at.middleCols(first, half);
      evaluate_all([&](Index k, TwinModel::Work& work) {
        const auto walker = static_cast<std::int32_t>(first + k);
        const RandomPair of_choice = uniform_pair(seed, step, walker, choice),
                         of_chance = uniform_pair(seed, step, walker, chance);
        Eigen::VectorXd next;
        double factor = 0;
        if (of_choice.first < 0.5) {
          const double root = 1 + of_choice.second, z = root * root / 2;
          const auto other = std::min<Index>(
              half - 1, static_cast<Index>(of_chance.second * static_cast<double>(half)));
          next = fixed.col(other) + z * (before.col(k) - fixed.col(other));
          factor = static_cast<double>(size - 1) * std::log(z);
        } else {
          next = proposal.draw(seed, step, walker);
          factor = proposal.log_density(before.col(k)) - proposal.log_density(next);
        }
        const double next_density = model.log_posterior(next, work);
        if (std::log(of_chance.first) >= factor + next_density - density[first + k]) return;
        at.col(first + k) = next;
        density[first + k] = next_density;
      });
    }
    if (step >= settling) kept.middleCols((step - settling) * walkers, walkers) = at;
  }
  // Take the draws evenly from the states of all steps.
  Eigen::MatrixXd chosen(size, draws);
  for (Index draw = 0; draw < draws; ++draw)
    chosen.col(draw) = kept.col(std::min<Index>(
        kept.cols() - 1,
        static_cast<Index>((static_cast<double>(draw) + 0.5) / static_cast<double>(draws) *
                           static_cast<double>(kept.cols()))));
  return chosen;
}

}  // namespace salebra::twin_detail
