// SPDX-License-Identifier: GPL-3.0-or-later
// Files that salebra 0.1.0 wrote, in its last revision before this one (a359a99): this version reads
// them. The folder files_of_0.1.0 has them as that program wrote them:
//   generate --points 16 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 250nm
//     --rms-height 2nm -o surface.h5
//   sweep surface.h5 --contact-modulus 115GPa --poisson 0.3 --pressures 10MPa:3GPa:6 --stiffness
//     -o curve.h5
//   contact surface.h5 --contact-modulus 115GPa --pressure 100MPa -o contact.h5
//   study study.toml -o study.h5
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "run_program.hpp"

using Catch::Contains;

namespace {

struct FormerFiles : ProgramTest {
  FormerFiles() {
    for (const auto& file : std::filesystem::directory_iterator(SALEBRA_FORMER_FILES))
      std::filesystem::copy(file, folder());
  }
};

}  // namespace

TEST_CASE_METHOD(FormerFiles, "Surfaces and contacts of 0.1.0 are read", "[former]") {
  // What that program printed of them. It wrote the heights of this seed to the last bit.
  CHECK(number(answer("statistics surface.h5"), "/rms_height") ==
        Approx(2.034738594885015e-9).epsilon(1e-9));
  done(
      "generate --points 16 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 250nm "
      "--rms-height 2nm -o again.h5");
  done("convert surface.h5 former.npy");
  done("convert again.h5 now.npy");
  CHECK(read("former.npy") == read("now.npy"));
  const auto contact =
      answer("contact surface.h5 --contact-modulus 115GPa --pressure 100MPa --initial contact.h5");
  CHECK(contact.at("converged") == true);
}

TEST_CASE_METHOD(FormerFiles, "Curves and studies of 0.1.0 are laws, and are reported",
                 "[former]") {
  const auto fit = answer("fit curve.h5 --pressure-window 10MPa,3GPa");
  const auto now = [&] {
    done(
        "contact surface.h5 --contact-modulus 115GPa --poisson 0.3 --pressure 10MPa:3GPa:6 "
        "--stiffness -o now.h5");
    return answer("fit now.h5 --pressure-window 10MPa,3GPa");
  }();
  CHECK(number(fit, "/decay_length") == Approx(number(now, "/decay_length")).epsilon(1e-6));
  const std::string motion =
      " --pressure 100MPa --normal-amplitude 0.05nm --drag-velocity 1um/s --frequency 20kHz "
      "--poisson 0.3";
  CHECK(
      number(answer("damping --curve curve.h5" + motion), "/damping_constant") ==
      Approx(number(answer("damping --curve now.h5" + motion), "/damping_constant")).epsilon(1e-6));
  for (const char* file : {"curve.h5 --pressure-window 10MPa,400MPa", "study.h5"})
    CHECK_THAT(done(std::string("export --to csv ") + file).out, Contains("# Source: "));
  done("study study.toml -o again.h5 --no-report");
  // A build without plotly.js writes no reports.
  const int status = run("report again.h5").status;
  CHECK(run("report study.h5").status == status);
}
