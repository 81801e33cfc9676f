// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "base/vector_width.hpp"
#include "reference_kernels.hpp"

namespace salebra::detail {

namespace {

struct Width {
  const char* name;
  TileKernels<float> (*single)();
  TileKernels<double> (*dual)();
};

// The vector widths that this machine can run.
std::vector<Width> widths() {
  std::vector<Width> found{{"baseline", baseline::table_float, baseline::table_double}};
#ifdef SALEBRA_X86_KERNELS
  if (vector_width() != VectorWidth::baseline)
    found.push_back({"avx2", avx2::table_float, avx2::table_double});
  if (vector_width() == VectorWidth::avx512)
    found.push_back({"avx512", avx512::table_float, avx512::table_double});
#endif
  return found;
}

constexpr std::ptrdiff_t rows = 9, ny = 53, tiles_per_row = 4;

// Tiles of a few rows, of which the last is narrower, with all kinds of cells: free and held,
// without load, within bounds and beyond them. p and g have 25 bits, so that arithmetic in float
// would show. r, t, w and the weights have so few bits that products and the sums of the stencil
// are exact in any order, fused or not: every array must be equal in all bits.
template <class Real>
struct Tiles {
  std::vector<Tile> tiles;
  std::ptrdiff_t halo_stride = tiles_per_row * tile_width + 2 * side_halo;
  std::vector<double> p, g;
  std::vector<Real> r, t, w, z, m, row;
  std::vector<unsigned char> quiet;
  std::array<Real, stencil_size> stencil{};
  double bound;

  Tiles(std::uint32_t seed, double largest) : bound(largest) {
    std::mt19937 random(seed);
    const auto whole = [&](int limit) {
      return std::uniform_int_distribution<int>(-limit, limit)(random);
    };
    const auto coarse = [&] { return static_cast<Real>(whole(64)) / 8; };
    const auto fine = [&] { return std::ldexp(whole((1 << 25) - 1), -22); };
    for (std::int32_t row_of = 0; row_of < rows; ++row_of)
      for (std::int32_t k = 0; k < tiles_per_row; ++k)
        if (whole(2) != 0) tiles.push_back({row_of, k * tile_width});
    const std::size_t packed = tiles.size() * tile_width;
    for (auto* field : {&t, &w, &z, &m}) field->assign(packed, 0);
    p.assign(packed, 0);
    g.assign(packed, 0);
    r.assign(static_cast<std::size_t>((rows + 2 * halo) * halo_stride), 0);
    row.assign(ny, 0);
    quiet.assign(tiles.size(), 0);
    for (Real& value : row) value = coarse();
    // Symmetric about both axes like InverseStencil: the widest kernels add opposite neighbours
    // before they weight them.
    for (int i = 0; i <= halo; ++i)
      for (int j = 0; j <= halo; ++j) {
        const Real weight = static_cast<Real>(whole(16)) / 8;
        for (const int row_of : {-i, i})
          for (const int column : {-j, j})
            stencil[static_cast<std::size_t>((row_of + halo) * (2 * halo + 1) + column + halo)] =
                weight;
      }
    const auto a = arrays();
    // The halo also holds images of the residual.
    for (Real& value : r) value = coarse();
    for (std::size_t k = 0; k < tiles.size(); ++k) {
      const auto first = static_cast<std::ptrdiff_t>(k);
      quiet[k] = whole(3) == 0;
      // Gaps lie above the plane, so that some quiet tiles stay quiet.
      const bool apart = whole(1) == 0;
      const bool idle = whole(4) == 0;  // held and without load, but not yet quiet
      const bool held = whole(2) == 0;  // loaded, but without a free cell
      reference::for_cells(a, first, first + 1, [&](const reference::Cell& c) {
        const auto at = static_cast<std::size_t>(c.packed);
        g[at] = apart ? std::abs(fine()) + 1 : fine();
        w[at] = coarse();
        z[at] = coarse();
        Real& residual = r[static_cast<std::size_t>(c.with_halo)];
        if (quiet[k] || idle) {
          residual = 0;
          return;
        }
        m[at] = held || whole(1) == 0 ? 0 : 1;
        t[at] = coarse();
        const int kind = whole(2);
        p[at] = kind == 0 ? 0 : kind == 1 ? fine() : std::abs(fine());
        if (std::isfinite(bound) && whole(4) == 0) p[at] = bound;
        residual *= m[at];
      });
    }
  }

