// SPDX-License-Identifier: GPL-3.0-or-later
#include "active_set_cg.hpp"

#include <algorithm>
#include <cmath>
#include <salebra/base/parallel.hpp>
#include <type_traits>

#include "gradient_projection.hpp"

namespace salebra::detail {
namespace {

// Cells closer to contact than this part of h_rms are worked on; later, when little moves, fewer.
constexpr double widest_margin = 0.1, narrowest_margin = 0.03;
// The set of free cells changes when its violations exceed this part of the last step …
constexpr double usual_threshold = 0.5;
// … and when CG stalls, of these, one after the other.
constexpr std::array<double, 2> other_thresholds = {1.0, 0.1};
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
  bool has_direction = false;  // t, w hold a direction and its image
  double curvature = 1;        // <t, w>
  double threshold = usual_threshold;
  double best = std::numeric_limits<double>::infinity();  // estimate of e_c, for patience
  int since_best = 0;
  std::size_t stalls = 0;
  double at_refresh = 1;  // e_c at the last refresh
  int refreshes = 0;
  double estimate = 0;
  bool finished = false;

  bool load_given() const { return target.load_given(); }
  bool stalled() const { return stalls > other_thresholds.size(); }
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
  return {tiles_.data(), grid_.ny,  framed_stride_,  p,    g, t_.get(), w_.get(), r_.get(),
          z_.data(),     m_.data(), stencil_.data(), bound};
}

template <class Real>
void ActiveSetCg<Real>::reset() {
  tiles_.clear();
  in_use_.assign(static_cast<std::size_t>(grid_.nx * tiles_per_row_), 0);
  const Index framed_rows = grid_.nx + 2 * frame;
  if (!t_) {
    t_.reset(new Real[static_cast<std::size_t>(points())]);
    w_.reset(new Real[static_cast<std::size_t>(points())]);
    // A tile's vectors may end beyond the frame of the last row.
    r_.reset(new Real[static_cast<std::size_t>(framed_rows * framed_stride_ + tile_width)]);
  }
  for_rows([&](Index begin, Index end) {
    std::fill(t_.get() + begin * grid_.ny, t_.get() + end * grid_.ny, Real(0));
    std::fill(w_.get() + begin * grid_.ny, w_.get() + end * grid_.ny, Real(0));
    const Index last = end == grid_.nx ? framed_rows : end;
    std::fill(r_.get() + begin * framed_stride_, r_.get() + last * framed_stride_, Real(0));
  });
  std::fill_n(r_.get() + framed_rows * framed_stride_, tile_width, Real(0));
}

// Changes the pressures so that their mean is the one asked, within the bound.
template <class Real>
void ActiveSetCg<Real>::correct_load(const ContactTarget& target, double* p) const {
  const double load = target.value * static_cast<double>(points()), bound = target.bound;
  const bool loaded = sum_rows([&](Index begin, Index end) {
                        return *std::max_element(p + begin * grid_.ny, p + end * grid_.ny);
                      }) > 0;
  if (!loaded) {
    std::fill(p, p + points(), target.value);
    return;
  }
  const auto correction = correction_for_load(load, bound, [&](const LoadCorrection& trial) {
    LoadSums total;
    for (const LoadSums& part : over_rows<LoadSums>([&](Index begin, Index end) {
           LoadSums sums;
           for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k)
             sums.add(trial(p[k], bound), bound);
           return sums;
         }))
      total += part;
    return total;
  });
  for_rows([&](Index begin, Index end) {
    for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k) p[k] = correction(p[k], bound);
  });
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
      for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k) w_[k] = static_cast<Real>(run.p[k]);
    });
    compliance_.apply(w_.get(), w_.get());
    run.has_direction = false;  // its image is gone
    for_rows([&](Index begin, Index end) {
      for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k)
        run.g[k] = static_cast<double>(w_[k]);
    });
  }
  for_rows([&](Index begin, Index end) {
    for (Index k = begin * grid_.ny; k < end * grid_.ny; ++k) run.g[k] -= heights_[k];
  });
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
          std::fill_n(t_.get() + row * grid_.ny + column, width, Real(0));
          std::fill_n(r_.get() + (row + frame) * framed_stride_ + column + frame, width, Real(0));
        }
        used = needed;
      }
  });
  list_tiles();
  begin_set(run, over_tiles<SetSums>(tiles_.size(), [&](Index begin, Index end) {
              SetSums sums;
              for (Index k = begin; k < end; ++k) {
                const Tile tile = tiles_[static_cast<std::size_t>(k)];
                const Index width = std::min<Index>(tile_width, grid_.ny - tile.column);
                const Index dense = tile.row * grid_.ny + tile.column;
                for (Index i = 0; i < width; ++i) {
                  const double p = run.p[dense + i], g = run.g[dense + i];
                  const bool free = p >= bound ? g > run.level : p > 0 || g < run.level;
                  m_[static_cast<std::size_t>(k * tile_width + i)] = free ? Real(1) : Real(0);
                  sums.count += free ? 1 : 0;
                  sums.g += free ? g : 0;
                }
              }
              return sums;
            }));
}

// Number of free cells, the level, and the residual on them, after the set or g changed.
template <class Real>
void ActiveSetCg<Real>::begin_set(Run& run, const std::vector<SetSums>& parts) {
  SetSums total;
  for (const SetSums& part : parts) {
    total.count += part.count;
    total.g += part.g;
  }
  run.count = total.count;
  if (run.load_given() && run.count > 0) run.level = total.g / run.count;
  const auto a = arrays(run.p, run.g, run.target.bound);
  for_tiles(tiles_.size(),
            [&](Index begin, Index end) { kernels_.residual(a, begin, end, run.level); });
}

