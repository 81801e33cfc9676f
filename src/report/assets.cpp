// SPDX-License-Identifier: GPL-3.0-or-later
// HTML, CSS, JavaScript and plotly.js of the report, embedded in the program.
#include "assets.hpp"

// The assembler includes the bytes of the files. This costs no compile time, and the program needs
// no other file when it runs.
#define SALEBRA_BYTES(file) ".incbin \"" file "\"\n"
#define SALEBRA_EMBED(name, bytes)                                                                \
  asm(".pushsection .rodata\n"                                                                    \
      ".global salebra_asset_" #name ", salebra_asset_" #name                                     \
      "_end\n"                                                                                    \
      ".hidden salebra_asset_" #name ", salebra_asset_" #name                                     \
      "_end\n"                                                                                    \
      "salebra_asset_" #name ":\n" bytes "salebra_asset_" #name "_end:\n.byte 0\n.popsection\n"); \
  extern "C" const char salebra_asset_##name[], salebra_asset_##name##_end[]

SALEBRA_EMBED(html, SALEBRA_BYTES(SALEBRA_REPORT_PAGE "/report.html"));
SALEBRA_EMBED(css, SALEBRA_BYTES(SALEBRA_REPORT_PAGE "/report.css"));
SALEBRA_EMBED(javascript, SALEBRA_BYTES(SALEBRA_REPORT_PAGE "/src/format.js")
                              SALEBRA_BYTES(SALEBRA_REPORT_PAGE "/src/figure.js")
                                  SALEBRA_BYTES(SALEBRA_REPORT_PAGE "/src/surface.js")
                                      SALEBRA_BYTES(SALEBRA_REPORT_PAGE "/src/explorer.js")
                                          SALEBRA_BYTES(SALEBRA_REPORT_PAGE "/src/page.js"));
#ifdef SALEBRA_REPORT_PLOTLY
SALEBRA_EMBED(plotly, SALEBRA_BYTES(SALEBRA_REPORT_PLOTLY));
#endif

namespace salebra::detail::assets {

std::string_view html() { return {salebra_asset_html, salebra_asset_html_end}; }

std::string_view css() { return {salebra_asset_css, salebra_asset_css_end}; }

std::string_view javascript() { return {salebra_asset_javascript, salebra_asset_javascript_end}; }

std::string_view plotly() {
#ifdef SALEBRA_REPORT_PLOTLY
  return {salebra_asset_plotly, salebra_asset_plotly_end};
#else
  return {};
#endif
}

}  // namespace salebra::detail::assets
