// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/report/report.hpp>

#include "run_program.hpp"
#include "skipped.hpp"
#include "study/study_text.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

const std::string study = study_text("seeds = [1, 2]");

}  // namespace

TEST_CASE("A study leaves a page beside its results unless it is told not to", "[report]") {
  const ProgramTest test;
  test.write("study.toml", study);
  test.done("study study.toml --no-stick --no-report -o plain.h5");
  CHECK(test.files() == "study.toml plain.h5");
  const auto result = test.done("study study.toml --no-stick -o result.h5");
  const ResultReader file(test.folder() / "result.h5");
  const std::string started = file.text_attribute("/", "started").value();
  CHECK(started.size() == 20);
  CHECK(started <= file.text_attribute("/", "created").value());
  if (!can_report()) {
    CHECK_THAT(result.err, Contains("no report was written"));
    const auto refused = test.run("report result.h5 -o page.html");
    CHECK(refused.status == 1);
    CHECK_THAT(refused.err, Contains("plotly.js") && Contains("scripts/report-assets"));
    return;
  }
  CHECK_THAT(result.out, Contains("report:  result.html"));
  CHECK(test.files().count("result.html") == 1);

  // A page that is there already is found out before the work.
  check_refused(test.run("study study.toml --no-stick -o result.html --overwrite"),
                "result.html is not a name of an HDF5 file");
  test.write("other.html", "mine");
  check_refused(test.run("study study.toml --no-stick -o other.h5"), "other.html: exists");
  CHECK(test.read("other.html") == "mine");
  CHECK(test.files().count("other.h5") == 0);
}

TEST_CASE("report makes the same page again, whole or not at all", "[report]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const ProgramTest test;
  test.write("study.toml", study);
  test.done("study study.toml --no-stick -o result.h5");
  const auto again = test.answer("report result.h5 -o again.html");
  CHECK(again["file"] == "again.html");
  CHECK(test.read("again.html") == test.read("result.html"));
  check_refused(test.run("report result.h5 -o again.html"), "again.html: exists");
  check_refused(test.run("report result.h5 -o result.h5 --overwrite"),
                "is also the file of RESULTS");

  // Past a limit on the size of files a write fails as on a full disk.
  const auto full = test.run("report result.h5 -o full.html", "ulimit -f 64;");
  CHECK(full.status == 1);
  CHECK(test.files() == "study.toml result.h5 result.html again.html");

  // A study of 0.1.0 has its page too, and one with adhesion says where it comes off.
  test.done("report " SALEBRA_TABLES "/files_of_0.1.0/study.h5 -o former.html");
  // One of 1.0.0 has the same parts as one of today, although many of its names were others.
  test.done("report " SALEBRA_TABLES "/files_of_1.0.0/study.h5 -o first.html");
  for (const char* part : {"\"verdicts\"", "\"slip_of_opening_springs\"", "\"max_spot_area\"",
                           "\"law_off_at_min_gap\"", "\"ensemble_warnings\"", "\"solution\""})
    CHECK_THAT(test.read("first.html"), Contains(part));
  test.write("sticky.toml", adhesive_study_text());
  test.done("study sticky.toml -o sticky.h5");
  CHECK_THAT(test.read("sticky.html"), Contains("Adhesion: pull-off at"));
}

TEST_CASE("report prints by the Chromium that is installed, whole or not at all", "[report]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const ProgramTest test;
  test.write("study.toml", study);
  test.done("study study.toml --no-stick --no-report -o result.h5");
  // Scripts stand for Chromium: one prints what it is given, the others fail in the two known ways.
  const auto with = [&](const std::string& script) {
    test.write("chromium", "#!/bin/sh\n" + script);
    return test.run("report result.h5 --pdf page.pdf",
                    "chmod +x chromium; PATH=$PWD:/usr/bin:/bin");
  };
  const std::string print =
      "for word; do case $word in --print-to-pdf=*) pdf=${word#*=};; file://*) page=${word#*//};; "
      "esac; done\ngrep -q 'id=\"data\"' \"$page\" && ";
  const auto cut = with(print + "echo %PDF >\"$pdf\"");
  CHECK(cut.status == 1);
  CHECK_THAT(cut.err, Contains("page.pdf: chromium did not print the page"));
  const auto failed = with("echo no display >&2; exit 3");
  CHECK(failed.status == 1);
  CHECK_THAT(failed.err, Contains("(no display); no file was written"));
  CHECK(test.files() == "study.toml result.h5 chromium");
  CHECK(with(print + "printf '%%PDF-1.4 sheets %%%%EOF' >\"$pdf\"").status == 0);
  CHECK(test.read("page.pdf") == "%PDF-1.4 sheets %%EOF");
  check_refused(with("touch called"), "page.pdf: exists");
  CHECK(test.files() == "study.toml result.h5 chromium page.pdf");
  check_refused(test.run("report result.h5 --pdf other.pdf", "PATH=/nowhere"),
                "other.pdf: needs Chromium, and PATH has no chromium");
}

TEST_CASE("report refuses what holds no study", "[report]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const ProgramTest test;
  test.write("study.toml", study);
  test.done("study study.toml --no-stick --no-report -o result.h5");
  check_refused(test.run("report missing.h5"), "missing.h5: does not exist");
  check_refused(test.run("report study.toml"), "study.toml: is not an HDF5 file");
  check_refused(test.run("report ."), ".: is not a regular file");
  check_refused(test.run("report"), "RESULTS");
  const std::string whole = test.read("result.h5");
  for (const double part : {0.02, 0.3, 0.9}) {
    test.write("cut.h5", whole.substr(0, std::size_t(part * double(whole.size()))));
    check_refused(test.run("report cut.h5"), "cut.h5: ");
  }
  test.done(
      "generate --points 16 --size-x 1um --hurst 0.8 --rolloff 1um --short-cutoff 0.25um "
      "--rms-height 1nm -o surface.h5");
  check_refused(test.run("report surface.h5"), "does not contain a study");
  CHECK(test.files() == "study.toml result.h5 cut.h5 surface.h5");
}
