// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the tables of answers/: what commands answer, print and write, against numbers of theory
// and of other commands. answers/README.md says how a table is written.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <regex>
#include <salebra/io/result_file.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "run_program.hpp"
#include "study/study_text.hpp"

using Catch::Contains;
using nlohmann::json;

namespace {

using Numbers = std::vector<double>;

std::string trimmed(const std::string& text) {
  const auto begin = std::min(text.find_first_not_of(' '), text.size());
  return text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

std::vector<std::string> parts(const std::string& text, const std::string& separator) {
  std::vector<std::string> found;
  for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + separator.size()) {
    end = text.find(separator, at);
    found.push_back(trimmed(text.substr(at, end == std::string::npos ? end : end - at)));
  }
  return found;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Answers, numbers and lists of them by name.
struct Values : std::map<std::string, json> {
  /// "a.curve.force.2", "a.work.last"; null where there is none.
  const json* find_member(const std::string& path) const {
    const auto names = parts(path, ".");
    if (!contains(names[0])) throw std::runtime_error(names[0] + " is not known here");
    const json* value = &at(names[0]);
    for (std::size_t k = 1; k < names.size(); ++k) {
      if (value->is_array())
        value = names[k] == "last" ? &value->back() : &value->at(std::stoul(names[k]));
      else if (value->is_object() && value->contains(names[k]))
        value = &value->at(names[k]);
      else
        return nullptr;
    }
    return value;
  }
  const json& member(const std::string& path) const {
    if (const json* value = find_member(path)) return *value;
    throw std::runtime_error(path + " is not there");
  }
};

const std::map<std::string, double (*)(double)> functions{
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"exp", [](double x) { return std::exp(x); }},
    {"cosh", [](double x) { return std::cosh(x); }},
    {"sinh", [](double x) { return std::sinh(x); }},
    {"abs", [](double x) { return std::abs(x); }},
    {"bessel0", [](double x) { return std::cyl_bessel_i(0., x); }}};

/// The mean of a list and its least value and largest magnitude; of two lists the sum of products, the integral of
/// the second over the first by trapezoids, and the largest difference.
const std::map<std::string, double (*)(const Numbers&, const Numbers&)> functions_of_lists{
    {"mean",
     [](const Numbers& a, const Numbers&) {
       double sum = 0;
       for (const double x : a) sum += x;
       return sum / static_cast<double>(a.size());
     }},
    {"largest",
     [](const Numbers& a, const Numbers&) {
       double most = 0;
       for (const double x : a) most = std::max(most, std::abs(x));
       return most;
     }},
    {"product",
     [](const Numbers& a, const Numbers& b) {
       double sum = 0;
       for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b.at(k);
       return sum;
     }},
    {"integral",
     [](const Numbers& a, const Numbers& b) {
       double sum = 0;
       for (std::size_t k = 1; k < a.size(); ++k)
         sum += (a[k] - a[k - 1]) * (b.at(k) + b.at(k - 1)) / 2;
       return sum;
     }},
    {"least",
     [](const Numbers& a, const Numbers&) { return *std::min_element(a.begin(), a.end()); }},
    {"apart", [](const Numbers& a, const Numbers& b) {
       double most = 0;
       for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b.at(k)));
       return most;
     }}};

/// Sums, products, powers and functions of numbers and of members of answers. Of a list it takes
/// the element `place`, and of null no number.
class Expression {
 public:
  Expression(const std::string& text, const Values& values, std::size_t place = 0)
      : text_(text), values_(values), place_(place) {}
  double value() {
    const double found = sum();
    if (at_ < text_.size()) throw std::runtime_error("what is '" + text_.substr(at_) + "'?");
    return found;
  }

