// SPDX-License-Identifier: GPL-3.0-or-later
#include "active_set_cg.hpp"

#include <algorithm>
#include <cmath>
#include <salebra/base/parallel.hpp>
#include <type_traits>

namespace salebra::detail {
namespace {

// Cells closer to contact than this part of h_rms are worked on; later, when little moves, fewer.
constexpr double widest_margin = 0.1, narrowest_margin = 0.03;
// The set of free cells changes when its violations exceed this part of the last step …
constexpr double usual_threshold = 0.5;
// … and when e_c has not halved in this many iterations, CG restarts with another threshold.
constexpr int patience = 40;
// In float, the residual is computed afresh when the estimate of e_c has fallen by this factor.
constexpr double refresh_after = 1e-4;
// A start for a finer level needs no more than this many refreshes.
constexpr int most_inexact_refreshes = 3;

template <class Sums, class Kernel>
std::vector<Sums> over_tiles(std::size_t tiles, const Kernel& kernel) {
  return parallel::map_slabs<Sums>(static_cast<Index>(tiles), kernel,
                                   static_cast<Index>(tiles) * tile_width);
}

template <class Kernel>
void for_tiles(std::size_t tiles, const Kernel& kernel) {
  parallel::for_slabs(static_cast<Index>(tiles), kernel, static_cast<Index>(tiles) * tile_width);
}

}  // namespace

template <class Real>
struct ActiveSetCg<Real>::Run {
  ContactTarget target;
  ActiveSetLimits limits;
  double* p;
  double* g;
  ActiveSetOutcome outcome = {};

  double count = 0;            // free cells
  double level = 0;            // λ
  bool set_changed = true;     // count, level and r must be found again
  bool has_direction = false;  // t, w hold a direction and its image
  double curvature = 1;        // <t, w>
  double threshold = usual_threshold;
  double best = std::numeric_limits<double>::infinity();  // estimate of e_c, for patience
  int since_best = 0;
  double at_refresh = 1;  // e_c at the last refresh
  int refreshes = 0;
  double estimate = 0;
  bool finished = false;

  bool load_given() const { return target.kind == ContactTarget::Kind::mean_pressure; }
};

// Over all cells: what the true e_c and the level need.
template <class Real>
struct ActiveSetCg<Real>::DenseSums {
  double least_gap = std::numeric_limits<double>::infinity();  // least g where p is below its bound
  double pressure = 0;                                         // Σp
  double free_count = 0, free_gap = 0;  // cells with 0 < p < bound, and Σg over them
};

template <class Real>
ActiveSetCg<Real>::ActiveSetCg(const Grid2D& grid, double contact_modulus, Boundary boundary,
                               const double* heights, double rms_height)
    : grid_(grid),
      boundary_(boundary),
      heights_(heights),
      rms_height_(rms_height),
      cell_compliance_(salebra::cell_compliance(grid, contact_modulus)),
      contact_modulus_(contact_modulus),
      compliance_(normal_compliance<Real>(grid, contact_modulus, boundary)),
      kernels_(tile_kernels<Real>()),
      tiles_per_row_((grid.ny + tile_width - 1) / tile_width),
      // A tile's vectors may end beyond the frame of the last row.
      framed_stride_(grid.ny + 2 * frame) {
  const InverseStencil inverse(grid);
  for (int i = -frame; i <= frame; ++i)
    for (int j = -frame; j <= frame; ++j)
      stencil_[static_cast<std::size_t>((i + frame) * (2 * frame + 1) + j + frame)] =
          static_cast<Real>(contact_modulus * inverse.weight(i, j));
  static_assert(frame == InverseStencil::radius);
}

template <class Real>
TileArrays<Real> ActiveSetCg<Real>::arrays(double* p, double* g, double bound) {
  return {tiles_.data(), grid_.ny,  framed_stride_,  p,    g, t_.data(), w_.data(), r_.data(),
          z_.data(),     m_.data(), stencil_.data(), bound};
}

template <class Real>
void ActiveSetCg<Real>::reset() {
  tiles_.clear();
  in_use_.assign(static_cast<std::size_t>(grid_.nx * tiles_per_row_), 0);
  t_.assign(static_cast<std::size_t>(points()), Real(0));
  w_.assign(static_cast<std::size_t>(points()), Real(0));
  r_.assign(static_cast<std::size_t>((grid_.nx + 2 * frame) * framed_stride_ + tile_width),
            Real(0));
}

// Multiplies the cells below the bound so that the mean pressure is the one asked.
template <class Real>
void ActiveSetCg<Real>::scale_to_load(const ContactTarget& target, double* p) const {
  const double wanted = target.value * static_cast<double>(points()), bound = target.bound;
  // Scaling may lift cells to the bound, which then scale no more: few rounds, each with at least one cell fewer.
  for (Index round = 0; round <= points(); ++round) {
    struct Sums {
      double below = 0, saturated = 0;
    };
    Sums total;
    for (const Sums& part : over_rows<Sums>([&](Index begin, Index end) {
           Sums sums;
           for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k)
             p[k] < bound ? sums.below += p[k] : sums.saturated += 1;
           return sums;
         })) {
      total.below += part.below;
      total.saturated += part.saturated;
    }
    const double missing = wanted - (total.saturated > 0 ? total.saturated * bound : 0);
    if (total.below <= 0 || missing <= 0) {
      // Nothing that could be scaled: start again from a uniform pressure, which is below the bound.
      std::fill(p, p + points(), target.value);
      return;
    }
    const double scale = missing / total.below;
    const double above = sum_rows([&](Index begin, Index end) {
      double lifted = 0;
      for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k) {
        if (p[k] >= bound) continue;
        p[k] *= scale;
        if (p[k] >= bound) {
          p[k] = bound;
          lifted += 1;
        }
      }
      return lifted;
    });
    if (above == 0) return;
  }
}

