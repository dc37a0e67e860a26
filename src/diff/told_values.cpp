#include "diff/told_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

namespace skylapse::diff {
namespace {

constexpr std::string_view kBlank = " \t\r\n,";

/// The numbers of "0.64, 0.33"; empty if anything in it is no finite number.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const size_t begin = text.find_first_not_of(kBlank);
    if (begin == text.npos) return numbers;
    text.remove_prefix(begin);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || !std::isfinite(value)) return {};
    text.remove_prefix(size_t(end - text.data()));
    if (!text.empty() && kBlank.find(text.front()) == kBlank.npos) return {};
    numbers.push_back(value);
  }
}

struct NumbersOf {
  std::vector<double> operator()(const std::string& text) const { return numbers_of(text); }
  std::vector<double> operator()(const std::vector<float>& values) const {
    return {values.begin(), values.end()};
  }
  template <class Number>
  std::vector<double> operator()(Number value) const {
    return {double(value)};
  }
};

std::vector<double> numbers_of(const nlohmann::json& value) {
  if (value.is_number()) return {value.get<double>()};
  std::vector<double> numbers;
  if (!value.is_array()) return numbers;
  for (const auto& item : value) {
    if (!item.is_number()) return {};
    numbers.push_back(item.get<double>());
  }
  return numbers;
}

}  // namespace

const output::Attribute* ToldValues::find(const char* attribute) const {
  const auto found = std::ranges::find(attributes_, std::string_view(attribute),
                                       [](const auto& a) { return std::string_view(a.name); });
  return found == attributes_.end() ? nullptr : &*found;
}

const nlohmann::json* ToldValues::find_in_manifest(const char* pointer) const {
  if (entry_ == nullptr || *pointer == 0) return nullptr;
  const nlohmann::json::json_pointer place(pointer);
  return entry_->contains(place) ? &entry_->at(place) : nullptr;
}

std::vector<double> ToldValues::numbers(const char* attribute, const char* pointer) const {
  std::vector<double> all;
  if (const auto* a = find(attribute))
    all = std::visit(NumbersOf{}, a->value);
  else if (const auto* value = find_in_manifest(pointer))
    all = numbers_of(*value);
  const bool finite = std::ranges::all_of(all, [](double v) { return std::isfinite(v); });
  return finite ? all : std::vector<double>{};
}

std::optional<double> ToldValues::number(const char* attribute, const char* pointer) const {
  const auto all = numbers(attribute, pointer);
  return all.size() == 1 ? std::optional(all.front()) : std::nullopt;
}

std::string ToldValues::text(const char* attribute, const char* pointer) const {
  if (const auto* a = find(attribute))
    if (const auto* text = std::get_if<std::string>(&a->value)) return *text;
  const auto* value = find_in_manifest(pointer);
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

}  // namespace skylapse::diff
