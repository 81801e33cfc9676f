// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a report page: template, style, scripts and data in one HTML file.
#include <salebra/base/error.hpp>
#include <salebra/base/version.hpp>
#include <salebra/report/report.hpp>
#include <string_view>

#include "assets.hpp"
#include "io/text_file.hpp"
#include "payload.hpp"
#include "summary.hpp"

namespace salebra {
namespace {

/// JSON text for a <script> element, escaped so that nothing in it can end the element or open a
/// comment.
std::string script_text(const Json& json) {
  const std::string text = json.dump();
  std::string result;
  result.reserve(text.size());
  for (const char letter : text) {
    if (letter == '<') {
      result += "\\u003c";
    } else {
      result += letter;
    }
  }
  return result;
}

/// Replaces each {{NAME}} in the template by its text, in one pass, so that inserted text is not
/// searched for further names. locations: names and texts.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string_view>>& locations) {
  std::string result;
  while (true) {
    const std::size_t begin = page.find("{{");
    result += page.substr(0, begin);
    if (begin == std::string_view::npos) return result;
    const std::size_t end = page.find("}}", begin);
    const std::string_view name = page.substr(begin + 2, end - begin - 2);
    for (const auto& [location, content] : locations)
      if (location == name) result += content;
    page.remove_prefix(end + 2);
  }
}

}  // namespace

bool can_report() { return !detail::assets::plotly().empty(); }

void require_report(const std::filesystem::path& html, const WriteOptions& options) {
  if (!can_report())
    throw IoError(
        "report: this build of salebra does not contain plotly.js; run scripts/report-assets (it "
        "needs pip and a network) and build again");
  require_output(html, options);
}

void write_report(const std::filesystem::path& results, const std::filesystem::path& html,
                  const ReportOptions& options) {
  require_report(html, options.write);
  Json payload = detail::report_payload(ResultReader(results));
  for (const std::filesystem::path& file : options.direct)
    detail::add_direct(payload, ResultReader(file));
  const std::string name = results.filename().string();
  payload["results"] = name;
  payload["title"] = options.title;
  payload["report_version"] = version();
  const std::string title = detail::escaped(options.title.empty() ? name : options.title);
  const std::string data = script_text(payload), summary = detail::summary_of(payload);
  write_text_file(html,
                  filled(detail::assets::html(), {{"title", title},
                                                  {"style", detail::assets::css()},
                                                  {"plotly", detail::assets::plotly()},
                                                  {"summary", summary},
                                                  {"data", data},
                                                  {"script", detail::assets::javascript()}}),
                  options.write);
}

}  // namespace salebra