  TileArrays<Real> arrays() {
    return {tiles.data(),
            static_cast<std::ptrdiff_t>(tiles.size()),
            ny,
            halo_stride,
            r.data(),
            p.data(),
            g.data(),
            t.data(),
            w.data(),
            z.data(),
            m.data(),
            quiet.data(),
            stencil.data(),
            bound};
  }
  std::ptrdiff_t count() const { return static_cast<std::ptrdiff_t>(tiles.size()); }
  // Returns the tiles [begin, end) of a row that has tiles.
  std::array<std::ptrdiff_t, 2> one_row() const {
    const auto same = [&](const Tile& tile) { return tile.row == tiles[tiles.size() / 2].row; };
    const auto first = std::find_if(tiles.begin(), tiles.end(), same);
    return {first - tiles.begin(), std::find_if_not(first, tiles.end(), same) - tiles.begin()};
  }
  bool operator==(const Tiles& other) const {
    return p == other.p && g == other.g && r == other.r && t == other.t && w == other.w &&
           z == other.z && m == other.m && row == other.row && quiet == other.quiet;
  }
};

// A sum of n <= rows·ny = 477 terms, none above 16², in another order differs by less than
// n·ε·Σ|term| = 477 · 1.1e-16 · 477 · 256 = 6e-9. A fault changes it by the term of a cell, few of
// which are below 1e-3.
bool close(double a, double b) { return a == b || std::abs(a - b) <= 1e-8; }

bool equal(const PreconditionSums& a, const PreconditionSums& b) {
  return close(a.z, b.z) && close(a.zw, b.zw) && close(a.zz, b.zz) && close(a.t, b.t) &&
         close(a.w, b.w) && close(a.r, b.r) && close(a.zr, b.zr) && close(a.tr, b.tr);
}
bool equal(const CurvatureSums& a, const CurvatureSums& b) {
  return close(a.tw, b.tw) && close(a.w, b.w);
}
bool equal(const StepSums& a, const StepSums& b) {
  return close(a.outside, b.outside) && close(a.wrong, b.wrong) && close(a.clipped, b.clipped) &&
         close(a.pressure, b.pressure) && close(a.misfit, b.misfit) &&
         close(a.signed_misfit, b.signed_misfit) && close(a.saturated, b.saturated) &&
         close(a.least, b.least);
}
bool equal(const SetSums& a, const SetSums& b) {
  return close(a.count, b.count) && close(a.g, b.g);
}
bool equal(const GapSums& a, const GapSums& b) {
  return close(a.pressure, b.pressure) && close(a.count, b.count) && close(a.g, b.g) &&
         close(a.misfit, b.misfit) && close(a.distance, b.distance) &&
         close(a.saturated, b.saturated) && close(a.least, b.least);
}

template <class Real>
void compare(const TileKernels<Real>& fast, std::uint32_t seed, double bound) {
  const TileKernels<Real> plain = reference::table<Real>();
  const double plane_height = 0.375, infinity = std::numeric_limits<double>::infinity();
  // Runs call(kernels, tiles) with the fast and with the plain kernels on the same tiles.
  const auto both = [&](const char* kernel, const auto& call) {
    INFO(kernel);
    Tiles<Real> one(seed, bound), other(seed, bound);
    const bool same_sums = call(fast, one, plain, other);
    CHECK(same_sums);
    CHECK(one == other);
  };
  both("residual", [&](auto& f, auto& a, auto& s, auto& b) {
    f.residual(a.arrays(), 0, a.count(), plane_height);
    s.residual(b.arrays(), 0, b.count(), plane_height);
    return true;
  });
  both("precondition", [&](auto& f, auto& a, auto& s, auto& b) {
    return equal(f.precondition(a.arrays(), 0, a.count()),
                 s.precondition(b.arrays(), 0, b.count()));
  });
  both("direct", [&](auto& f, auto& a, auto& s, auto& b) {
    const auto [begin, end] = a.one_row();
    f.direct(a.arrays(), begin, end, {0.25, 0.375, -0.5}, a.row.data());
    s.direct(b.arrays(), begin, end, {0.25, 0.375, -0.5}, b.row.data());
    return true;
  });
  both("take_image", [&](auto& f, auto& a, auto& s, auto& b) {
    const auto [begin, end] = a.one_row();
    return equal(f.take_image(a.arrays(), begin, end, a.row.data()),
                 s.take_image(b.arrays(), begin, end, b.row.data()));
  });
  both("step", [&](auto& f, auto& a, auto& s, auto& b) {
    return equal(f.step(a.arrays(), 0, a.count(), 0.625, plane_height),
                 s.step(b.arrays(), 0, b.count(), 0.625, plane_height));
  });
  both("change_set", [&](auto& f, auto& a, auto& s, auto& b) {
    return equal(f.change_set(a.arrays(), 0, a.count(), plane_height),
                 s.change_set(b.arrays(), 0, b.count(), plane_height));
  });
  // Corrections that only scale, that shift, and that scale but leave cells unchanged at their
  // bound, or beyond half of it.
  struct Correction {
    double scale, shift, full_from;
  };
  for (const Correction& by :
       {Correction{1.25, 0, std::numeric_limits<double>::infinity()},
        Correction{1.25, 0.125, std::numeric_limits<double>::infinity()}, Correction{0.75, 0, 0.5}})
    both("truncate", [&](auto& f, auto& a, auto& s, auto& b) {
      f.truncate(a.arrays(), 0, a.count(), plane_height,
                 {by.scale, by.shift, by.full_from * a.bound});
      s.truncate(b.arrays(), 0, b.count(), plane_height,
                 {by.scale, by.shift, by.full_from * b.bound});
      return true;
    });
  both("spread_change", [&](auto& f, auto& a, auto& s, auto& b) {
    const auto [begin, end] = a.one_row();
    f.spread_change(a.arrays(), begin, end, a.row.data());
    s.spread_change(b.arrays(), begin, end, b.row.data());
    return true;
  });
  both("add_displacement", [&](auto& f, auto& a, auto& s, auto& b) {
    const auto [begin, end] = a.one_row();
    return equal(f.add_displacement(a.arrays(), begin, end, a.row.data()),
                 s.add_displacement(b.arrays(), begin, end, b.row.data()));
  });
  // Any 53 numbers serve as heights; p is used as it is, within bounds and beyond. It is read
  // everywhere or on some tiles; all gaps are stored, or only near ones.
  std::array<unsigned char, tiles_per_row> some{};
  some[0] = some[tiles_per_row - 1] = 1;
  for (const unsigned char* in_use : std::array<const unsigned char*, 2>{nullptr, some.data()})
    for (const double kept_below : {infinity, plane_height + 0.5}) {
      const auto row_of = [&](auto& fields, const std::vector<double>& heights, double* nearest) {
        return GapRow{heights.data(), 0.5,          fields.p.data(), in_use,          ny,
                      bound,          plane_height, kept_below,      fields.g.data(), nearest};
      };
      both("gap", [&](auto& f, auto& a, auto& s, auto& b) {
        const std::vector<double> heights = a.g;
        std::array<double, tiles_per_row> near, near_plain;
        return equal(f.gap(a.row.data(), row_of(a, heights, near.data())),
                     s.gap(b.row.data(), row_of(b, heights, near_plain.data()))) &&
               near == near_plain;
      });
      both("exact_gap", [&](auto& f, auto& a, auto& s, auto& b) {
        const std::vector<double> heights = a.g, u = a.p;
        std::array<double, tiles_per_row> near, near_plain;
        return equal(f.exact_gap(u.data(), row_of(a, heights, near.data())),
                     s.exact_gap(u.data(), row_of(b, heights, near_plain.data()))) &&
               near == near_plain;
      });
    }
  both("clip", [&](auto& f, auto& a, auto& s, auto& b) {
    return close(f.clip(a.p.data(), ny, bound), s.clip(b.p.data(), ny, bound)) &&
           close(f.clip(a.g.data(), ny, infinity), s.clip(b.g.data(), ny, infinity));
  });
}

}  // namespace

TEST_CASE("The tile kernels of every vector width do what the plain ones do", "[normal]") {
  const double bound = GENERATE(std::numeric_limits<double>::infinity(), 4.0);
  for (const Width& width : widths())
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      INFO(width.name << ", seed " << seed << ", bound " << bound);
      compare(width.single(), seed, bound);
      compare(width.dual(), seed, bound);
    }
}

}  // namespace salebra::detail
