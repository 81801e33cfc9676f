// SPDX-License-Identifier: GPL-3.0-or-later
// Losses of a viscoelastic contact in its periodic state: in the material, and by springs that
// separate while they are stretched.
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>

#include "base/loop_progress.hpp"
#include "base/numerics/dense_systems.hpp"
#include "base/stop_check.hpp"
#include "contact/mdr/viscoelastic_spring.hpp"
#include "max_motion.hpp"

namespace salebra {
namespace {

using detail::Branches;
using detail::MaxwellSpring;
using detail::NormalSpring;
using detail::SpringPath;

// A fraction of a step during which a spring stays closed or stays open.
struct LossPart {
  bool closed;
  std::size_t step;
  double share;
};

Eigen::MatrixXd decay_matrix(const MaxwellSpring& spring, double duration) {
  return spring.stretching(duration).decay.matrix().asDiagonal();
}

// One period of a spring in the normal direction. It starts with given anchors, the positions of
// the springs of its Maxwell branches.
struct NormalPeriod {
  Branches end;
  Eigen::MatrixXd derivative;  // derivative of `end` with respect to the anchors at the start
  double work = 0;
  bool opens = false, closes = false;
  bool converged = false;  // whether the period ends with the anchors with which it began
  std::vector<LossPart> parts;
  std::vector<double> force;  // at the samples of the path
};

NormalPeriod normal_period(const MaxwellSpring& spring, const SpringPath& path, double spring_depth,
                           const Branches& start) {
  NormalPeriod period;
  period.derivative = Eigen::MatrixXd::Identity(spring.terms(), spring.terms());
  NormalSpring state(spring, spring_depth);
  state.start(path.indentation[0], start);
  period.force.push_back(state.force(path.indentation[0]));
  // The derivative ignores that the times of touch and release depend on the anchors: the velocity
  // of the anchors is continuous there, so a change of these times has no effect at first order.
  double stay = 0;
  bool stays_closed = state.closed();
  const auto end_of_stay = [&] {
    period.derivative = (stays_closed ? decay_matrix(spring, stay) : spring.anchor_recovery(stay)) *
                        period.derivative;
    stay = 0;
  };
  for (std::size_t step = 0; step < path.steps(); ++step) {
    detail::stop_if_asked();
    state.advance(path, step, [&](bool closed, double share, double work) {
      if (closed != stays_closed) end_of_stay();
      stays_closed = closed;
      stay += share * path.duration[step];
      (closed ? period.closes : period.opens) = true;
      period.work += work;
      period.parts.push_back({closed, step, share});
    });
    period.force.push_back(state.force(path.indentation[step + 1]));
  }
  end_of_stay();
  period.end = state.anchors(path.indentation.back());
  return period;
}

// Finds the anchors that repeat after a period, by Newton's method. The anchors at the end of a
// period are a convex, increasing function of those at its start, so after the first step the
// method approaches the solution from one side.
NormalPeriod periodic(const MaxwellSpring& spring, const SpringPath& path, double spring_depth,
                      double range, Branches& start, LoopProgress& progress) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(spring.terms(), spring.terms());
  NormalPeriod period;
  double last = range;
  for (int iteration = 0; iteration < 60 && progress.advance(0); ++iteration) {
    period = normal_period(spring, path, spring_depth, start);
    period.converged = spring.terms() == 0;
    if (period.converged) break;
    const Branches change =
        detail::least_squares(one - period.derivative, (period.end - start).matrix()).array();
    const double distance = change.abs().maxCoeff();
    // The remaining change may be round-off of one period, divided by the fraction by which a
    // branch decays in a period. A change that no longer shrinks therefore counts as converged.
    period.converged =
        distance <= 1e-11 * range || (distance <= 1e-5 * range && distance >= 0.5 * last);
    if (period.converged) break;
    last = distance;
    start += change;
  }
  return period;
}

// One period of a spring that never leaves contact; its anchors are periodic apart from a drift.
struct PermanentPeriod {
  Branches start;
  double work = 0;                   // work done on the Maxwell branches
  std::vector<double> branch_force;  // at the samples of the path
};

PermanentPeriod permanent_period(const MaxwellSpring& spring, const SpringPath& path,
                                 const std::vector<double>& moves) {
  PermanentPeriod period;
  Branches branches = Branches::Zero(spring.terms());
  double duration = 0;
  const auto follow = [&] {
    for (std::size_t step = 0; step < path.steps(); ++step) {
      const detail::Stretching& part = path.stretching[step];
      period.branch_force.push_back(spring.force(0, branches));
      period.work += moves[step] * spring.mean_branch_force(part, branches, moves[step]);
      branches = part.decay * branches + moves[step] * part.gain;
      duration += path.duration[step];
    }
    period.branch_force.push_back(spring.force(0, branches));
  };
  follow();
  branches /= spring.lost_share(duration);
  period = {.start = branches, .work = 0, .branch_force = {}};
  follow();
  return period;
}

struct TangentialLoss {
  double material = 0, relaxation = 0;
};

// Tangential motion of a spring whose times in contact are known. One period is then an affine map
// of the state (w, branches): w is the stretch of the spring, `branches` those of its Maxwell
// branches.
class OpeningSpring {
 public:
  OpeningSpring(const MaxwellSpring& spring, const SpringPath& path,
                const std::vector<double>& moves, const std::vector<LossPart>& parts)
      : spring_(spring), path_(path), moves_(moves), parts_(parts) {}

