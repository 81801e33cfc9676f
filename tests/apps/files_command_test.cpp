// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>

#include "run_program.hpp"

using Catch::Contains;

namespace {

const double undefined = std::numeric_limits<double>::quiet_NaN();

const std::vector<std::string> written{".h5", ".npy", ".gsf", ".txt", ".xyz", ".gwy"};

/// Four by three points on 8 µm by 3 µm without any symmetry, one undefined, with five digits,
/// which float32 keeps.
const std::string scan =
    "# Width: 8 um\n# Height: 3 um\n# Value units: nm\n"
    "1.25 2 -3.5 4\n5 nan 7 0.5\n9.75 -10 11 12.5\n";

}  // namespace

TEST_CASE("convert draws the surface that it writes", "[files][plot]") {
  const ProgramTest test;
  test.write("scan.txt", scan);
  test.done("convert scan.txt scan.h5 --plot scan.svg");
  CHECK_THAT(test.read("scan.svg"), Contains("µm"));
  CHECK(test.files() == "scan.txt scan.h5 scan.svg");
}

TEST_CASE(
    "convert leads from every written format to every other and keeps heights, sizes and axes",
    "[files]") {
  const ProgramTest test;
  test.write("scan.txt", scan);
  const auto check = [&](const std::string& file) {
    INFO(file);
    const auto result = test.run("convert " + file + " seen.txt --overwrite");
    INFO(result.err);
    REQUIRE(result.status == 0);
    std::istringstream text(test.read("seen.txt"));
    std::string line;
    for (const double size : {0., 8e-6, 3e-6, 0., 0.}) {  // channel, width, height, unit, points
      std::getline(text, line);
      if (size > 0)
        CHECK(std::stod(line.substr(line.find(':') + 1)) == Approx(size).epsilon(1e-12));
    }
    CHECK(line == "# Points: 12");
    for (const double expected :
         {1.25, 2., -3.5, 4., 5., undefined, 7., .5, 9.75, -10., 11., 12.5}) {
      std::string word;
      REQUIRE(text >> word);
      if (std::isnan(expected))
        CHECK(word == "nan");
      else
        CHECK(std::stod(word) == Approx(1e-9 * expected).epsilon(1e-7));
    }
  };
  for (const std::string& from : written) {
    test.done("convert scan.txt from" + from);
    const auto described = test.answer("statistics from" + from + " --detrend none");
    CHECK(described["nx"] == 4);
    CHECK(described["undefined_points"] == 1);
    for (const std::string& to : written) {
      test.done("convert from" + from + " to" + to + " --overwrite");
      check("to" + to);
    }
  }
}

TEST_CASE("statistics refuses each broken file with status 2 and one line", "[files][bad-input]") {
  const ProgramTest test;
  test.write("scan.txt", scan);
  for (const std::string& format : written) {
    test.done("convert scan.txt whole" + format);
    const std::string whole = test.read("whole" + format);
    for (const std::size_t part : {whole.size() - 1, whole.size() / 2, whole.size() / 8}) {
      test.write("cut" + format, whole.substr(0, part));
      std::filesystem::remove(test.folder() / ("cut" + format + ".json"));
      const auto result = test.run("statistics cut" + format);
      INFO(format << " cut to " << part << ": " << result.err);
      // Text that loses its last line end is whole.
      if (part + 1 == whole.size() && (format == ".txt" || format == ".xyz")) {
        CHECK(result.status == 0);
        continue;
      }
      check_refused(result, "cut" + format);
    }
  }
}

