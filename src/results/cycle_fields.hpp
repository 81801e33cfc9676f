// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/damping/cycle.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <string>
#include <vector>

namespace salebra {

/// The fields at one chosen step, each (nx, ny).
struct CycleFrame {
  Field contact;
  Field traction_x, traction_y;          ///< Pa
  Field displacement_x, displacement_y;  ///< m
  Field contact_pressure;                ///< Pa
  Field gap;                             ///< m
  /// Energy lost per area since the start of the period, J/m²; empty without slip.
  Field loss;
};

constexpr void describe(auto&& visit, std::type_identity<CycleFrame>) {
  using enum Dimension;
  using S = CycleFrame;
  visit(&S::contact, Quantity{"contact", dimensionless, "1 in contact, 0 not"});
  visit(&S::traction_x, Quantity{"traction_x", pressure, "shear traction along x"});
  visit(&S::traction_y, Quantity{"traction_y", pressure, "shear traction along y"});
  visit(&S::displacement_x,
        Quantity{"displacement_x", length, "displacement of cells in contact along x"});
  visit(&S::displacement_y,
        Quantity{"displacement_y", length, "displacement of cells in contact along y"});
  visit(&S::contact_pressure, Quantity{"contact_pressure", pressure, "contact pressure"});
  visit(&S::gap, Quantity{"gap", length, "gap of the deformed surfaces"});
  visit(&S::loss, Quantity{"loss", energy_per_area, "energy dissipated in a period by unit area"});
}

/// Centres of the cells in space, (nx, ny, 3).
struct CycleMesh {
  std::vector<double> cells;  ///< coordinates x, y, z of each cell, m
};

constexpr void describe(auto&& visit, std::type_identity<CycleMesh>) {
  visit(&CycleMesh::cells, Quantity{"cells", Dimension::length, "middles of the cells"});
}

/// Writes fields of one simulated cycle at chosen steps, for ParaView and for any reader of HDF5:
///     PREFIX.xdmf          the file to open; lists the steps written so far
///     PREFIX-mesh.h5       /mesh/points (nx, ny, 3): centre of each cell, and /mesh/heights
///     PREFIX-0016.h5       /fields/NAME at step 16, for each field of a CycleFrame
/// All fields are (nx, ny) with x first. The mesh lists every point, so no reader has to guess
/// which index is x. A file appears only when it is complete; an interrupted run leaves the files
/// of the steps that it has finished.
class CycleFields {
 public:
  /// Writes the mesh. Throws as require_output() does for each file that will be written.
  CycleFields(std::filesystem::path prefix, const Surface& surface, Provenance provenance,
              const WriteOptions& options = {});

  /// The names of all files written for these steps: the XDMF file, the mesh, and one file per
  /// step.
  static std::vector<std::filesystem::path> files(const std::filesystem::path& prefix,
                                                  const std::vector<int>& steps);

  /// Writes the state at a step, and replaces an earlier file of that step. time: in periods.
  /// normal: the normal contact at this step, from which the pressure of a stuck contact and the
  /// gap of a contact without coupling are taken; default-constructed if nothing is in contact.
  void write(const CycleState& state, double time, const NormalContactState& normal);

  /// Adds a step that an earlier, interrupted run has written to the list in PREFIX.xdmf.
  void keep(int step, double time);

 private:
  struct Frame {
    int step;
    double time;
    std::vector<std::string> fields;
  };
  static std::filesystem::path frame_file(const std::filesystem::path& prefix, int step);
  std::filesystem::path frame_file(int step) const { return frame_file(prefix_, step); }
  Field gap_of(const NormalContactState& normal) const;
  void add(int step, double time, std::vector<std::string> fields);
  void write_list() const;

  std::filesystem::path prefix_;
  Grid2D grid_;
  Field heights_;
  Provenance provenance_;
  std::vector<Frame> frames_;
};

}  // namespace salebra
