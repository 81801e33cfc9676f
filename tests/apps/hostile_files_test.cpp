// SPDX-License-Identifier: GPL-3.0-or-later
// Files of strangers, read by the program: each is read or refused in one line, within bounds, and
// nothing beside it is read.
#include "hostile_files.hpp"

#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "run_program.hpp"

namespace {

namespace fs = std::filesystem;

/// A run of the program, and what it may cost: 64 times the file and 256 MB, and 10 s of a
/// processor. Limits, not expectations: nearly all take a hundredth.
ProgramTest::Result run_bounded(const ProgramTest& test, const std::string& command,
                                std::uint64_t file_bytes) {
  const auto used = [] {
    rusage all{};
    getrusage(RUSAGE_CHILDREN, &all);
    return all;
  };
  const auto seconds = [](const rusage& all) {
    return static_cast<double>(all.ru_utime.tv_sec + all.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(all.ru_utime.tv_usec + all.ru_stime.tv_usec);
  };
  const rusage before = used();
  const auto result = test.run(command);
  const rusage after = used();
  CHECK(seconds(after) - seconds(before) <= 10);
  // The system keeps the largest of all children: where it has not grown, this one took no more.
  if (after.ru_maxrss > before.ru_maxrss)
    CHECK(static_cast<std::uint64_t>(after.ru_maxrss) * 1024 <=
          64 * file_bytes + (std::uint64_t{256} << 20));
  return result;
}

/// Status 2, one line, and no byte in it that a terminal obeys.
void check_harmless(const ProgramTest::Result& result, const std::string& part) {
  check_refused(result, part);
  CHECK(std::ranges::none_of(result.err.substr(0, result.err.size() - 1), [](char symbol) {
    return (symbol >= 0 && symbol < ' ') || symbol == '\x7f';
  }));
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder in which secret.txt and a pipe without a writer lie.
void lay_baits(const ProgramTest& test) {
  test.write("secret.txt", hostile::secret);
  REQUIRE(mkfifo((test.folder() / "pipe").c_str(), 0600) == 0);
}

/// A surface, a study of one, and the least that a study needs, as options.
const std::string material = " --contact-modulus 10GPa --poisson 0.3 ";
void make_surface(const ProgramTest& test, const std::string& name, int points = 32) {
  test.done("generate --points " + std::to_string(points) +
            " --size-x 10um --hurst 0.8 --rolloff 5um --short-cutoff 1um --rms-height 10nm -o " +
            name);
}
const std::string small_study = R"([surface]
points = 32
size_x = "10um"
hurst = 0.8
rolloff = "5um"
short_cutoff = "1um"
rms_height = "10nm"
seeds = [1]
[material]
contact_modulus = "10GPa"
poisson = 0.3
[contact]
pressures = "1MPa:10MPa:4"
[damping]
normal_amplitude = "0.1nm"
drag_velocity = "1mm/s"
frequency = "20kHz"
)";

const std::string motion =
    " --contact-modulus 10GPa --poisson 0.3 --normal-amplitude 0.1nm --drag-velocity 1mm/s "
    "--frequency 20kHz ";

}  // namespace

TEST_CASE("Hostile HDF5 files are read right or refused in one line, at a bounded cost",
          "[hostile]") {
  const ProgramTest test;
  lay_baits(test);
  for (const hostile::File& file : hostile::write_hdf5_files(test.folder())) {
    INFO(file.name);
    const std::uint64_t bytes = fs::file_size(test.folder() / file.name);
    for (const std::string& command :
         {"statistics " + file.name, "convert " + file.name + " " + file.name + ".npy"}) {
      INFO(command);
      const auto result = run_bounded(test, command, bytes);
      INFO(result.err);
      if (file.readable)
        CHECK(result.status == 0);
      else
        check_harmless(result, file.expected);
      CHECK_FALSE(holds(result.out + result.err, "s3cret"));
    }
    if (file.readable)
      CHECK_FALSE(holds(test.read(file.name + ".npy"), "s3cret"));
    else
      CHECK_FALSE(fs::exists(test.folder() / (file.name + ".npy")));
  }
}

TEST_CASE("Every command that reads HDF5 refuses storage outside the file", "[hostile]") {
  const ProgramTest test;
  lay_baits(test);
  hostile::write_hdf5_files(test.folder());
  test.done(
      "generate --points 16 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 0.2um "
      "--rms-height 1nm -o s.h5");
  // Each command meets its dataset where it looks for it; what it says of the rest of the file is
  // its own matter.
  const std::string press = "contact s.h5 --pressure 1MPa --contact-modulus 10GPa ";
  for (const std::string& command :
       {std::string("fit elsewhere.h5"), press + "--initial elsewhere.h5",
        "damping --curve elsewhere.h5 --pressure 1MPa" + motion,
        "oscillate s.h5 --pressure 1MPa --checkpoint elsewhere.h5 --resume" + motion}) {
    INFO(command);
    for (const char* file : {"external-storage.h5", "external-link.h5", "virtual.h5", "pipe",
                             "/dev/zero", "/dev/full", "."}) {
      INFO(file);
      std::string actual = command;
      actual.replace(actual.find("elsewhere.h5"), 12, file);
      const auto result = run_bounded(test, actual, 0);
      INFO(result.err);
      check_harmless(result, "");
      CHECK_FALSE(holds(result.err, "s3cret"));
    }
  }
}

TEST_CASE("Pipes, devices and folders are refused by every reader at once", "[hostile]") {
  const ProgramTest test;
  lay_baits(test);
  REQUIRE(mkfifo((test.folder() / "a.npy.json").c_str(), 0600) == 0);
  test.done(
      "generate --points 16 --size-x 1um --hurst 0.8 --rolloff 0.5um --short-cutoff 0.2um "
      "--rms-height 1nm -o s.npy");
  fs::copy_file(test.folder() / "s.npy", test.folder() / "a.npy");
  check_harmless(test.run("statistics a.npy"), "a.npy.json: is not a regular file");
  for (const std::string file : {"pipe", "/dev/zero", "/dev/tty", "."}) {
    for (const std::string& command :
         {"statistics " + file, "convert " + file + " b.npy", "statistics " + file, "fit " + file,
          "study " + file + " -o r.h5", "study --surface " + file + " -o r.h5",
          "damping --curve " + file + " --pressure 1MPa" + motion, "report " + file + " -o r.html",
          "damping --law table --table " + file +
              " --indentation 1nm --contact-modulus 1GPa --poisson 0.3"}) {
      INFO(command);
      const auto result = run_bounded(test, command, 0);
      INFO(result.err);
      // Such a build reads no file for a report.
      if (holds(result.err, "this build of salebra does not contain plotly.js")) continue;
      // A folder stands for its files, of which one is a surface.
      if (file == "." && command.starts_with("statistics")) {
        CHECK(result.status == 1);
        continue;
      }
      check_harmless(result, "");
    }
  }
  CHECK(test.files() == "a.npy a.npy.json pipe s.npy s.npy.json secret.txt");
}

TEST_CASE(
    "Headers that promise more than their file, deep nesting and tiny numbers end in an answer",
    "[hostile]") {
  const ProgramTest test;
  const auto tried = [&](const std::string& name, const std::string& content,
                         const std::string& command) {
    INFO(name);
    test.write(name, content);
    const auto result = run_bounded(test, command, content.size());
    INFO(result.err);
    if (result.status != 0) check_harmless(result, "");
    CHECK(result.status >= 0);
  };
  const auto surface = [&](const std::string& name, const std::string& content) {
    tried(name, content, "statistics " + name);
    tried(name, content, "convert " + name + " x.npy --overwrite");
    tried(name, content, "statistics --size-x 1um --size-y 1um " + name);
  };
  const auto npy = [](const std::string& description) {
    std::string header = description + std::string(118 - description.size() - 1, ' ') + "\n";
    return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + std::string(64, '\0');
  };
  surface("huge.npy",
          npy("{'descr': '<f8', 'fortran_order': False, 'shape': (4000000000, 4000000000), }"));
  surface("long.npy", std::string("\x93NUMPY\x02\x00\xff\xff\xff\xff", 12));
  surface("huge.gsf", "Gwyddion Simple Field 1.0\nXRes = 2000000000\nYRes = 2000000000\n");
  surface("huge.gwy",
          std::string("GWYPGwyContainer\0\xff\xff\xff\xff", 21) + std::string(64, '\xff'));
  surface("huge.sur", "DIGITAL SURF" + std::string(500, '\xff'));
  surface("zip.x3p", "PK\x03\x04" + std::string(64, '\xff'));
  surface("tiny.txt",
          "# Width: 1e-320 m\n# Height: 1e-320 m\n1 2 3 1\n2 3 4 5\n1 2 1 2\n4 1 2 2\n");
  surface("row.txt", std::string(1 << 20, ' ') + "1\n2\n");
  surface("points.xyz", "0 0 1e308\n1e-320 0 1\n0 1e308 1\n1e-320 1e308 5e-324\n");
  surface("escape.txt", "# Width: 1 \x1b[2J\n1 2 \x1b[31m\n");

  const std::string deep = "{\"size_x\":" + std::string(500000, '[');
  test.write("deep.npy.json", deep);
  tried("deep.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 4), }"),
        "statistics deep.npy");
  test.write("tiny.npy.json", R"({"size_x": 1e-320, "size_y": 1e-320, "units": "m"})");
  tried("tiny.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 4), }"),
        "statistics tiny.npy");

  std::string key = "a";
  for (int i = 0; i < 60000; ++i) key += ".a";
  std::string nested;
  for (int i = 0; i < 200; ++i) {
    nested += "x = [{" + key.substr(0, 61) + " = [\n";
    nested += "{";
  }
  tried("deep.toml", key + " = 1\n", "study deep.toml --dry-run");
  tried("table.toml", "[" + key + "]\nx = 1\n", "study table.toml --dry-run");
  tried("spaced.toml", "[\"=\" . " + key + "]\nx = 1\n", "study spaced.toml --dry-run");
  tried("arrays.toml", "x = " + std::string(200000, '[') + "\n", "study arrays.toml --dry-run");
  tried("nested.toml", nested, "study nested.toml --dry-run");
  tried("escape.toml", "[surface]\n\"\\u001b[2J\" = 1\n", "study escape.toml --dry-run");
  tried("curve.csv", "pressure [\x1b[2JPa], mean_gap [nm]\n1, 2\n", "fit curve.csv");
  tried("cut.csv", "pressure [MPa], mean_gap [nm]\n1e-320, 5e-324\n1e308, 1e308\n", "fit cut.csv");
}