template <class Real>
Convolution2D<double>& ActiveSetCg<Real>::exact_compliance() {
  if constexpr (std::is_same_v<Real, double>) {
    return compliance_;
  } else {
    if (!exact_compliance_)
      exact_compliance_ = normal_compliance<double>(grid_, contact_modulus_, boundary_);
    return *exact_compliance_;
  }
}

template <class Real>
void ActiveSetCg<Real>::dense_gap(Run& run, bool exact) {
  ++run.outcome.fft_count;
  if (exact || std::is_same_v<Real, double>) {
    exact_compliance().apply(run.p, run.g);
  } else {
    for_rows([&](Index begin, Index end) {
      for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k)
        w_[static_cast<std::size_t>(k)] = static_cast<Real>(run.p[k]);
    });
    compliance_.apply(w_.data(), w_.data());
    run.has_direction = false;  // its image is gone
    for_rows([&](Index begin, Index end) {
      for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k)
        run.g[k] = static_cast<double>(w_[static_cast<std::size_t>(k)]);
    });
  }
  for_rows([&](Index begin, Index end) {
    for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k) run.g[k] -= heights_[k];
  });
}

template <class Real>
auto ActiveSetCg<Real>::dense_sums(const Run& run) const -> DenseSums {
  const double bound = run.target.bound;
  DenseSums total;
  for (const DenseSums& part : over_rows<DenseSums>([&](Index begin, Index end) {
         DenseSums sums;
         for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k) {
           const double p = run.p[k], g = run.g[k];
           sums.pressure += p;
           if (p >= bound) continue;
           sums.least_gap = std::min(sums.least_gap, g);
           if (p > 0) {
             sums.free_count += 1;
             sums.free_gap += g;
           }
         }
         return sums;
       })) {
    total.least_gap = std::min(total.least_gap, part.least_gap);
    total.pressure += part.pressure;
    total.free_count += part.free_count;
    total.free_gap += part.free_gap;
  }
  return total;
}

// e_c over all cells. Saturated cells must not stand apart from the plane, so they count only where they do.
template <class Real>
double ActiveSetCg<Real>::true_residual(const Run& run, const DenseSums& sums) const {
  const double bound = run.target.bound;
  const double plane = run.load_given() ? sums.least_gap : run.target.value;
  const double misfit = sum_rows([&](Index begin, Index end) {
    double part = 0;
    for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k) {
      const double apart = run.g[k] - plane;
      part += run.p[k] * (run.p[k] < bound ? std::abs(apart) : std::max(apart, 0.0));
    }
    return part;
  });
  double residual = sums.pressure > 0 ? misfit / (sums.pressure * rms_height_) : 0;
  if (!run.load_given()) residual += std::max(0.0, plane - sums.least_gap) / rms_height_;
  return residual;
}