  TangentialLoss loss() const {
    const Index size = spring_.terms() + 1;
    Eigen::VectorXd forced = Eigen::VectorXd::Zero(size);
    follow(forced);
    Eigen::VectorXd state =
        detail::least_squares(Eigen::MatrixXd::Identity(size, size) - derivative(), forced);
    return follow(state);
  }

 private:
  bool begins_stay(std::size_t i) const {
    // The first part of the period may continue a stay that began in the last part.
    return parts_[i].closed != parts_[i > 0 ? i - 1 : parts_.size() - 1].closed;
  }
  bool ends_stay(std::size_t i) const {
    return i + 1 == parts_.size() || parts_[i].closed != parts_[i + 1].closed;
  }

  TangentialLoss follow(Eigen::VectorXd& state) const {
    double w = state[0], work = 0, in_air = 0;
    Branches branches = state.tail(spring_.terms()).array();
    TangentialLoss lost;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const LossPart& part = parts_[i];
      const double duration = part.share * path_.duration[part.step];
      if (part.closed) {
        if (begins_stay(i)) lost.relaxation -= spring_.energy(w, branches);
        const double move = part.share * moves_[part.step];
        detail::Stretching partial;
        if (part.share < 1) partial = spring_.stretching(duration);
        const detail::Stretching& step = part.share < 1 ? partial : path_.stretching[part.step];
        work += spring_.work(step, w, branches, move);
        branches = step.decay * branches + move * step.gain;
        w += move;
        continue;
      }
      if (begins_stay(i)) {
        lost.relaxation += spring_.energy(w, branches);
        // At separation the force falls to 0 at once, by an elastic jump with the unrelaxed
        // stiffness.
        const double jump = spring_.force(w, branches) / spring_.unrelaxed_stiffness();
        w -= jump;
        branches -= jump;
      }
      in_air += duration;
      if (!ends_stay(i)) continue;
      branches = spring_.recovered(branches, in_air);
      w = spring_.free_displacement(branches);
      in_air = 0;
    }
    lost.material = work - lost.relaxation;
    state[0] = w;
    state.tail(spring_.terms()) = branches.matrix();
    return lost;
  }

  // Derivative of the state at the end of the period with respect to that at its start: the same
  // maps without the displacement of the body.
  Eigen::MatrixXd derivative() const {
    const Index terms = spring_.terms();
    const Eigen::RowVectorXd ratios = spring_.ratios().matrix().transpose();
    Eigen::MatrixXd all = Eigen::MatrixXd::Identity(terms + 1, terms + 1);
    double stay = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (!parts_[i].closed && begins_stay(i)) {
        const Eigen::RowVectorXd jump =
            (all.row(0) + ratios * all.bottomRows(terms)) / spring_.unrelaxed_stiffness();
        all.rowwise() -= jump;
      }
      stay += parts_[i].share * path_.duration[parts_[i].step];
      if (!ends_stay(i)) continue;
      all.bottomRows(terms) =
          ((parts_[i].closed ? decay_matrix(spring_, stay) : spring_.recovery(stay)) *
           all.bottomRows(terms))
              .eval();
      if (!parts_[i].closed) all.row(0) = -ratios * all.bottomRows(terms);
      stay = 0;
    }
    return all;
  }

  const MaxwellSpring& spring_;
  const SpringPath& path_;
  const std::vector<double>& moves_;
  const std::vector<LossPart>& parts_;
};

std::vector<double> differences(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(values[i] - values[i - 1]);
  return steps;
}

