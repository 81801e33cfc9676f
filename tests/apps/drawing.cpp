// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

Drawing::Drawing(const ProgramTest& test, const std::string& arguments) {
  namespace fs = std::filesystem;
  const fs::path bin = test.folder() / "bin";
  fs::create_directory(bin);
  test.write("bin/gnuplot", "#!/bin/sh\ncat >script.gp\necho '</svg>'\n");
  fs::permissions(bin / "gnuplot", fs::perms::owner_all);
  result_ = test.run(arguments + " --plot drawn.svg --overwrite",
                     "PATH=\"$PWD/bin:$PATH\"; export PATH;");
  INFO(result_.err);
  REQUIRE(result_.status == 0);
  script_ = test.read("script.gp");
}

std::vector<std::vector<double>> Drawing::block(const std::string& name) const {
  INFO(name);
  const auto begin = script_.find("$" + name + " << EOD\n");
  REQUIRE(begin != std::string::npos);
  std::istringstream lines(script_.substr(begin));
  std::string line;
  std::getline(lines, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line) && line != "EOD") {
    std::istringstream words(line);
    rows.emplace_back();
    for (std::string word; words >> word;) rows.back().push_back(std::stod(word));
  }
  return rows;
}

std::vector<double> Drawing::column(int panel, int curve, std::size_t number) const {
  std::vector<double> values;
  for (const auto& row : block("curve" + std::to_string(panel) + "_" + std::to_string(curve)))
    values.push_back(row.at(number));
  return values;
}

std::vector<std::vector<double>> Drawing::image(int panel) const {
  return block("image" + std::to_string(panel));
}