// The tiles that are in use, row by row, with room for what is stored tile after tile.
template <class Real>
void ActiveSetCg<Real>::list_tiles() {
  tiles_.clear();
  for (Index row = 0; row < grid_.nx; ++row)
    for (Index k = 0; k < tiles_per_row_; ++k)
      if (in_use_[static_cast<std::size_t>(row * tiles_per_row_ + k)])
        tiles_.push_back(
            {static_cast<std::int32_t>(row), static_cast<std::int32_t>(k * tile_width)});
  z_.assign(static_cast<std::size_t>(tile_points()), Real(0));
  m_.assign(static_cast<std::size_t>(tile_points()), Real(0));
}

// The tiles of all cells that carry pressure or are closer to the plane than margin·h_rms, and the free cells in them.
template <class Real>
void ActiveSetCg<Real>::choose_tiles(Run& run, double margin) {
  const double near = run.level + margin * rms_height_, bound = run.target.bound;
  for_rows([&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row)
      for (Index k = 0; k < tiles_per_row_; ++k) {
        const Index column = k * tile_width, width = std::min<Index>(tile_width, grid_.ny - column);
        const double* p = run.p + row * grid_.ny + column;
        const double* g = run.g + row * grid_.ny + column;
        bool needed = false;
        for (Index i = 0; i < width; ++i) needed |= (p[i] > 0) | (g[i] < near);
        unsigned char& used = in_use_[static_cast<std::size_t>(row * tiles_per_row_ + k)];
        if (used && !needed) {
          std::fill_n(t_.data() + row * grid_.ny + column, width, Real(0));
          std::fill_n(r_.data() + (row + frame) * framed_stride_ + column + frame, width, Real(0));
        }
        used = needed;
      }
  });
  list_tiles();
  for_tiles(tiles_.size(), [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const Tile tile = tiles_[static_cast<std::size_t>(k)];
      const Index width = std::min<Index>(tile_width, grid_.ny - tile.column);
      const Index dense = tile.row * grid_.ny + tile.column;
      for (Index i = 0; i < width; ++i) {
        const double p = run.p[dense + i], g = run.g[dense + i];
        const bool free = p >= bound ? g > run.level : p > 0 || g < run.level;
        m_[static_cast<std::size_t>(k * tile_width + i)] = free ? Real(1) : Real(0);
      }
    }
  });
  run.set_changed = true;
}

// Number of free cells, the level, and the residual on them, after the set or g changed.
template <class Real>
void ActiveSetCg<Real>::begin_set(Run& run) {
  const auto a = arrays(run.p, run.g, run.target.bound);
  SetSums total;
  for (const SetSums& part : over_tiles<SetSums>(tiles_.size(), [&](Index begin, Index end) {
         SetSums sums;
         for (Index k = begin; k < end; ++k) {
           const Tile tile = tiles_[static_cast<std::size_t>(k)];
           const Index width = std::min<Index>(tile_width, grid_.ny - tile.column);
           const double* g = run.g + tile.row * grid_.ny + tile.column;
           for (Index i = 0; i < width; ++i) {
             const double m = static_cast<double>(m_[static_cast<std::size_t>(k * tile_width + i)]);
             sums.count += m;
             sums.g += m * g[i];
           }
         }
         return sums;
       })) {
    total.count += part.count;
    total.g += part.g;
  }
  run.count = total.count;
  if (run.load_given() && run.count > 0) run.level = total.g / run.count;
  for_tiles(tiles_.size(),
            [&](Index begin, Index end) { kernels_.residual(a, begin, end, run.level); });
  run.set_changed = false;
}

// Copies the edges of the residual into its frame, so that the stencil sees the periodic images.
template <class Real>
void ActiveSetCg<Real>::frame_residual() {
  if (boundary_ == Boundary::free) return;
  const Index nx = grid_.nx, ny = grid_.ny;
  const auto wrapped = [](Index k, Index n) { return (k % n + n) % n; };
  for (Index row = 0; row < nx; ++row) {
    Real* r = r_.data() + (row + frame) * framed_stride_ + frame;
    for (Index k = 1; k <= frame; ++k) {
      r[-k] = r[wrapped(-k, ny)];
      r[ny + k - 1] = r[wrapped(k - 1, ny)];
    }
  }
  const auto copy_row = [&](Index to, Index from) {
    std::copy_n(r_.data() + (from + frame) * framed_stride_, framed_stride_,
                r_.data() + (to + frame) * framed_stride_);
  };
  for (Index k = 1; k <= frame; ++k) {
    copy_row(-k, wrapped(-k, nx));
    copy_row(nx + k - 1, wrapped(k - 1, nx));
  }
}

