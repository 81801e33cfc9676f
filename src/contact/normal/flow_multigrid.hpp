// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Cholesky>
#include <cstdint>
#include <salebra/base/grid.hpp>
#include <span>
#include <vector>

namespace salebra::detail {

// Conductances of the faces of a periodic grid, >= 0: x(i, j) between the cells (i, j) and
// (i + 1, j), y(i, j) between (i, j) and (i, j + 1).
struct FaceConductances {
  Field x, y;
};

// An approximate inverse of the Laplacian of a grid of conductances,
//     (Au)_i = Σ_j T_ij (u_i − u_j),
// by aggregation: the cells of a block of 2 × 2 become one unknown of a coarser level as far as
// they are joined by conductances that matter to the less conducting of them, and so on; levels are
// joined by cycles of two conjugate gradients each [Notay and Vassilevski (2008)]. Channels and
// walls of any width keep their connectedness on all levels, and a jump of T by many decades costs
// no iterations. The inverse is symmetric but for the conjugate gradients inside: the outer
// iteration has to be flexible. Double precision: single precision does not hold the small
// differences of pressure along good conductors in series with bad ones, and is not faster, since
// sweeps wait for their own results. It has the same bits for every thread count.
class FlowMultigrid {
 public:
  // faces must outlive it.
  explicit FlowMultigrid(const FaceConductances& faces);
  // z ≈ A⁻¹r, for r of zero sum over each connected part of the fluid; 0 in closed cells.
  void apply(const Field& residual, Field& z);

  std::size_t levels() const { return levels_.size(); }

 private:
  using Node = std::int32_t;
  using Vector = std::vector<double>;

  // Unknowns in the order of the rows of a grid of blocks. An unknown is joined to those of its own
  // row and of the two next to it alone.
  struct Level {
    std::vector<Node> row_begins;          // first unknown of each row of blocks, and their number
    std::vector<Node> block_column;        // of each unknown
    std::vector<Node> begins, neighbours;  // of each unknown; both empty on the finest level
    Vector conductances;                   // to them
    const double *to_next_x = nullptr, *to_next_y = nullptr;  // finest level: of the faces
    Index columns = 0;                                        // finest level: cells of a row
    Vector inverse_diagonal;                                  // 0: closed
    std::vector<Node> member_begins, members;  // of each unknown of the next level; closed: of none
    Vector x, b, r, c1, c2, v1, v2;            // x, b … v2: not on the finest level

    Index unknowns() const { return row_begins.back(); }
    Index rows() const { return static_cast<Index>(row_begins.size()) - 1; }
    bool is_finest() const { return begins.empty(); }
  };

  template <class Body>
  static void for_neighbours(const Level& level, Index k, const Body& body);
  static Level finest_level(const FaceConductances& faces);
  static Level coarser(Level& fine);
  // The unknowns of the next level, without what joins them; those that they are made of are given
  // to fine. Of each unknown of fine the one that it belongs to, −1: none.
  static std::vector<Node> group(Level& fine, Level& level);
  static void connect(const Level& fine, const std::vector<Node>& coarse_of, Level& level);
  static void allocate(Level& level);
  template <bool forward>
  static void smooth(const Level& level, const double* b, double* x);
  static void multiply(const Level& level, const double* x, double* y);
  static void restrict_residual(const Level& level, const double* b, const double* image,
                                double* coarse);
  static void add_coarse(const Level& level, const double* coarse, double* x);
  void factorise(const Level& level);
  void cycle(std::size_t depth, const double* b, double* x);
  void solve(std::size_t depth, const double* b, double* x);

  std::vector<Level> levels_;
  Eigen::LDLT<Eigen::MatrixXd> coarsest_;
};

}  // namespace salebra::detail
