// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <salebra/base/error.hpp>
#include <salebra/study/body_file.hpp>
#include <string>

using namespace salebra;

namespace {

// The file of a body, removed at the end.
class BodyFile {
 public:
  ~BodyFile() { std::filesystem::remove(path_); }
  Body read(const std::string& text) const {
    std::ofstream(path_) << text;
    return read_body(path_);
  }
  ViscoelasticBody read_viscoelastic(const std::string& text) const {
    std::ofstream(path_) << text;
    return read_viscoelastic_body(path_);
  }

 private:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                ("salebra-body-" + std::to_string(getpid()) + ".toml");
};

const std::string film = "[[layer]]\nthickness = \"5um\"\nyoung = \"3GPa\"\npoisson = 0.49\n",
                  steel = "[base]\nyoung = \"210GPa\"\npoisson = 0.3\n";

}  // namespace

TEST_CASE("A file describes the body that the library makes", "[body_file]") {
  const BodyFile file;
  const double q = 3e5;
  const ElasticLayer layer{5e-6, 3e9, 0.49};
  const ElasticBody base{210e9, 0.3};
  CHECK(file.read(film + steel).compliance(q).normal ==
        Body::layered({layer}, base).compliance(q).normal);
  CHECK(file.read(film + film).compliance(q).normal ==
        Body::layered({layer, layer}).compliance(q).normal);
  CHECK(file.read(steel).half_space_material()->contact_modulus ==
        Material::of_bodies(base).contact_modulus);
  const Body from_base = file.read("datum = \"base\"\n" + film);
  CHECK(from_base.datum() == Datum::base);
  CHECK(from_base.compliance(0).normal > 0);
  CHECK(file.read(film).datum() == Datum::mean_plane);
  CHECK(file.read("[graded]\nmodulus = \"3GPa\"\ndepth = \"1mm\"\nexponent = 0.5\npoisson = 0.3\n")
            .compliance(q)
            .across == Body::graded({3e9, 1e-3, 0.5, 0.3}).compliance(q).across);
  CHECK(file.read("[anisotropic]\nc11 = \"161GPa\"\nc33 = \"61GPa\"\nc13 = \"50GPa\"\n"
                  "c44 = \"38.3GPa\"\nc66 = \"63.4GPa\"\n")
            .compliance(q)
            .normal ==
        Body::transversely_isotropic({161e9, 61e9, 50e9, 38.3e9, 63.4e9}).compliance(q).normal);
}

TEST_CASE("A file describes crystals by constants or by all stiffnesses", "[body_file]") {
  const BodyFile file;
  const std::string cube = "[anisotropic]\nc11 = \"166GPa\"\nc12 = \"64GPa\"\nc44 = \"80GPa\"\n",
                    cut = "normal = [1, 1, 0]\nx = [0, 0, 1]\n";
  const auto silicon = AnisotropicStiffness::cubic(166e9, 64e9, 80e9);
  const auto at = [](const Body& body) { return body.compliance(1e5, 3e5).normal; };
  CHECK(at(file.read(cube)) == at(Body::anisotropic(silicon)));
  CHECK(at(file.read(cube + cut)) ==
        at(Body::anisotropic(silicon.of_surface({1, 1, 0}, {0, 0, 1}))));
  CHECK(at(file.read(cube)) != at(file.read(cube + cut)));
  std::string rows = "[anisotropic]\nstiffness = [";
  for (const auto& row : silicon.c) {
    rows += "[";
    for (const double value : row) rows += "\"" + std::to_string(value / 1e9) + "GPa\", ";
    rows += "],\n  ";
  }
  CHECK(at(file.read(rows + "]\n" + cut)) == at(file.read(cube + cut)));

  using Catch::Contains;
  CHECK_THROWS_WITH(file.read("[anisotropic]\nstiffness = [1, 2, 3]\n"),
                    Contains(":2:") && Contains("must be a row"));
  CHECK_THROWS_WITH(file.read("[anisotropic]\nstiffness = 3\n"), Contains("array of rows"));
  CHECK_THROWS_WITH(file.read("[anisotropic]\nstiffness = [[1, 2], [2, 3]]\n"),
                    Contains("6 rows of 6"));
  CHECK_THROWS_WITH(file.read(rows + "]\nc11 = 1\n"), Contains("c11"));
  CHECK_THROWS_WITH(file.read(cube + "normal = [0, 0, 0]\n"),
                    Contains(":5: anisotropic.normal: is given without x; give both"));
  CHECK_THROWS_WITH(file.read(cube + "x = [0, 0, 1]\n"),
                    Contains(":5: anisotropic.x: is given without normal"));
  CHECK_THROWS_WITH(file.read(cube + "x = [0, 0, 1]\nnormal = [0, 0, 0]\n"),
                    Contains(":6: anisotropic.normal: 0 is its length, which must be > 0"));
  CHECK_THROWS_WITH(file.read(cube + "normal = [1, 1]\nx = [0, 0, 1]\n"),
                    Contains(":5:") && Contains("three numbers"));
  CHECK_THROWS_WITH(file.read(cube + "normal = [1, 1, 0]\nx = [1, 0, 0]\n"),
                    Contains(":6:") && Contains("perpendicular"));
  // The kind of body follows from its constants; with too few of them all are named.
  for (const std::string constants : {"", "c11 = 3\n", "c44 = 1\nc11 = 3\n"})
    CHECK_THROWS_WITH(file.read("[anisotropic]\n" + constants),
                      Contains("is missing; a cubic body needs c11, c12 and c44"));
  CHECK_THROWS_WITH(file.read("[anisotropic]\nc11 = 3\nc44 = 1\n"), Contains(".c12: is missing"));
  CHECK_THROWS_WITH(file.read("[anisotropic]\nc11 = 3\nc33 = 3\nc44 = 1\nc66 = 1\n"),
                    Contains(".c13: is missing; a cubic body"));
  CHECK_THROWS_WITH(file.read("[anisotropic]\nc11 = 3\nc33 = 3\nc12 = 1\nc13 = 1\nc44 = 1\n"),
                    Contains(":4: anisotropic.c12: is of a cubic body") && Contains("c66 ="));
  CHECK_THROWS_WITH(file.read("[anisotropic]\nc11 = 2\nc12 = 3\nc44 = 1\n"),
                    Contains("stiffness") && Contains("positive definite"));
}