TEST_CASE("Names of files neither break the line nor command the terminal", "[hostile]") {
  const ProgramTest test;
  for (const std::string name : {"a\nb", "|touch pwned;", "a\"b'c", "-dash", "\x1b]0;title\x07",
                                 "\x9b"
                                 "2J",
                                 "a\tb"}) {
    INFO(name);
    test.write(name, "neither text nor numbers");
    std::string quoted = "'";
    for (const char symbol : name)
      quoted += symbol == '\'' ? std::string("'\\''") : std::string(1, symbol);
    quoted += "'";
    for (const std::string& command :
         {"statistics ./" + quoted, "fit ./" + quoted, "study ./" + quoted + " --dry-run",
          "statistics " + quoted}) {
      INFO(command);
      const auto result = test.run(command);
      INFO(result.err);
      check_harmless(result, "");
      CHECK_FALSE(holds(result.err, "\x9b"));
    }
  }
  CHECK_FALSE(fs::exists(test.folder() / "pwned"));
}

TEST_CASE("Names inside a file are printed with their control characters escaped", "[hostile]") {
  const ProgramTest test;
  test.write("points.txt", "1 2\n3 4\n");
  const auto converted = test.done("convert points.txt s.h5 --size-x 1um --size-y 1um");
  fs::rename(test.folder() / "s.h5", test.folder() / "\x1b[2J.h5");
  const auto result = test.run("convert ./'\x1b[2J.h5' ./'\x1b[1A.npy'");
  CHECK(result.status == 0);
  CHECK_FALSE(holds(result.out + result.err, "\x1b"));
}

