// SPDX-License-Identifier: GPL-3.0-or-later
// The pressure scale of a surface on any body, from its spectrum.
#include <cmath>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/surface/spectrum.hpp>

namespace salebra {

double pressure_scale(const Surface& surface, const Body& body) {
  const PowerSpectrum spectrum = power_spectrum(surface, Window::none);
  const RowPartition columns = spectrum.columns();
  const std::vector<double> squares =
      parallel::sum_blocks(columns, 1, [&](Index begin, Index end, std::span<double> of_block) {
        for (Index i = 0; i < spectrum.grid.nx; ++i)
          for (Index k = begin; k < end; ++k) {
            const Index j = columns.begin() + k;
            const double qx = spectrum.wavenumber_x(i), qy = spectrum.wavenumber_y(j);
            if (qx == 0 && qy == 0) continue;
            const double compliance = body.compliance(qx, qy).normal;
            of_block[0] += spectrum.multiplicity(j) * spectrum.psd(i, k) * spectrum.cell() /
                           (compliance * compliance);
          }
      });
  return 2 * std::sqrt(squares.front());
}

}  // namespace salebra
