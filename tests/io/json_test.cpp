// SPDX-License-Identifier: GPL-3.0-or-later
// JSON values and their text, compared with an independent reader.
#include "io/json.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

using salebra::Json;

TEST_CASE("Pairs of key and value make an object", "[json]") {
  CHECK(Json{{"area", 0.5}, {"unit", "m^2"}}.dump() == R"({"area":0.5,"unit":"m^2"})");
  CHECK(Json{{"only", {{"a", 1}}}}.dump() == R"({"only":{"a":1}})");
  CHECK(Json(std::vector<Json>{1, "two", nullptr, true}).dump() == R"([1,"two",null,true])");
  CHECK(Json{{"counts", std::vector<int>{1, 2, 3}}}.dump() == R"({"counts":[1,2,3]})");
  CHECK(Json(std::vector<double>{0.1, 1e-9}).dump() == "[0.1,1e-09]");
  CHECK(Json::array().dump() == "[]");
  CHECK(Json::object().dump() == "{}");
}

TEST_CASE("Members keep the order in which they came, and null becomes what it is used as",
          "[json]") {
  Json object;
  object["z"]["inner"] = 1;
  object["a"].push_back({{"name", "x"}});
  object["z"]["second"] = -2;
  CHECK(object.dump() == R"({"z":{"inner":1,"second":-2},"a":[{"name":"x"}]})");
  CHECK(object.contains("a"));
  CHECK_FALSE(object.contains("b"));
  CHECK(object["z"].size() == 2);
  object["z"].erase("inner");
  CHECK(object["z"].dump() == R"({"second":-2})");
  CHECK_THROWS_AS(object["z"].push_back(1), std::logic_error);
  CHECK_THROWS_AS(object["a"].text(), std::logic_error);
}

TEST_CASE("Numbers come back with all their bits, and what is not finite is null", "[json]") {
  const double third = 1.0 / 3.0, least = std::numeric_limits<double>::denorm_min();
  const std::uint64_t seed = std::numeric_limits<std::uint64_t>::max();
  const auto back = nlohmann::json::parse(
      Json{{"third", third}, {"least", least}, {"seed", seed}, {"nan", std::nan("")}}.dump(2));
  CHECK(back["third"].get<double>() == third);
  CHECK(back["least"].get<double>() == least);
  CHECK(back["seed"].get<std::uint64_t>() == seed);
  CHECK(back["nan"].is_null());
  CHECK(Json(std::nan("")).is_number_float());  // for tables, which show it as n/a
}

TEST_CASE("A file's name that is not UTF-8 gives valid JSON", "[json]") {
  const auto back = nlohmann::json::parse(Json{{"file", "scan\xff.txt"}}.dump());
  CHECK(back["file"] == "scan\xef\xbf\xbd.txt");
}