TEST_CASE("A study's verdict enters a deck as a known word alone", "[hostile]") {
  const ProgramTest test;
  test.write("study.toml", small_study);
  test.done("study study.toml --no-report -o study.h5");
  for (const std::string& verdict : {"valid\n*INCLUDE,INPUT=secret.inp\n**", "*/ int x; /*", ""}) {
    INFO(verdict);
    hostile::set_text(test.folder() / "study.h5", "solution", "validity", verdict);
    for (const std::string format : {"csv", "calculix", "ansys", "code-aster", "abaqus", "json"})
      check_harmless(test.run("export study.h5 --to " + format + " -o deck"),
                     "is not a verdict of a study");
    CHECK_FALSE(fs::exists(test.folder() / "deck"));
  }
  hostile::set_text(test.folder() / "study.h5", "solution", "validity", "not valid");
  test.done("export study.h5 --to calculix -o deck.inp");
  CHECK(holds(test.read("deck.inp"), "not valid"));
}

TEST_CASE("A curve of a file whose name breaks lines is read again", "[hostile]") {
  const ProgramTest test;
  make_surface(test, "./'a\nb.h5'");
  test.done("contact ./'a\nb.h5' --pressure 1MPa,2MPa,4MPa,8MPa" + material + "-o curve.csv");
  CHECK(holds(test.read("curve.csv"), "a\\x0ab.h5"));
  test.done("export curve.csv --to csv -o deck.csv");
}