// Copies the edges of the residual into its frame, so that the stencil sees the periodic images.
template <class Real>
void ActiveSetCg<Real>::frame_residual() {
  if (boundary_ == Boundary::free) return;
  const Index nx = grid_.nx, ny = grid_.ny;
  const auto wrapped = [](Index k, Index n) { return (k % n + n) % n; };
  for_rows([&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row) {
      Real* r = r_.get() + (row + frame) * framed_stride_ + frame;
      for (Index k = 1; k <= frame; ++k) {
        r[-k] = r[wrapped(-k, ny)];
        r[ny + k - 1] = r[wrapped(k - 1, ny)];
      }
    }
  });
  const auto copy_row = [&](Index to, Index from) {
    std::copy_n(r_.get() + (from + frame) * framed_stride_, framed_stride_,
                r_.get() + (to + frame) * framed_stride_);
  };
  for (Index k = 1; k <= frame; ++k) {
    copy_row(-k, wrapped(-k, nx));
    copy_row(nx + k - 1, wrapped(k - 1, nx));
  }
}

// The correction that puts p on the tiles back to the load, given Σp over the cells below the bound.
template <class Real>
LoadCorrection ActiveSetCg<Real>::correction_over_tiles(const Run& run, double pressure) const {
  const double load = run.target.value * static_cast<double>(points()), bound = run.target.bound;
  if (std::isinf(bound)) return {.scale = pressure > 0 ? load / pressure : 1};
  return correction_for_load(load, bound, [&](const LoadCorrection& trial) {
    LoadSums total;
    for (const LoadSums& part : over_tiles<LoadSums>(tiles_.size(), [&](Index begin, Index end) {
           LoadSums sums;
           for (Index k = begin; k < end; ++k) {
             const Tile tile = tiles_[static_cast<std::size_t>(k)];
             const double* p = run.p + tile.row * grid_.ny + tile.column;
             const Index width = std::min<Index>(tile_width, grid_.ny - tile.column);
             for (Index i = 0; i < width; ++i) sums.add(trial(p[i], bound), bound);
           }
           return sums;
         }))
      total += part;
    return total;
  });
}

// Takes new free cells; with truncate also puts p back within its bounds and to
// its load, at the cost of one transform pair.
template <class Real>
void ActiveSetCg<Real>::change_set(Run& run, bool truncate, double pressure) {
  const auto a = arrays(run.p, run.g, run.target.bound);
  if (!truncate) {
    begin_set(run, over_tiles<SetSums>(tiles_.size(), [&](Index begin, Index end) {
                return kernels_.change_set(a, begin, end, run.level);
              }));
    return;
  }
  const LoadCorrection correction =
      run.load_given() ? correction_over_tiles(run, pressure) : LoadCorrection{};
  for_tiles(tiles_.size(), [&](Index begin, Index end) {
    kernels_.truncate(a, begin, end, run.level, correction.scale, correction.shift);
  });
  // In place, so that w keeps the image of the last direction: CG goes on without a restart.
  compliance_.apply(t_.get(), t_.get());
  ++run.outcome.fft_count;
  const auto sums = over_tiles<SetSums>(tiles_.size(), [&](Index begin, Index end) {
    return kernels_.add_displacement(a, begin, end);
  });
  for_rows([&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row)
      for (Index k = 0; k < tiles_per_row_; ++k)
        if (!in_use_[static_cast<std::size_t>(row * tiles_per_row_ + k)])
          std::fill_n(t_.get() + row * grid_.ny + k * tile_width,
                      std::min<Index>(tile_width, grid_.ny - k * tile_width), Real(0));
  });
  begin_set(run, sums);
}

// One step of CG, and the change of the free set that it calls for. Returns false where no free cell is left.
template <class Real>
bool ActiveSetCg<Real>::iterate(Run& run) {
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

  compliance_.apply(t_.get(), w_.get());
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
  } else if (++run.since_best >= run.limits.patience) {
    run.has_direction = false;
    run.since_best = 0;
    if (run.stalls < other_thresholds.size()) run.threshold = other_thresholds[run.stalls];
    ++run.stalls;
  }
  if (worth_a_change || (done && (step.outside > 0 || step.wrong > 0))) {
    change_set(run, step.outside > 0, step.pressure);
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
  if (run.load_given()) correct_load(run.target, run.p);
  dense_gap(run, run.limits.exact);
  const auto [level, residual] = contact_residual(grid_, run.target, rms_height_, run.p, run.g);
  run.level = level;
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
    correct_load(target, p);
  } else {
    run.level = target.value;
  }
  dense_gap(run, false);
  run.level = contact_residual(grid_, target, rms_height_, p, g).level;
  choose_tiles(run, widest_margin);
  while (!run.finished) {
    const bool progressed = iterate(run);
    if (limits.keep_going && !limits.keep_going(run.outcome.iterations, run.estimate))
      run.outcome.interrupted = true;
    if (run.stalled()) break;
    const bool fresh_needed =
        run.estimate < 0.7 * limits.tolerance || run.outcome.interrupted ||
        run.outcome.iterations >= limits.max_iterations ||
        (std::is_same_v<Real, float> && run.estimate < refresh_after * run.at_refresh);
    if (fresh_needed || !progressed) refresh(run);
    if (!progressed) break;
  }
  run.outcome.level = run.level;
  if (run.stalled() && !run.outcome.interrupted) {
    refresh(run);
    if (limits.exact && !run.finished)
      gradient_projection(exact_compliance(), grid_, boundary_, heights_, rms_height_, target,
                          limits, p, g, run.outcome);
  }
  return run.outcome;
}

template class ActiveSetCg<float>;
template class ActiveSetCg<double>;

}  // namespace salebra::detail