 private:
  bool take(char symbol) {
    at_ = std::min(text_.find_first_not_of(' ', at_), text_.size());
    if (at_ == text_.size() || text_[at_] != symbol) return false;
    at_ = std::min(text_.find_first_not_of(' ', at_ + 1), text_.size());
    return true;
  }
  double sum() {
    double left = product();
    for (;;) {
      if (take('+'))
        left += product();
      else if (take('-'))
        left -= product();
      else
        return left;
    }
  }
  double product() {
    double left = power();
    for (;;) {
      if (take('*'))
        left *= power();
      else if (take('/'))
        left /= power();
      else
        return left;
    }
  }
  double power() {
    if (take('-')) return -power();
    const double base = factor();
    return take('^') ? std::pow(base, power()) : base;
  }
  double factor() {
    if (take('(')) return closed(sum());
    if (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9') {
      std::size_t length = 0;
      const double number = std::stod(text_.substr(at_), &length);
      at_ += length;
      return number;
    }
    const auto end = std::min(text_.find_first_of(" +-*/^(),", at_), text_.size());
    const std::string word = text_.substr(at_, end - at_);
    at_ = end;
    if (word == "pi") return std::numbers::pi;
    if (!take('(')) return number(values_.member(word));
    if (functions.contains(word)) return functions.at(word)(closed(sum()));
    const auto close = std::min(text_.find(')', at_), text_.size());
    const auto lists = parts(text_.substr(at_, close - at_), ",");
    at_ = close;
    const json& list = values_.member(lists.front());
    return closed(word == "size" ? static_cast<double>(list.size())
                                 : functions_of_lists.at(word)(list, values_.member(lists.back())));
  }
  double closed(double inner) {
    if (!take(')')) throw std::runtime_error("a bracket is open");
    return inner;
  }
  double number(const json& value) {
    const json& one = value.is_array() ? value.at(place_) : value;
    return one.is_null() ? std::nan("") : one.get<double>();
  }

  const std::string text_;
  const Values& values_;
  const std::size_t place_;
  std::size_t at_ = 0;
};

/// A table, in a folder of its own.
class Table {
 public:
  /// files: names and texts of what lies there.
  explicit Table(const std::map<std::string, std::string>& files = {}) {
    for (const auto& [name, text] : files) test_.write(name, text);
  }

  void check(const std::string& name) {
    std::ifstream lines(SALEBRA_TABLES "/answers/" + name);
    REQUIRE(lines);
    std::string heading;
    int number = 0;
    for (std::string line, next; std::getline(lines, line);) {
      for (++number; line.ends_with('\\') && std::getline(lines, next); ++number)
        line.replace(line.size() - 1, 1, trimmed(next));
      if (line.starts_with("##")) heading = line;
      if (line.empty() || line.starts_with('#')) continue;
      INFO(heading << '\n' << name << ':' << number << ": " << line);
      try {
        state(trimmed(line.substr(0, line.find("  # "))));
      } catch (const std::exception& error) {
        FAIL(error.what());
      }
    }
  }

 private:
  void state(const std::string& line) {
    const auto salebra = line.find("salebra ");
    if (line.starts_with("each ")) {
      const auto colon = line.find(": ");
      for (const std::string& one : parts(line.substr(5, colon - 5), " "))
        state(replaced(line.substr(colon + 2), "@", one));
    } else if (line.starts_with("$ ")) {
      shell_ += line.substr(2) + "; ";
    } else if (line.starts_with("! ")) {
      test_.done("--version", shell_ + line.substr(2) + "; ");
    } else if (line.starts_with("files ")) {
      CHECK(test_.files() == line.substr(6));
    } else if (salebra == 0 || line.find("= salebra ") + 2 == salebra ||
               line.find(": salebra ") + 2 == salebra) {
      run(trimmed(line.substr(0, salebra)), parts(filled(line.substr(salebra + 8)), " => "));
    } else {
      compare(line);
    }
  }

  /// Nothing, "NAME =" or "NAME :", and a command with what it is refused for.
  void run(const std::string& target, const std::vector<std::string>& command) {
    INFO(command[0]);
    if (command.size() > 1) {
      const Names before = test_.files();
      const auto result = test_.run(command[0], shell_);
      for (std::size_t k = 1; k < command.size(); ++k) check_refused(result, command[k]);
      CHECK(test_.files() == before);
    } else if (target.ends_with('=')) {
      const std::string name = trimmed(target.substr(0, target.size() - 1));
      runs_[name] = test_.done(command[0] + " --json", shell_);
      values_[name] = runs_[name].json();
    } else {
      runs_[trimmed(target.substr(0, target.find(':')))] = test_.done(command[0], shell_);
    }
  }