TEST_CASE("A file of a body names each mistake with its line", "[body_file]") {
  const BodyFile file;
  using Catch::Contains;
  CHECK_THROWS_WITH(file.read("# nothing\n"), Contains("describes one body"));
  CHECK_THROWS_WITH(file.read(film + "[graded]\nmodulus = 1\n"), Contains("describes one body"));
  CHECK_THROWS_WITH(file.read(film + "color = 3\n"), Contains(":5:") && Contains("color"));
  CHECK_THROWS_WITH(file.read("[[layer]]\nthickness = \"5um\"\nyoung = \"3GPa\"\n"),
                    Contains("poisson"));
  CHECK_THROWS_WITH(file.read("[[layer]]\nthickness = \"5um\"\nyoung = \"3GPa\"\npoisson = 0.6\n"),
                    Contains(":4:") && Contains("poisson") && Contains("0.6"));
  CHECK_THROWS_WITH(file.read(film + "[base]\nyoung = 0\npoisson = 0.3\n"),
                    Contains(":6: base.young: must be > 0; a rigid base of layers is left out"));
  CHECK_THROWS_WITH(file.read("datum = \"floor\"\n" + film), Contains("datum"));
  CHECK_THROWS_WITH(file.read("datum = \"base\"\n" + film + steel),
                    Contains("datum") && Contains("rigid base"));
  CHECK_THROWS_WITH(file.read("[anisotropic]\nc11 = 10\nc33 = 10\nc13 = 9\nc44 = 3\nc66 = 3\n"),
                    Contains(":4:") && Contains("c13"));
}

TEST_CASE("A file of a body may have the terms of a Prony series", "[body_file]") {
  const BodyFile file;
  const std::string terms =
      "[[relaxation]]\nweight = 0.8\ntime = \"2ms\"\n[[relaxation]]\nweight = 3\ntime = 0.5\n";
  const ViscoelasticBody found = file.read_viscoelastic(film + terms);
  CHECK(found.body.compliance(3e5).normal == file.read(film).compliance(3e5).normal);
  REQUIRE(found.relaxation.terms.size() == 2);
  CHECK(found.relaxation.relaxed_modulus == 1);
  CHECK(found.relaxation.terms[0].modulus == 0.8);
  CHECK(found.relaxation.terms[0].relaxation_time == Approx(2e-3));
  CHECK(found.relaxation.terms[1].relaxation_time == 0.5);
  CHECK(file.read_viscoelastic(film).relaxation.terms.empty());
  // Where the body must be elastic, the file is refused instead of read without its terms.
  CHECK_THROWS_WITH(file.read(film + terms), Catch::Contains("relaxation: an elastic body"));
  CHECK_THROWS_WITH(file.read_viscoelastic(film + "[[relaxation]]\nweight = 0\ntime = 1\n"),
                    Catch::Contains(":6: relaxation.weight: must be > 0"));
  CHECK_THROWS_AS(file.read_viscoelastic(film + "[[relaxation]]\nweight = 1\n"), InvalidInput);
  CHECK_THROWS_AS(
      file.read_viscoelastic(film + "[[relaxation]]\nweight = 1\ntime = 1\ncolor = 1\n"),
      InvalidInput);
}
