#include "core/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"

namespace nephroid {
namespace {

// As short as it can be for a reader.
std::string shortText(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6).ptr;
  return {text, end};
}

bool isWhole(const Setting& setting) {
  return setting.kind == SettingKind::whole;
}

// False where it is no number, or there is something after it.
bool readNumber(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

std::string numberText(const Setting& setting, double value) {
  return isWhole(setting) ? std::to_string(static_cast<uint64_t>(value)) : shortText(value);
}

std::string setChoice(const Setting& setting, void* owner, std::string_view text) {
  const auto found =
      std::ranges::find(setting.names, text, [](const char* name) { return std::string_view(name); });
  if (found != setting.names.end()) {
    setting.set(owner, static_cast<double>(found - setting.names.begin()));
    return {};
  }
  const std::string nearest = nearestName(std::string(text), setting.names);
  std::string all;
  for (const char* name : setting.names) all += (all.empty() ? "" : ", ") + std::string(name);
  return "there is no '" + std::string(text) + "' in this version; " +
         (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") + "There are: " + all;
}

std::string setFraction(const Setting& setting, void* owner, std::string_view text) {
  const bool isPercent = !text.empty() && text.back() == '%';
  double value = 0;
  const bool isNumber = readNumber(isPercent ? text.substr(0, text.size() - 1) : text, value);
  if (isPercent) value /= 100;
  if (!isNumber || !(value > 0) || value > setting.most)
    return "'" + std::string(text) + "' is not a fraction above 0" +
           (std::isfinite(setting.most) ? " and up to " + shortText(setting.most) : std::string()) +
           ", such as 0.01 or 1%";
  setting.set(owner, value);
  return {};
}

}  // namespace

std::string textOf(const Setting& setting, const void* owner) {
  const double value = setting.get(owner);
  if (setting.kind == SettingKind::choice) return setting.names[static_cast<std::size_t>(value)];
  if (setting.wordForZero && value == 0) return setting.wordForZero;
  return numberText(setting, value);
}

bool hasDefault(const Setting& setting, const void* owner) {
  const double value = setting.get(owner);
  if (setting.kind == SettingKind::fraction) return value > 0;
  return setting.kind == SettingKind::choice || value >= setting.least || setting.wordForZero;
}

std::string rangeOf(const Setting& setting) {
  if (setting.kind == SettingKind::fraction) return "above 0, or in %";
  if (setting.kind != SettingKind::choice)
    return numberText(setting, setting.least) + " to " + numberText(setting, setting.most);
  std::string all;
  for (const char* name : setting.names) all += (all.empty() ? "" : "|") + std::string(name);
  return all;
}

std::string setFromText(const Setting& setting, void* owner, std::string_view text, bool takesWord) {
  if (setting.kind == SettingKind::choice) return setChoice(setting, owner, text);
  if (setting.kind == SettingKind::fraction) return setFraction(setting, owner, text);
  const bool hasWord = takesWord && setting.wordForZero;
  if (hasWord && text == setting.wordForZero) {
    setting.set(owner, 0);
    return {};
  }
  double value = 0;
  if (readNumber(text, value) && value >= setting.least && value <= setting.most &&
      (!isWhole(setting) || value == std::floor(value))) {
    setting.set(owner, value);
    return {};
  }
  return "'" + std::string(text) + "' is not a " + (isWhole(setting) ? "whole " : "") + "number from " +
         rangeOf(setting) + (hasWord ? std::string(", or ") + setting.wordForZero : std::string());
}

std::vector<std::pair<std::string, std::string>> textsOf(const SettingsView& view) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const Setting& setting : view.settings) texts.emplace_back(setting.flag, textOf(setting, view.values));
  return texts;
}

bool OwnSettings::operator==(const OwnSettings& other) const {
  for (const auto& [type, entry] : entries_) {
    const auto found = other.entries_.find(type);
    if (found == other.entries_.end() ? !entry.isDefault(entry.value)
                                      : !entry.isEqual(entry.value, found->second.value))
      return false;
  }
  return std::ranges::all_of(other.entries_, [&](const auto& of) {
    return entries_.contains(of.first) || of.second.isDefault(of.second.value);
  });
}

}  // namespace nephroid
