# SPDX-License-Identifier: GPL-3.0-or-later
# Doxygen's input filter for the public headers. Their comments are written to be read in the header: a formula is set in, and "throws",
# "cost", the name of an argument or of a choice stands two blanks before what is said of it. Markdown would run all of it together.
/^ *\/\/\/( |$)/ {
  margin = $0; sub(/\/\/\/.*/, "", margin)
  text = $0; sub(/^ *\/\/\/ ?/, "", text)
  said = text; sub(/^ +/, "", said)
  inset = length(text) - length(said)
  term = said ~ /^[a-zA-Z][a-zA-Z0-9_]*([ ,]+[a-zA-Z][a-zA-Z0-9_]*)?  +[^ ]/ && inset < 4
  if (term) {
    name = said; sub(/  +.*/, "", name)
    sub(/^[^ ]+( [^ ]+)?  +/, "", said)
    print margin "///"
    text = "- **" name "**: " said
    state = "term"
  } else if (inset >= 2 && state == "term") {
    text = "  " said
  } else if (inset >= 2) {
    if (state != "formula") print margin "///"
    state = "formula"
    text = "     " said
  } else {
    if (state == "formula" || (state == "term" && said ~ /^[A-Z]/)) { print margin "///"; state = "" }
    if (state == "term") text = "  " said
  }
  print margin "/// " text
  next
}
{ state = ""; print }
