// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <chrono>
#include <cstdio>
#include <salebra/base/error.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>

#include "../contact/normal/rough_surface.hpp"

using namespace salebra;
using namespace salebra::test;
using std::numbers::pi;

TEST_CASE("try sphere", "[.try]") {
  const double R = 5e-3, delta = 4e-6;
  const Material material = Material::of_contact_modulus(4e6, 0.5);
  const IndenterLaw law(paraboloid_profile(R), material);
  const PronySeries series{1e6, {{3e6, 0.02}}};
  for (const Index n : {32, 64}) {
    const double side = 2.6 * std::sqrt(R * 8e-6);
    const Surface surface = [&] {
      Surface s = surface_of({n, n, side, side}, [&](double x, double y) {
        const double dx = x - side / 2 + 0.3 * side / double(n), dy = y - side / 2 + 0.2 * side / double(n);
        return -(dx * dx + dy * dy) / (2 * R);
      });
      s.periodic = false;
      return s;
    }();
    for (const double wt : {0.01, 0.3, 1.0, 10.0, 100.0})
      for (const double amp : {0.5, 1.0}) {
        const EqualFrequency motion{amp * delta * 0.9, 3e-7, 0.9, wt / 0.02};
        ViscoelasticCycleOptions options;
        options.contact.boundary = options.stick.boundary = Boundary::free;
        options.steps = 32;
        const auto t0 = std::chrono::steady_clock::now();
        const auto c = viscoelastic_cycle(surface, material, series, motion, at_indentation(delta), options);
        const double sec = std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
        const auto m = viscoelastic_damping(law, series, sample(motion, c.indentation, 32));
        std::printf("n %ld wt %g amp %g | Wn %.5g / %.5g = %.4f  Wt %.5g / %.5g = %.4f jump %.4g rel %.4g F %.4f err %.2e balance %.1e cycles %d res %.1e %s %.2fs\n", long(n), wt, amp,
                    c.normal_work, m.normal_material_work, c.normal_work / m.normal_material_work, c.tangential_work,
                    m.tangential_material_work + m.relaxation_work, c.tangential_work / (m.tangential_material_work + m.relaxation_work),
                    c.jump_work, m.relaxation_work, c.mean_force / m.mean_force, c.work_per_cycle_error / c.work_per_cycle, c.dissipated / c.work_per_cycle - 1, c.cycles, c.residual,
                    std::string(name_of(c.termination)).c_str(), sec);
        std::fflush(stdout);
      }
  }
}