TEST_CASE("Crafted twins are refused in one line, at a bounded cost", "[hostile]") {
  const ProgramTest test;
  test.write("study.toml", small_study);
  make_surface(test, "s.h5", 64);
  test.write("scans.toml",
             "[[measurement]]\nfile = \"s.h5\"\ninstrument = \"ideal\"\ndetrend = \"none\"\n");
  test.done("twin scans.toml --form corner -o twin.h5");
  using Edit = std::function<void(const fs::path&)>;
  const auto numbers = [](const std::string& name, const std::vector<double>& values,
                          std::size_t rows = 0) {
    return [=](const fs::path& file) {
      hostile::set_numbers(file, "twin/draws/" + name, values, rows);
    };
  };
  const auto table = [&](const std::vector<double>& knots) {
    return [=](const fs::path& file) {
      hostile::set_text(file, "twin", "form", "table");
      numbers("knot", knots)(file);
      numbers("log_psd", std::vector<double>(1000 * knots.size(), -60.), 1000)(file);
    };
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> many(700);
  for (std::size_t k = 0; k < many.size(); ++k) many[k] = 1e5 * std::pow(1.01, k);
  const std::vector<std::pair<std::string, Edit>> edits{
      {"twin/draws/knot", numbers("knot", {})},
      {"twin/draws/knot", table({1e6})},
      {"that do not rise", table({1e6, 1e6, 1e6})},
      {"that do not rise", table({1e8, 1e7, 1e6})},
      {"nan in twin/draws/knot", table({1e6, nan, 1e8})},
      {"-1000000 in twin/draws/knot", table({-1e6, 1e6, 1e8})},
      {"from 2 to 64", table(many)},
      {"in twin/draws/hurst", numbers("hurst", std::vector<double>(1000, 1e9))},
      {"in twin/draws/rolloff", numbers("rolloff", std::vector<double>(1000, 1e-300))},
      {"in twin/draws/short_cutoff", numbers("short_cutoff", std::vector<double>(1000, 1e300))},
      {"in twin/draws/log_psd", numbers("log_psd", std::vector<double>(1000, 700), 1000)},
      {"999 values of hurst",
       [&](const fs::path& file) { numbers("hurst", std::vector<double>(999, 0.8))(file); }},
      {"at most 20000", numbers("log_psd", std::vector<double>(100000, -60), 100000)}};
  for (const auto& [part, edit] : edits) {
    INFO(part);
    fs::copy_file(test.folder() / "twin.h5", test.folder() / "crafted.h5",
                  fs::copy_options::overwrite_existing);
    edit(test.folder() / "crafted.h5");
    const auto result = run_bounded(test, "study study.toml --twin crafted.h5",
                                    fs::file_size(test.folder() / "crafted.h5"));
    INFO(result.err);
    if (part == "999 values of hurst")
      check_harmless(result, "hurst belong to 1000 draws");
    else
      check_harmless(result, part);
  }
  // A file that the study names and the option replaces need not be there.
  for (const std::string named : {"twin", "psd_table"}) {
    std::string study = small_study;
    const std::size_t spectrum = study.find("hurst");
    study.replace(spectrum, study.find("seeds") - spectrum, named + " = \"missing.file\"\n");
    test.write("named.toml", study);
    check_harmless(test.run("study named.toml --dry-run"), "missing.file");
    test.done("study named.toml --twin twin.h5 --dry-run");
  }
  // A table that is sound is taken, though its curvatures cost the third power of its knots.
  std::vector<double> most(64);
  for (std::size_t k = 0; k < most.size(); ++k) most[k] = 1e5 * std::pow(1.12, k);
  table(most)(test.folder() / "twin.h5");
  CHECK(run_bounded(test, "study study.toml --twin twin.h5 --dry-run",
                    fs::file_size(test.folder() / "twin.h5"))
            .status == 0);
}

TEST_CASE("A curve with an empty column is refused by every command", "[hostile]") {
  const ProgramTest test;
  make_surface(test, "s.h5");
  test.done("contact s.h5 --pressure 1MPa,2MPa,4MPa,8MPa" + material + "-o curve.h5");
  for (const std::string column : {"pressure", "converged"}) {
    hostile::set_numbers(test.folder() / "curve.h5", "curve/" + column, {});
    for (const std::string& command :
         {std::string("fit curve.h5"), std::string("export curve.h5 --to csv"),
          "damping --curve curve.h5 --pressure 1MPa" + motion}) {
      INFO(command);
      check_harmless(test.run(command), "has no values in curve/" + column);
    }
    hostile::set_numbers(test.folder() / "curve.h5", "curve/" + column, {1e6, 2e6, 4e6, 8e6});
  }
}

TEST_CASE("Heights and sizes beyond all measure end in an answer", "[hostile]") {
  const ProgramTest test;
  std::string text;
  for (int i = 0; i < 64; ++i) {
    for (int k = 0; k < 64; ++k) text += std::to_string((i * 37 + k * 91 + i * k * 13) % 101) + " ";
    text += "\n";
  }
  test.write("s.txt", text);
  for (const std::string unit : {"1e300", "1e-300"}) {
    INFO(unit);
    std::string scaled;
    for (const char symbol : text)
      scaled += symbol == ' ' ? unit.substr(1) + " " : std::string(1, symbol);
    test.write("far.txt", "# Width: 1 um\n# Height: 1 um\n# Value units: m\n" + scaled);
    test.write("scans.toml", "[[measurement]]\nfile = \"far.txt\"\ninstrument = \"ideal\"\n");
    check_harmless(run_bounded(test, "twin scans.toml", scaled.size()), "");
  }
  for (const std::string sizes : {"--size-x 1e20 --size-y 1", "--size-x 1 --size-y 1e20"})
    run_bounded(test, "statistics --all --height-unit m s.txt " + sizes, text.size());
  // What stands in a title is looked at once: the square of 300000 took 43 s.
  test.write("blanks.csv", "pressure [Pa]" + std::string(300000, ' ') + "mean_gap [m]\n1 2\n");
  run_bounded(test, "fit blanks.csv", 300000);
}
