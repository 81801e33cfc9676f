// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra report`: makes the report page of a result file.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/report/report.hpp>

#include "program.hpp"

namespace salebra::cli {
namespace {

struct ReportArguments {
  std::string results;
  std::string title;
  std::string pdf;
  std::vector<std::string> direct;
};

void run(const ReportArguments& arguments, Session& session) {
  const std::filesystem::path results = arguments.results;
  const ReportOptions options{.write = session.write_options(),
                              .title = arguments.title,
                              .direct = {arguments.direct.begin(), arguments.direct.end()}};
  Json answer = Json::object();
  std::string text;
  const auto written = [&](const char* name, const std::string& file) {
    answer[name] = file;
    text += fmt::format("report: {}\n", file);
  };
  // Both are checked before either is made.
  if (!arguments.pdf.empty()) require_report_pdf(arguments.pdf, options.write);
  if (arguments.pdf.empty() || session.has_output()) {
    auto page = session.output();
    if (!session.has_output()) page = std::filesystem::path(results).replace_extension(".html");
    if (!session.has_output()) session.writes("--output", page);
    write_report(results, page, options);
    written("file", page.string());
  }
  if (!arguments.pdf.empty()) {
    write_report_pdf(results, arguments.pdf, options);
    written("pdf", arguments.pdf);
  }
  session.answer(answer, text);
}

}  // namespace

void add_report_command(Program& program) {
  auto arguments = std::make_shared<ReportArguments>();
  Command& command = program.add_command(
      "report", "the results of a study as one HTML page",
      {"salebra report quickstart.h5 -o report.html",
       "salebra report scan.h5 --title 'Brake disc, 3 h in service' --overwrite"},
      [arguments](Session& session) { run(*arguments, session); }, "", OutputCheck::any_name);
  command
      .add_option(
          "RESULTS", arguments->results,
          "result file of study or compare; without --output and --pdf, the page is written next "
          "to it")
      ->required()
      ->file(FileUse::input);
  command.add_option("--title", arguments->title, "heading of the page");
  command
      .add_option("--pdf", arguments->pdf,
                  "prints the page to this file, by headless Chromium, which must be installed; "
                  "with --output also writes the page")
      ->file(FileUse::output);
  command
      .add_option("--direct", arguments->direct,
                  "result of oscillate for the same surface and motion, drawn with the damping "
                  "curves; several files one after the other")
      ->file(FileUse::input);
}

}  // namespace salebra::cli
