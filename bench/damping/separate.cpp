// SPDX-License-Identifier: GPL-3.0-or-later
// Stated errors of the damping of surfaces against K of separate contacts, each pressed from nothing
// at a tolerance of 1e-12.
//   damping_separate [surfaces [points [hurst [free|periodic [first seed]]]]]
// One line per surface, load and amplitude: seed, pressure over E*h', amplitude over rms height, W of
// the parabola through K of the separate contacts over the window of surface_damping(); then over
// it: W of surface_damping(), its error, of that the parts of cells, scatter and solver, and the
// standard error of the parabola; difference over error; intervals, window over u_z, verdict. The
// last line counts.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/surface/moments.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "damping/separate_contacts.hpp"

using namespace salebra;

namespace {

using std::numbers::pi;

const Material material = Material::of_contact_modulus(1e9, 0.3);

constexpr int nodes = 48;

}  // namespace

int main(int argc, char** argv) {
  const int surfaces = argc > 1 ? std::atoi(argv[1]) : 5;
  const Index points = argc > 2 ? std::atoi(argv[2]) : 256;
  const double hurst = argc > 3 ? std::atof(argv[3]) : 0.8;
  const Boundary boundary =
      argc > 4 && std::string_view(argv[4]) == "free" ? Boundary::free : Boundary::periodic;
  const int first = argc > 5 ? std::atoi(argv[5]) : 1;
  const Grid2D grid{points, points, 1e-3, 1e-3};
  const SelfAffineSpectrum spectrum({.hurst = hurst,
                                     .rolloff = 0.25e-3,
                                     .short_cutoff = 32e-6 * 256 / double(points),
                                     .rms_height = 1e-6});
  int cases = 0, misses = 0, far = 0, negative = 0, refused = 0;
  for (int seed = first; seed < first + surfaces; ++seed) {
    const Surface surface = random_phase(grid, spectrum, std::uint64_t(seed));
    const double slope = surface_moments(surface).rms_slope();
    std::vector<double> pressures;
    for (const double load : {0.03, 0.1, 0.3})
      pressures.push_back(load * material.contact_modulus * slope);
    SweepOptions sweep;
    sweep.contact.boundary = boundary;
    const ForceCurve curve = sweep_pressures(surface, material, pressures, sweep);
    std::map<std::pair<std::size_t, double>, Eigen::VectorXd> known;
    for (const double relative : {1e-4, 1e-3, 1e-2}) {
      const Drag motion{relative * height_statistics(surface).rms_height, 1e-6, 2 * pi * 20e3};
      SurfaceDampingOptions options;
      options.boundary = boundary;
      options.keep_cells = true;
      const auto found = surface_damping(surface, material, motion, curve, options);
      for (std::size_t k = 0; k < found.size(); ++k) {
        const SurfaceDamping& damping = found[k];
        const double half = damping.window > 0 ? damping.window : motion.normal_amplitude;
        Eigen::VectorXd& stiffness = known[{k, half}];
        if (stiffness.size() == 0)
          stiffness = separate_stiffnesses(surface, material.contact_modulus,
                                           curve.samples[k].indentation, half, nodes, boundary);
        const WorkOfParabola truth =
            work_of_parabola(stiffness, half, material.modulus_ratio(), motion);
        const double w = truth.work;
        const double ratio = (damping.work_per_cycle - w) /
                             std::hypot(damping.work_per_cycle_error(), 1.8 * truth.error);
        std::printf("%d %.2f %.0e %+.3e %.3f %.3f [%.3f %.3f %.1e] %.3f %+.2f %d %.3g %s\n", seed,
                    pressures[k] / slope / material.contact_modulus, relative, w,
                    damping.work_per_cycle / w, damping.work_per_cycle_error() / w,
                    damping.error.cells / w, damping.error.noise / w, damping.error.solver / w,
                    truth.error / w, ratio, damping.intervals, half / motion.normal_amplitude,
                    damping.converged ? "" : "not converged");
        std::fflush(stdout);
        ++cases;
        refused += !damping.converged;
        misses += damping.converged && !(std::abs(ratio) <= 1);
        far += damping.converged && !(std::abs(ratio) <= 1.6);
        negative += damping.converged && !(damping.work_per_cycle > 0);
      }
    }
  }
  std::printf("%d cases, %d not converged, %d missed, %d by over 1.6 times, %d negative\n", cases,
              refused, misses, far, negative);
}