// Takes new free cells; with truncate also puts p back within its bounds, at the cost of one transform pair.
template <class Real>
void ActiveSetCg<Real>::change_set(Run& run, bool truncate, double scale) {
  const auto a = arrays(run.p, run.g, run.target.bound);
  for_tiles(tiles_.size(),
            [&](Index begin, Index end) { kernels_.change_set(a, begin, end, run.level); });
  if (truncate) {
    for_tiles(tiles_.size(),
              [&](Index begin, Index end) { kernels_.truncate(a, begin, end, scale); });
    // In place, so that w keeps the image of the last direction: CG goes on without a restart.
    compliance_.apply(t_.data(), t_.data());
    ++run.outcome.fft_count;
    for_tiles(tiles_.size(),
              [&](Index begin, Index end) { kernels_.add_displacement(a, begin, end); });
    for_rows([&](Index begin, Index end) {
      std::fill(t_.begin() + begin * grid_.ny, t_.begin() + end * grid_.ny, Real(0));
    });
    for_tiles(tiles_.size(),
              [&](Index begin, Index end) { kernels_.restore_direction(a, begin, end); });
  }
  run.set_changed = true;
}

// One step of CG, and the change of the free set that it calls for. Returns false where no free cell is left.
template <class Real>
bool ActiveSetCg<Real>::iterate(Run& run) {
  if (run.set_changed) begin_set(run);
  if (!(run.count > 0)) return false;
  const bool load_given = run.load_given();
  const auto a = arrays(run.p, run.g, run.target.bound);

  frame_residual();
  PreconditionSums preconditioned;
  for (const auto& part : over_tiles<PreconditionSums>(tiles_.size(), [&](Index begin, Index end) {
         return kernels_.precondition(a, begin, end);
       })) {
    preconditioned.z += part.z;
    preconditioned.zw += part.zw;
    preconditioned.zz += part.zz;
    preconditioned.t += part.t;
    preconditioned.w += part.w;
  }
  // At given load the steps must keep it: directions have no mean over the free cells.
  const double z_mean = load_given ? preconditioned.z / run.count : 0;
  const double t_mean = load_given ? preconditioned.t / run.count : 0;
  const double zw = preconditioned.zw - z_mean * preconditioned.w;
  const double zz = std::max(0.0, preconditioned.zz - preconditioned.z * z_mean);
  const auto direct = [&](double beta) {
    double sum = 0;
    for (const double part : over_tiles<double>(tiles_.size(), [&](Index begin, Index end) {
           return kernels_.direct(a, begin, end, z_mean, beta, t_mean);
         }))
      sum += part;
    return sum;
  };
  const double beta = run.has_direction ? std::max(0.0, -zw / run.curvature) : 0;
  double descent = direct(beta);
  if (descent <= 0 && beta > 0) descent = direct(0);

  compliance_.apply(t_.data(), w_.data());
  ++run.outcome.fft_count;
  run.has_direction = true;
  CurvatureSums curvature;
  for (const auto& part : over_tiles<CurvatureSums>(tiles_.size(), [&](Index begin, Index end) {
         return kernels_.curvature(a, begin, end);
       })) {
    curvature.tw += part.tw;
    curvature.w += part.w;
  }
  run.curvature = curvature.tw;
  const double alpha =
      curvature.tw > 0 && std::isfinite(descent / curvature.tw) ? descent / curvature.tw : 0;
  if (load_given) run.level -= alpha * curvature.w / run.count;

  StepSums step;
  step.least = std::numeric_limits<double>::infinity();
  for (const auto& part : over_tiles<StepSums>(tiles_.size(), [&](Index begin, Index end) {
         return kernels_.step(a, begin, end, alpha, run.level);
       })) {
    step.outside += part.outside;
    step.wrong += part.wrong;
    step.clipped += part.clipped;
    step.pressure += part.pressure;
    step.misfit += part.misfit;
    step.signed_misfit += part.signed_misfit;
    step.saturated += part.saturated;
    step.least = std::min(step.least, part.least);
  }
  ++run.outcome.iterations;
  const double carried =
      step.pressure + (step.saturated > 0 ? step.saturated * run.target.bound : 0);
  const double scale_of_misfit = carried * rms_height_;
  const bool worth_a_change =
      std::sqrt(std::max(step.outside, step.wrong / (cell_compliance_ * cell_compliance_))) >
      run.threshold * std::abs(alpha) * std::sqrt(zz);
  if (scale_of_misfit > 0) {
    run.estimate =
        load_given
            ? (step.signed_misfit - (step.least - run.level) * step.pressure) / scale_of_misfit
            : step.misfit / scale_of_misfit + std::max(0.0, run.level - step.least) / rms_height_;
    if (!worth_a_change) run.estimate += step.clipped / carried;
  } else {
    run.estimate = std::numeric_limits<double>::infinity();
  }
  const bool done = run.estimate < 0.7 * run.limits.tolerance;
  if (run.estimate < 0.5 * run.best) {
    run.best = run.estimate;
    run.since_best = 0;
  } else if (++run.since_best >= patience) {
    run.has_direction = false;
    run.since_best = 0;
    run.threshold = run.threshold < 1 ? 1.0 : 0.1;
  }
  if (worth_a_change || (done && (step.outside > 0 || step.wrong > 0))) {
    const double missing =
        run.target.value * static_cast<double>(points()) - (carried - step.pressure);
    const double scale =
        load_given && step.pressure > 0 && missing > 0 ? missing / step.pressure : 1;
    change_set(run, step.outside > 0, scale);
  }
  return true;
}

