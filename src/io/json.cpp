// SPDX-License-Identifier: GPL-3.0-or-later
// JSON values and their text.
#include "json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

namespace salebra {
namespace {

auto find(auto& members, std::string_view key) {
  return std::ranges::find_if(members, [&](const auto& member) { return member.first == key; });
}

template <class T>
auto& held(auto& value, const char* kind) {
  if (auto* of_kind = std::get_if<T>(&value)) return *of_kind;
  throw std::logic_error(std::string("this JSON value is not ") + kind);
}

template <class T>
auto& made(auto& value, const char* kind) {
  if (std::holds_alternative<Json::Null>(value)) value = T();
  return held<T>(value, kind);
}

template <class Value>
nlohmann::ordered_json converted(const Value& value) {
  return std::visit(
      [](const auto& part) -> nlohmann::ordered_json {
        using T = std::decay_t<decltype(part)>;
        if constexpr (std::is_same_v<T, Json::Null>) {
          return nullptr;
        } else if constexpr (std::is_same_v<T, Json::Array>) {
          auto array = nlohmann::ordered_json::array();
          for (const Json& element : part) array.push_back(converted(element.value()));
          return array;
        } else if constexpr (std::is_same_v<T, Json::Object>) {
          auto object = nlohmann::ordered_json::object();
          for (const auto& [key, member] : part) object[key] = converted(member.value());
          return object;
        } else {
          return part;
        }
      },
      value);
}

}  // namespace

Json::Json(std::initializer_list<std::pair<std::string_view, Json>> members) {
  for (const auto& [key, value] : members) (*this)[key] = value;
}

Json Json::array() {
  Json value;
  value.value_ = Array();
  return value;
}

Json Json::object() {
  Json value;
  value.value_ = Object();
  return value;
}

bool Json::truth() const { return held<bool>(value_, "a truth value"); }

double Json::number() const {
  if (const auto* whole = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*whole);
  if (const auto* whole = std::get_if<std::uint64_t>(&value_)) return static_cast<double>(*whole);
  return held<double>(value_, "a number");
}

const std::string& Json::text() const { return held<std::string>(value_, "a text"); }

std::size_t Json::size() const {
  if (const auto* array = std::get_if<Array>(&value_)) return array->size();
  if (const auto* object = std::get_if<Object>(&value_)) return object->size();
  return is_null() ? 0 : 1;
}

bool Json::contains(std::string_view key) const {
  const auto* object = std::get_if<Object>(&value_);
  return object && find(*object, key) != object->end();
}

Json& Json::operator[](std::string_view key) {
  auto& members = made<Object>(value_, "an object");
  const auto found = find(members, key);
  return found != members.end() ? found->second : members.emplace_back(key, Json()).second;
}

const Json& Json::operator[](std::string_view key) const {
  const auto& members = items();
  const auto found = find(members, key);
  if (found == members.end()) throw std::logic_error("this JSON object has no " + std::string(key));
  return found->second;
}

Json& Json::operator[](std::size_t index) { return elements().at(index); }
const Json& Json::operator[](std::size_t index) const { return elements().at(index); }

void Json::push_back(Json value) { made<Array>(value_, "an array").push_back(std::move(value)); }

void Json::add(const Json& object) {
  for (const auto& [key, value] : object.items())
    if (!contains(key)) (*this)[key] = value;
}

void Json::erase(std::string_view key) {
  std::erase_if(items(), [&](const auto& member) { return member.first == key; });
}

Json::Object& Json::items() & { return held<Object>(value_, "an object"); }
const Json::Object& Json::items() const& { return held<Object>(value_, "an object"); }
Json::Array& Json::elements() & { return held<Array>(value_, "an array"); }
const Json::Array& Json::elements() const& { return held<Array>(value_, "an array"); }

std::string Json::dump(int indent) const {
  return converted(value_).dump(indent, ' ', false,
                                nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace salebra
