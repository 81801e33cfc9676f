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

// Approximate inverse, by aggregation, of the Laplacian A of a grid of conductances T_ij between
// cells i and j, which gives the net outflow at the pressures u,
//     (Au)_i = Σ_j T_ij (u_i − u_j).
// The cells of a block of 2 × 2 become one unknown of a coarser grid level if the conductances
// between them matter to the cell that conducts least, and so on from level to level; two steps of
// conjugate gradients on each level connect it to the next finer one [Notay and Vassilevski
// (2008)]. Channels and walls of any width stay connected on all levels, and jumps of T by many
// decades cost no iterations. The inverse is symmetric except for the conjugate gradients inside,
// so the outer iteration must be flexible. It uses double precision: single precision does not hold
// the small pressure differences along good conductors in series with bad ones, and is not faster,
// since a Gauss–Seidel sweep waits for its own results. Results have the same bits for every thread
// count.
class FlowMultigrid {
 public:
  // faces: conductances, which must outlive this object.
  explicit FlowMultigrid(const FaceConductances& faces);
  // z ≈ A⁻¹·residual; the residual must have zero sum over each connected part of the fluid. z is 0
  // in closed cells.
  void apply(const Field& residual, Field& z);

  std::size_t levels() const { return levels_.size(); }

 private:
  using Node = std::int32_t;
  using Vector = std::vector<double>;

  // One level. Unknowns are in the order of the rows of a grid of blocks. An unknown is connected
  // only to unknowns of its own row and of the two adjacent rows.
  struct Level {
    // Number of the first unknown of each row of blocks; last element: the number of unknowns.
    std::vector<Node> row_begins;
    std::vector<Node> block_column;        // column of each unknown's block
    std::vector<Node> begins, neighbours;  // for each unknown; both empty on the finest level
    Vector conductances;                   // to the neighbours
    const double *to_next_x = nullptr, *to_next_y = nullptr;  // finest level: conductances of faces
    Index columns = 0;                                        // finest level: cells of a row
    Vector inverse_diagonal;                                  // 0 for closed unknowns
    // Members of each unknown of the next level; closed unknowns belong to none.
    std::vector<Node> member_begins, members;
    Vector x, b, r, c1, c2, v1, v2;  // x, b … v2: not on the finest level

    Index unknowns() const { return row_begins.back(); }
    Index rows() const { return static_cast<Index>(row_begins.size()) - 1; }
    bool is_finest() const { return begins.empty(); }
  };

  template <class Body>
  static void for_neighbours(const Level& level, Index k, const Body& body);
  static Level finest_level(const FaceConductances& faces);
  static Level coarser(Level& fine);
  // Makes the unknowns of the next coarser level without their connections, and stores in `fine`
  // which of its unknowns are members of each. Returns for each unknown of `fine` the coarse
  // unknown that it belongs to, or −1 if there is none.
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