// p within its bounds and at its load, g = Gp − h and e_c over all cells, and the tiles that they call for.
template <class Real>
void ActiveSetCg<Real>::refresh(Run& run) {
  const double bound = run.target.bound;
  for_rows([&](Index begin, Index end) {
    for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k)
      run.p[k] = std::clamp(run.p[k], 0.0, bound);
  });
  if (run.load_given()) scale_to_load(run.target, run.p);
  dense_gap(run, run.limits.exact);
  const DenseSums sums = dense_sums(run);
  const double residual = true_residual(run, sums);
  if (run.load_given())
    run.level = sums.free_count > 0 ? sums.free_gap / sums.free_count : sums.least_gap;
  run.outcome.residual = residual;
  run.at_refresh = std::max(residual, std::numeric_limits<double>::min());
  ++run.refreshes;
  run.outcome.converged = residual < run.limits.tolerance;
  run.finished = run.outcome.converged || run.outcome.interrupted ||
                 run.outcome.iterations >= run.limits.max_iterations ||
                 (!run.limits.exact && run.refreshes >= most_inexact_refreshes);
  if (!run.finished)
    choose_tiles(run, std::min(widest_margin, std::max(narrowest_margin, 20 * residual)));
}

template <class Real>
ActiveSetOutcome ActiveSetCg<Real>::solve(const ContactTarget& target,
                                          const ActiveSetLimits& limits, double* p, double* g) {
  reset();
  Run run{target, limits, p, g};
  if (run.load_given()) {
    scale_to_load(target, p);
  } else {
    run.level = target.value;
  }
  dense_gap(run, false);
  if (run.load_given()) {
    const DenseSums sums = dense_sums(run);
    run.level = sums.free_count > 0 ? sums.free_gap / sums.free_count : sums.least_gap;
  }
  choose_tiles(run, widest_margin);
  while (!run.finished) {
    const bool progressed = iterate(run);
    if (limits.keep_going && !limits.keep_going(run.outcome.iterations, run.estimate))
      run.outcome.interrupted = true;
    const bool fresh_needed =
        run.estimate < 0.7 * limits.tolerance || run.outcome.interrupted ||
        run.outcome.iterations >= limits.max_iterations ||
        (std::is_same_v<Real, float> && run.estimate < refresh_after * run.at_refresh);
    if (fresh_needed || !progressed) refresh(run);
    if (!progressed) break;
  }
  run.outcome.level = run.level;
  return run.outcome;
}

template class ActiveSetCg<float>;
template class ActiveSetCg<double>;

}  // namespace salebra::detail