TEST_CASE("statistics refuses files that declare what cannot be", "[files][bad-input]") {
  const ProgramTest test;
  const auto nul = [](std::size_t count) { return std::string(count, '\0'); };
  const auto number = [](double value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto padded = [&](std::string header, std::size_t alignment) {
    return header.append(alignment - header.size() % alignment, '\0');
  };
  const std::string gsf = "Gwyddion Simple Field 1.0\n";
  const std::string size = "# Width: 2 um\n# Height: 2 um\n";
  const auto [name, content, expected] = GENERATE_REF(table<std::string, std::string, std::string>({
      {"empty.txt", "", "empty"},
      {"bomb.npy",
       std::string("\x93NUMPY\1\0\x56\0", 10) +
           "{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999, 99999999999)}         ",
       "bomb.npy"},
      {"negative.npy",
       std::string("\x93NUMPY\1\0\x40\0", 10) +
           "{'descr': '<f8', 'fortran_order': False, 'shape': (-1, 4)}      " + nul(64),
       "broken NPY header"},
      {"bomb.gsf", padded(gsf + "XRes = 100000\nYRes = 100000\n", 4), "more than it holds"},
      {"negative.gsf", padded(gsf + "XRes = -2\nYRes = 2\n", 4), "XRes = '-2'"},
      {"size.gsf", padded(gsf + "XRes = 1\nYRes = 1\nXReal = -1\nYReal = 1\n", 4) + nul(4),
       "XReal = '-1'"},
      {"nansize.gsf", padded(gsf + "XRes = 1\nYRes = 1\nXReal = nan\nYReal = 1\n", 4) + nul(4),
       "XReal = 'nan'"},
      {"comma.gsf", padded(gsf + "XRes = 1\nYRes = 1\nXReal = 1,5\nYReal = 1\n", 4) + nul(4),
       "XReal = '1,5'"},
      {"inf.gsf",
       padded(gsf + "XRes = 1\nYRes = 1\nXReal = 1\nYReal = 1\n", 4) + nul(2) + "\x80\x7f",
       "infinite"},
      {"bomb.sur", "DIGITAL SURF" + nul(500), "bits"},
      {"no.x3p", std::string("PK\3\4") + nul(60), "ZIP"},
      {"utf16.txt", std::string("\xff\xfe#\0 \0001\0\n", 9), "UTF-16"},
      {"utf16-without-mark.txt", std::string("1\0 \0002\0\n\0", 8), "NUL"},
      {"ambiguous.txt", size + "1,5\n2,5\n", "line 3"},
      {"mixed.txt", size + "1;2\n3 4\n", "line 4"},
      {"later.txt", size + "1.5;2\n2,5;3\n", "line 4"},
      {"inf.txt", size + "1 2\n3 -inf\n", "infinite"},
      {"ragged.txt", size + "1 2\r\n3\r\n", "line 4"},
      {"negative.txt", "# Width: -2 um\n# Height: 2 um\n1 2\n3 4\n", "size_x"},
      {"words.txt", "These are\nno heights.\n", "no numbers"},
      {"irregular.xyz", "0 0 1\n1 0 2\n2.4 0 1\n0 1 1\n1 1 2\n2.4 1 1\n", "equally spaced"},
      {"sparse.xyz", "0 0 1\n1 1 2\n2 2 3\n3 3 4\n4 4 5\n", "half"},
      {"damaged.h5", "\x89HDF\r\n\x1a\n" + nul(200), "HDF5"},
  }));
  INFO(name);
  test.write(name, content);
  check_refused(test.run("statistics " + name), expected);
}

TEST_CASE("statistics reads text with a byte order mark, CR LF and decimal commas", "[files]") {
  const ProgramTest test;
  const auto content =
      GENERATE(as<std::string>(),
               "\xef\xbb\xbf# Width: 3 um\r\n# Height: 3 um\r\n"
               "1,5;2;3\r\n3;4,25;1\r\n5;6;7,25\r\n",
               "# Width: 3 \xb5m\r# Height: 3 \xb5m\r1.5\t2\t3\r3\t4.25\t1\r5\t6\t7.25\r",
               "# Width: 3e-6 m\n# Height: 3e-6 m\n1.5,2,3\n3,4.25,1\n5,6,7.25\n");
  test.write("scan.txt", content);
  const auto result = test.answer("statistics scan.txt --detrend none");
  CHECK(result["size_x"] == Approx(3e-6));
  CHECK(result["mean"] == Approx(33. / 9));
}

TEST_CASE("A file that a command reads is never replaced, by whatever name", "[files][bad-input]") {
  const ProgramTest test;
  const auto folder = test.folder();
  test.done(
      "generate --points 16 --size-x 10um --hurst 0.8 --short-cutoff 2.5um --rms-height 10nm -o "
      "in.h5");
  std::filesystem::create_symlink("in.h5", folder / "link.h5");
  std::filesystem::create_hard_link(folder / "in.h5", folder / "same.h5");
  std::filesystem::create_directory_symlink(".", folder / "here");
  const std::string surface = test.read("in.h5");
  const std::string contact = "contact in.h5 --contact-modulus 1GPa --pressure 1MPa --overwrite ";
  for (const std::string& name :
       {std::string("in.h5"), std::string("./in.h5"), std::string("link.h5"),
        std::string("same.h5"), std::string("here/in.h5"), (folder / "in.h5").string()}) {
    INFO(name);
    check_refused(test.run(contact + "-o " + name), "is the SURFACE too; name another file");
    check_refused(test.run(contact + "--checkpoint " + name), "--checkpoint: ");
    check_refused(test.run("convert in.h5 --overwrite " + name), "is the SURFACE too");
  }
  // A study file names its surface itself, and a page is written beside the results.
  test.write("study.toml",
             "[surface]\nfile = \"in.h5\"\n[material]\ncontact_modulus = \"1GPa\"\npoisson = 0.3\n"
             "[contact]\nrelative_pressures = \"1e-3:0.1:4\"\n[damping]\nmode = \"drag\"\n"
             "normal_amplitude = \"1nm\"\ndrag_velocity = \"1um/s\"\nfrequency = \"20kHz\"\n");
  check_refused(test.run("study study.toml -o ./in.h5 --overwrite"), "is the surface.file too");
  const std::string oscillate =
      "oscillate --surface f-mesh.h5 --pressure 1MPa --contact-modulus 1GPa --poisson 0.3 "
      "--normal-amplitude 1nm --tangential-amplitude 1nm --phase 45deg --overwrite ";
  std::filesystem::copy_file(folder / "in.h5", folder / "f-mesh.h5");
  check_refused(test.run(oscillate + "--fields ./f"), "--fields: ./f-mesh.h5 is the --surface too");
  CHECK(test.read("in.h5") == surface);
  CHECK(test.read("f-mesh.h5") == surface);

  test.done("contact in.h5 --contact-modulus 1GPa --pressure 1MPa:9MPa:4 -o curve.h5");
  const std::string curve = test.read("curve.h5");
  check_refused(test.run("fit curve.h5 -o here/./curve.h5 --overwrite"), "is the CURVE too");
  CHECK(test.read("curve.h5") == curve);
  check_refused(test.run("damping --curve in.h5 -o in.h5 --overwrite"), "is the --curve too");
  check_refused(test.run("report in.h5 -o here/in.h5 --overwrite"), "is the RESULTS too");
}

TEST_CASE("Two outputs under names of one file are refused before any work", "[files][bad-input]") {
  const ProgramTest test;
  const std::string maps =
      "damping --law paraboloid --radius 10mm --indentation 1um --contact-modulus 1GPa --poisson "
      "0.3 --mode equal-frequency --normal-amplitude 300nm --tangential-amplitude 200nm --phase "
      "90deg ";
  check_refused(test.run(maps + "--stress-map a.h5 --friction-map ./a.h5"),
                "--friction-map: ./a.h5 is the --stress-map too; name another file");
  check_refused(test.run(maps + "-o a.h5 --stress-map ./a.h5"), "is the --output too");
  std::filesystem::create_directory_symlink(".", test.folder() / "here");
  check_refused(test.run(maps + "-o a.h5 --friction-map here/a.h5"), "is the --output too");
  check_refused(test.run("oscillate --shape cone --points 16 --contact-modulus 1GPa --poisson 0.3 "
                         "--phase 45deg --fields f --checkpoint f-0008.h5 --steps 16"),
                "--fields: f-0008.h5 is the --checkpoint too");
  CHECK(test.files() == "here");
}
