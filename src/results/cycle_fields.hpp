// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/damping/cycle.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/provenance.hpp>
#include <string>
#include <vector>

namespace salebra {

/// What a frame shows of a state, (nx, ny).
struct CycleFrame {
  Field contact;
  Field traction_x, traction_y;          ///< Pa
  Field displacement_x, displacement_y;  ///< m
  Field contact_pressure;                ///< Pa
  Field gap;                             ///< m
  Field loss;                            ///< J/m²; empty where nothing slips
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

/// Where the fields lie, (nx, ny, 3).
struct CycleMesh {
  std::vector<double> cells;  ///< m
};

constexpr void describe(auto&& visit, std::type_identity<CycleMesh>) {
  visit(&CycleMesh::cells, Quantity{"cells", Dimension::length, "middles of the cells"});
}

/// Fields of a simulated cycle at chosen steps, for ParaView and for any reader of HDF5:
///     PREFIX.xdmf          what to open; lists the steps written so far
///     PREFIX-mesh.h5       /mesh/points (nx, ny, 3): where each cell's middle lies, and
///                          /mesh/heights
///     PREFIX-0016.h5       /fields/… at step 16: a CycleFrame; its loss is that since the start of
///                          the period
/// One object is for the states of one cycle. All are (nx, ny) with x first. The points are given
/// one by one, so that no reader has to guess which index is x. Every file is complete as soon as
/// it is there; an interrupted run leaves the steps that it has finished.
class CycleFields {
 public:
  /// Writes the mesh. Throws as require_output does, for any of its files.
  CycleFields(std::filesystem::path prefix, const Surface& surface, Provenance provenance,
              const WriteOptions& options = {});

  /// The names of its files where these steps are written: the list, the mesh, and the steps.
  static std::vector<std::filesystem::path> files(const std::filesystem::path& prefix,
                                                  const std::vector<int>& steps);

  /// Adds the state at a step, or replaces what was written of it. time: in periods. normal: the
  /// pressure, of a stuck contact, and the gap, of one without coupling; a default one where
  /// nothing is in contact.
  void write(const CycleState& state, double time, const NormalContactState& normal);

  /// Steps that an earlier, interrupted run has written, so that the list names them too.
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