  void compare(const std::string& line) {
    // The first of them that the line has.
    std::string word;
    for (const std::string one : {" keys ", " has ", " lacks ", " is ", " same ", " differs ",
                                  " ≈ ", " == ", " != ", " <= ", " >= ", " < ", " > ", " = "})
      if (line.find(one) < line.find(word.empty() ? one + one : word)) word = one;
    if (word.empty()) throw std::runtime_error("this states nothing");
    const auto sides = parts(line, word);
    const std::string &left = sides[0], &right = sides[1];
    if (word == " = ") {
      values_[left] = value(right);
    } else if (word == " keys ") {
      CHECK(keys(values_.member(left)) == right);
    } else if (word == " has ") {
      for (std::size_t k = 1; k < sides.size(); ++k)
        CHECK_THAT(text(left), Contains(replaced(sides[k], "\\n", "\n")));
    } else if (word == " lacks ") {
      for (std::size_t k = 1; k < sides.size(); ++k)
        CHECK_THAT(text(left), !Contains(replaced(sides[k], "\\n", "\n")));
    } else if (word == " is ") {
      is(left, right);
    } else if (word == " same ") {
      CHECK(text(left) == text(right));
    } else if (word == " differs ") {
      CHECK(text(left) != text(right));
    } else if (word == " != ") {
      CHECK(value(left) != value(right));
    } else if (word == " == ") {
      const json found = value(left), expected = value(right);
      if (found.is_array() && !expected.is_array())
        CHECK(found == json(std::vector(found.size(), expected)));
      else
        CHECK(found == expected);
    } else {
      numbers(left, word, right);
    }
  }

  /// A comparison of numbers, of all elements where the left side is a list. What both sides do not
  /// know is passed over, and by an inequality what one of them does not.
  void numbers(const std::string& left, const std::string& word, const std::string& right) const {
    const json* list = is_name(left) ? &values_.member(left) : nullptr;
    const std::size_t count = list && list->is_array() ? list->size() : 1;
    const bool relative = right.find(" to ") != std::string::npos;
    const auto near = parts(right, relative ? " to " : " ± ");
    std::size_t compared = 0;
    for (std::size_t k = 0; k < count; ++k) {
      INFO(k);
      const double a = number(left, k), b = number(near[0], k);
      const bool unknown = word == " ≈ " ? std::isnan(a) && std::isnan(b) : std::isnan(a + b);
      if (count > 1 && unknown) continue;
      ++compared;
      if (word == " <= ")
        CHECK(a <= b);
      else if (word == " >= ")
        CHECK(a >= b);
      else if (word == " < ")
        CHECK(a < b);
      else if (word == " > ")
        CHECK(a > b);
      else if (relative)
        CHECK(a == Approx(b).epsilon(number(near.at(1))));
      else
        CHECK(a == Approx(b).margin(number(near.at(1))).epsilon(0));
    }
    CHECK(compared > 0);
  }

  bool is_name(const std::string& source) const {
    return values_.contains(parts(source, ".")[0]) && source.find_first_of(" +*/^(") == source.npos;
  }

  void is(const std::string& source, const std::string& kind) const {
    if (kind == "empty") {
      CHECK(text(source).empty());
      return;
    }
    const json* member = values_.find_member(source);
    if (member && member->is_array())
      CHECK(*member == json(std::vector(member->size(), json::parse(kind))));
    else
      CHECK((!member ? "absent" : member->is_number() ? "a number" : member->dump()) == kind);
  }

  double number(const std::string& expression, std::size_t place = 0) const {
    return Expression(expression, values_, place).value();
  }

  /// JSON, a member, a number, or numbers of a file: FILE.h5:DATASET, FILE.h5:GROUP:ATTRIBUTE.
  json value(const std::string& source) const {
    if (json::accept(source)) return json::parse(source);
    if (const auto file = parts(source, ":"); file.size() > 1) {
      const salebra::ResultReader reader(test_.folder() / file[0]);
      if (file.size() == 2) return reader.numbers(file[1]);
      return reader.number_attribute(file[1], file[2]).value();
    }
    return is_name(source) ? values_.member(source) : json(number(source));
  }

