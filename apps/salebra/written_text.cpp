// SPDX-License-Identifier: GPL-3.0-or-later
// Answer that is a text for another program: to a file or to stdout.
#include "written_text.hpp"

#include "io/text_file.hpp"

namespace salebra::cli {

void answer_text(const std::string& text, Session& session) {
  if (!session.has_output()) return session.answer(Json{{"text", text}}, text);
  write_text_file(session.output(), text, session.write_options());
  session.answer(Json{{"file", session.output().string()}}, "");
}

}  // namespace salebra::cli