/// Sets the mean normal force over the period, the loss, the power and the damping constant from
/// the normal force at the samples and the separate losses.
void set_means(ViscoelasticDamping& result, const SpringPath& path,
               const std::vector<double>& moves, double period) {
  double square_velocity = 0;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    square_velocity += moves[i] * moves[i] / path.duration[i] / period;
    result.mean_force += 0.5 * (result.force[i] + result.force[i + 1]) * path.duration[i] / period;
  }
  const double tangential_work = result.tangential_material_work + result.relaxation_work;
  result.work_per_cycle = result.normal_material_work + tangential_work;
  result.power = result.work_per_cycle / period;
  result.damping_constant = square_velocity > 0 ? tangential_work / period / square_velocity
                                                : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

ViscoelasticDamping viscoelastic_damping(const IndenterLaw& law, const PronySeries& prony,
                                         const SampledMotion& trajectory, int springs,
                                         const Progress& on_progress) {
  trajectory.validate();
  require(springs >= 8, "springs", springs, "must be >= 8");
  const MaxwellSpring spring(prony);
  const SpringPath path(spring, trajectory.time, trajectory.indentation);
  const std::vector<double> normal_moves = differences(trajectory.indentation);
  const std::vector<double> moves = differences(trajectory.displacement);
  const auto [lowest, highest] = std::ranges::minmax(trajectory.indentation);
  detail::require_possible(law, 0.5 * (lowest + highest), 0.5 * (highest - lowest));

  ViscoelasticDamping result;
  result.converged = true;
  const std::size_t samples = trajectory.time.size();
  result.force.resize(samples);
  result.max_contact_radius = law.contact_radius(highest);
  const PermanentPeriod normal = permanent_period(spring, path, normal_moves);
  const PermanentPeriod tangential = permanent_period(spring, path, moves);
  // A spring stays in contact for the whole period if its force is always positive.
  double permanent_depth = highest;
  for (std::size_t i = 0; i < samples; ++i)
    permanent_depth = std::min(permanent_depth, trajectory.indentation[i] + normal.branch_force[i]);
  result.min_contact_radius =
      std::min(law.contact_radius(permanent_depth), result.max_contact_radius);

  const double stiffness = 2 * law.contact_modulus(), ratio = law.modulus_ratio();
  const double core = stiffness * result.min_contact_radius;
  result.normal_material_work = core * normal.work;
  result.tangential_material_work = ratio * core * tangential.work;
  const double lifted = stiffness * law.profile().image_integral(result.min_contact_radius);
  for (std::size_t i = 0; i < samples; ++i)
    result.force[i] = core * (trajectory.indentation[i] + normal.branch_force[i]) - lifted;

  const detail::SpringLayout ring(law.profile(), result.min_contact_radius,
                                  result.max_contact_radius, springs);
  // The iteration for each spring starts from the result of the next spring inwards, and that of
  // the innermost from a spring that never leaves contact.
  Branches start = trajectory.indentation.front() - permanent_depth - normal.start;
  LoopProgress progress(on_progress, "viscoelastic", static_cast<Index>(ring.cells.size()));
  for (const detail::SpringLayout::Cell& cell : ring.cells) {
    const NormalPeriod period =
        periodic(spring, path, cell.spring_depth, highest - lowest, start, progress);
    result.converged = period.converged && result.converged;
    if (!progress.advance()) break;
    const double share = stiffness * cell.width;
    result.normal_material_work += share * period.work;
    for (std::size_t i = 0; i < samples; ++i) result.force[i] += share * period.force[i];
    if (!period.opens) {
      result.tangential_material_work += ratio * share * tangential.work;
    } else if (period.closes) {
      const TangentialLoss lost = OpeningSpring(spring, path, moves, period.parts).loss();
      result.tangential_material_work += ratio * share * lost.material;
      result.relaxation_work += ratio * share * lost.relaxation;
    }
  }

  progress.finish();
  set_means(result, path, moves, trajectory.period());
  return result;
}

ViscoelasticLoss viscoelastic_loss(const IndenterLaw& law, const PronySeries& prony,
                                   const Oscillation& motion, double indentation,
                                   const ViscoelasticOptions& options) {
  ViscoelasticLoss loss;
  loss.angular_frequency = std::visit([](const auto& m) { return m.angular_frequency; }, motion);
  const std::complex<double> modulus = prony.complex_modulus(loss.angular_frequency);
  loss.storage_modulus = modulus.real();
  loss.loss_modulus = modulus.imag();
  loss.elastic_work = relaxation_damping(law, at_indentation(indentation), motion).work_per_cycle;
  loss.damping = viscoelastic_damping(law, prony, sample(motion, indentation, options.steps),
                                      options.springs, options.on_progress);
  return loss;
}

}  // namespace salebra