  /// What a run printed: NAME.out, NAME.err, and NAME.words with single blanks; or a file.
  std::string text(const std::string& source) const {
    const auto dot = std::min(source.find('.'), source.size());
    const auto run = runs_.find(source.substr(0, dot));
    const std::string stream = source.substr(dot);
    if (run != runs_.end() && stream == ".err") return run->second.err;
    if (run != runs_.end() && stream == ".out") return run->second.out;
    if (run != runs_.end() && stream == ".words")
      return std::regex_replace(run->second.out, std::regex("\\s+"), " ");
    CHECK(test_.files().contains(source));
    return test_.read(source);
  }

  /// {EXPRESSION} is its number.
  std::string filled(std::string text) const {
    for (auto open = text.find('{'); open != std::string::npos; open = text.find('{', open)) {
      const auto close = text.find('}', open);
      const double inner = number(text.substr(open + 1, close - open - 1));
      text.replace(open, close - open + 1, fmt::format("{}", inner));
    }
    return text;
  }

  const ProgramTest test_;
  std::string shell_ = "data='" SALEBRA_DATA "'; tables='" SALEBRA_TABLES "'; ";
  Values values_;
  std::map<std::string, ProgramTest::Result> runs_;
};

}  // namespace

TEST_CASE("contact and fit answer what their table says", "[contact]") {
  Table().check("contact.txt");
}
TEST_CASE("damping answers what its table says", "[damping]") { Table().check("damping.txt"); }
TEST_CASE("damping of an indenter answers what its table says", "[indenter]") {
  Table().check("indenter.txt");
}
TEST_CASE("Dry runs answer what their table says", "[dry-run]") {
  const std::string small = study_text("seeds = [3, 4, 5]", 5);
  Table({{"small.toml", small},
         {"many.toml", study_text("seed_count = 300", 5)},
         {"grid.toml", "[ensemble]\nhurst = [0.5, 0.8]\npoints = [64, 128]\n" +
                           replaced(small, "hurst = 0.8\n", "")}})
      .check("dry_run.txt");
}
TEST_CASE("Files of 0.1.0 are read as their table says", "[former]") {
  Table().check("former.txt");
}
TEST_CASE("generate answers what its table says", "[generate]") { Table().check("generate.txt"); }
TEST_CASE("Directions are those of their table", "[direction]") { Table().check("direction.txt"); }
TEST_CASE("joint answers what its table says", "[joint]") { Table().check("joint.txt"); }
TEST_CASE("oscillate answers what its table says", "[oscillate]") {
  Table().check("oscillate.txt");
}
TEST_CASE("A loss answers for its assumptions as their table says", "[assumptions]") {
  Table().check("assumptions.txt");
}
TEST_CASE("statistics answers what its table says", "[statistics]") {
  Table().check("statistics.txt");
}
TEST_CASE("sliding answers what its table says", "[sliding]") { Table().check("sliding.txt"); }
TEST_CASE("study and compare answer what their table says", "[study]") {
  const auto ensemble = [](std::string text) {
    return replaced(text, "hurst = 0.8\n", "") + "[ensemble]\nhurst = [0.5, 0.8]\n";
  };
  Table({{"study.toml", study_text("seeds = [3]")},
         {"three.toml", study_text()},
         {"grid.toml", ensemble(study_text("seeds = [1, 2]"))},
         {"sticky.toml", replaced(adhesive_study_text(), "[1, 2, 3]", "[1, 2]")},
         {"few.toml", close_study_text()},
         {"measured.toml", contact_text()}})
      .check("study.txt");
}
TEST_CASE("viscoelastic answers what its table says", "[viscoelastic]") {
  Table().check("viscoelastic.txt");
}
TEST_CASE("What flows in its first loading answers what its table says", "[first_loading]") {
  Table().check("first_loading.txt");
}
