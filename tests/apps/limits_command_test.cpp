// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the program at the limits of memory, threads and size that a system or a user sets.
#include <algorithm>
#include <catch2/catch.hpp>
#include <salebra/io/result_file.hpp>
#include <string>

#include "run_program.hpp"
#include "study/study_text.hpp"

using Catch::Contains;

TEST_CASE("Three hundred surfaces are computed and written with 300 MB of addresses", "[limits]") {
  const ProgramTest test;
  std::string text = study_text("seed_count = 300", 4);
  text.replace(text.find("points = 64"), 11, "points = 32");
  text.replace(text.find("1e-3:0.2:4"), 10, "5e-3:0.1:4");
  text.replace(text.find("tolerance = 1e-8"), 16,
               "tolerance = 1e-4\ntangential_stiffness = \"proportional\"");
  test.write("study.toml", text);
  // The draws that the bootstrap once kept of 300 surfaces and of all fewer would take 360 MB by
  // themselves. Libraries and the stacks of two threads have some 200 MB of addresses; what is
  // resident is 30 MB. Without levels a surface is pressed less often; the samples are as many.
  const auto result =
      test.done("study study.toml -o result.h5 --no-report --quiet --threads 2 --intervals 0",
                "ulimit -v 300000;");
  const salebra::ResultReader reader(test.folder() / "result.h5");
  CHECK(reader.numbers("surface/seed").size() == 300);
  const auto counts = reader.numbers("convergence/surfaces");
  CHECK(counts.back() == 300);
  CHECK(counts.size() < 180);
  CHECK(reader.numbers("convergence/decay_length_over_rms_height_low").size() == counts.size());
}

TEST_CASE("A contact that a limit of memory does not hold is refused in one line", "[limits]") {
  const ProgramTest test;
  test.done(
      "generate --points 2048 --size-x 10um --hurst 0.8 --rolloff 1um --short-cutoff 0.1um "
      "--rms-height 10nm -o s.h5 --quiet");
  // 43 bytes for each of 2048² cells, 180 MB, of 500 in all, of which the program and its heights
  // take the most.
  for (const std::string command : {"contact s.h5 --contact-modulus 1GPa --pressure 1MPa",
                                    "contact s.h5 --contact-modulus 1GPa --pressure 1MPa:2MPa:2"})
    check_refused(test.run(command + " --threads 1 --quiet", "ulimit -d 200000;"),
                  "points: 2048 x 2048 need 180 MB of memory for a contact and ");
  // What fits is computed.
  test.done("contact s.h5 --contact-modulus 1GPa --pressure 1MPa --threads 1 --quiet",
            "ulimit -d 400000;");
  check_refused(test.run("generate --points 20000 --size-x 10um --hurst 0.8 --rolloff 1um "
                         "--short-cutoff 0.1um --rms-height 10nm -o big.h5 --quiet --threads 1",
                         "ulimit -d 1000000;"),
                "points: 20000 x 20000 need 3.");
  CHECK(test.files() == "s.h5");
}

TEST_CASE("A file whose heights a limit of memory does not hold is refused in one line",
          "[limits]") {
  const ProgramTest test;
  // One byte a point in the file, of which most are a hole on the disk, and eight in memory: 64 MB
  // and 512 MB.
  std::string header = "{'descr': '|i1', 'fortran_order': False, 'shape': (8000, 8000), }";
  header.resize(117, ' ');
  header += '\n';
  test.write("big.npy", std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header);
  std::filesystem::resize_file(test.folder() / "big.npy", 10 + header.size() + 8000 * 8000);
  check_refused(test.run("statistics big.npy --size-x 1um --threads 1", "ulimit -d 400000;"),
                "big.npy: holds 8000 x 8000 points, which need 512 MB of memory, and ");
}

TEST_CASE("A text whose values a limit of memory does not hold is refused in one line",
          "[limits]") {
  const ProgramTest test;
  // Two bytes a value in the file and eight in memory, which a growing list needs three times for a
  // moment: 32 MB and up to 400 MB.
  std::string row;
  for (int column = 0; column < 4000; ++column) row += column % 2 == 0 ? "1 " : "2 ";
  row.back() = '\n';
  std::string text;
  for (int k = 0; k < 4000; ++k) text += row;
  test.write("big.txt", text);
  check_refused(test.run("statistics big.txt --size-x 1um --threads 1", "ulimit -d 150000;"),
                "big.txt: holds more than ");
}

TEST_CASE("A study whose threads do not fit into memory is refused before its first surface",
          "[limits]") {
  const ProgramTest test;
  std::string text = study_text("seed_count = 4", 4);
  text.replace(text.find("points = 64"), 11, "points = 1024");
  test.write("study.toml", text);
  // Stick solves take 155 bytes a cell: 0.33 GB for two threads.
  check_refused(test.run("study study.toml -o result.h5 --threads 2 --quiet", "ulimit -d 300000;"),
                "of memory for the surfaces of all threads (fewer --threads need less) and ");
  CHECK(test.files() == "study.toml");
}

TEST_CASE("A study file of few kilobytes cannot fill the memory by its combinations", "[limits]") {
  const ProgramTest test;
  const auto list = [](const std::string& value) {
    std::string values = value;
    for (int i = 1; i < 2000; ++i) values += ", " + value;
    return "[" + values + "]\n";
  };
  std::string text = study_text("seeds = [1]", 4);
  for (const std::string key :
       {"hurst = 0.8\n", "rolloff = \"1um\"\n", "short_cutoff = \"0.5um\"\n"})
    text.erase(text.find(key), key.size());
  text += "[ensemble]\nhurst = " + list("0.8") + "rolloff = " + list("1e-6") +
          "short_cutoff = " + list("5e-7");
  test.write("study.toml", text);
  for (const std::string dry : {"", " --dry-run"})
    check_refused(test.run("study study.toml -o result.h5" + dry, "ulimit -v 1000000;"),
                  "ensemble: its lists make 8000000000 combinations");
  CHECK(test.files() == "study.toml");
}

TEST_CASE("More threads than the machine can use are reduced, with a warning", "[limits]") {
  const ProgramTest test;
  const auto result = test.run(
      "generate --points 32 --size-x 1um --hurst 0.8 --short-cutoff 0.2um --rms-height 1nm -o s.h5 "
      "--threads 100000");
  CHECK(result.status == 0);
  CHECK_THAT(result.err, Contains("warning: --threads 100000: too many for this machine; ") &&
                             Contains(" are used"));
}
