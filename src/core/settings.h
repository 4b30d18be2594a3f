// Settings as their owner declares them, once. Command line, panels, help, the attributes of images and the
// stats are made from these lists.
#pragma once

#include <any>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <vector>

namespace nephroid {

// fraction: a number above 0, which a user may give in percent.
enum class SettingKind { whole, real, fraction, choice };

// One member of an owner's struct. Values pass as doubles: those of a choice as the place among its names,
// whole numbers up to 2^53.
struct Setting {
  const char* flag;  // without its dashes
  const char* help;  // one sentence, with the unit
  SettingKind kind = SettingKind::whole;
  double least = 0;  // of numbers
  double most = 0;
  std::span<const char* const> names{};  // of a choice
  double (*get)(const void* owner) = nullptr;
  void (*set)(void* owner, double value) = nullptr;
  const char* wordForZero = nullptr;  // what a user writes for 0 where a sensor is measured, if anything
  bool isBaked = false;               // what `nephroid bake` writes depends on it
};

// As the command line takes it.
std::string textOf(const Setting& setting, const void* owner);

// Whether its value is one that a user could have chosen; a reason to stop that is not given is none.
bool hasDefault(const Setting& setting, const void* owner);

// "1 to 256", "0 to 1"; the names of a choice with | between them.
std::string rangeOf(const Setting& setting);

// Sets it from what the command line takes; empty, or else what is wrong with `text`, in words. With
// `takesWord` the word for zero is taken.
std::string setFromText(const Setting& setting, void* owner, std::string_view text, bool takesWord = false);

// The settings of one owner, and where their values are.
struct SettingsView {
  const char* owner = "";  // a heading: "Transport", "light-volumes"
  std::span<const Setting> settings;
  void* values = nullptr;
};

// {flag, value} of each, as the command line takes them.
std::vector<std::pair<std::string, std::string>> textsOf(const SettingsView& view);

template <class Member>
struct MemberTraits;
template <class OwnerType, class ValueType>
struct MemberTraits<ValueType OwnerType::*> {
  using Owner = OwnerType;
  using Value = ValueType;
};

// A setting that is a member of its owner's struct, such as &BeamSettings::refineDepth. What users call the
// enumerators of a choice is namesOf(Enum), in their order.
template <auto Member>
constexpr Setting memberSetting(const char* flag, const char* help, SettingKind kind) {
  using Owner = typename MemberTraits<decltype(Member)>::Owner;
  using Value = typename MemberTraits<decltype(Member)>::Value;
  Setting setting{flag, help, kind};
  setting.get = [](const void* owner) {
    return static_cast<double>(static_cast<const Owner*>(owner)->*Member);
  };
  setting.set = [](void* owner, double value) {
    static_cast<Owner*>(owner)->*Member = static_cast<Value>(value);
  };
  return setting;
}

template <auto Member>
constexpr Setting wholeSetting(const char* flag, double least, double most, const char* help,
                               bool isBaked = false) {
  Setting setting = memberSetting<Member>(flag, help, SettingKind::whole);
  setting.least = least;
  setting.most = most;
  setting.isBaked = isBaked;
  return setting;
}

template <auto Member>
constexpr Setting realSetting(const char* flag, double least, double most, const char* help) {
  Setting setting = memberSetting<Member>(flag, help, SettingKind::real);
  setting.least = least;
  setting.most = most;
  return setting;
}

template <auto Member>
constexpr Setting fractionSetting(const char* flag, double most, const char* help) {
  Setting setting = memberSetting<Member>(flag, help, SettingKind::fraction);
  setting.most = most;
  return setting;
}

template <auto Member>
constexpr Setting choiceSetting(const char* flag, const char* help, bool isBaked = false) {
  using Value = typename MemberTraits<decltype(Member)>::Value;
  static_assert(std::is_enum_v<Value>);
  Setting setting = memberSetting<Member>(flag, help, SettingKind::choice);
  setting.names = namesOf(Value{});
  setting.isBaked = isBaked;
  return setting;
}

// What users call an enumerator.
template <class Choice>
constexpr const char* nameOf(Choice choice) {
  return namesOf(choice)[static_cast<std::size_t>(choice)];
}

// Structs of settings by their type, each with its defaults until it is changed: the own settings of
// whatever plugs in.
class OwnSettings {
 public:
  template <class Struct>
  Struct& of() {
    std::any& value = entryOf<Struct>().value;
    return *std::any_cast<Struct>(&value);
  }
  template <class Struct>
  const Struct& of() const {
    static const Struct kDefaults;
    const auto found = entries_.find(typeid(Struct));
    return found == entries_.end() ? kDefaults : *std::any_cast<Struct>(&found->second.value);
  }
  bool operator==(const OwnSettings& other) const;

 private:
  struct Entry {
    std::any value;
    bool (*isEqual)(const std::any& a, const std::any& b);
    bool (*isDefault)(const std::any& a);
  };
  template <class Struct>
  Entry& entryOf() {
    const auto [found, isNew] = entries_.try_emplace(typeid(Struct));
    if (isNew)
      found->second = {Struct{},
                       [](const std::any& a, const std::any& b) {
                         return std::any_cast<const Struct&>(a) == std::any_cast<const Struct&>(b);
                       },
                       [](const std::any& a) { return std::any_cast<const Struct&>(a) == Struct{}; }};
    return found->second;
  }

  std::map<std::type_index, Entry> entries_;
};

// A struct of settings that plugs in, and its list.
struct SettingsOwner {
  const char* owner;
  std::span<const Setting> settings;
  void* (*values)(OwnSettings& all);
};

template <class Struct>
constexpr SettingsOwner settingsOwner(const char* owner, std::span<const Setting> settings) {
  return {owner, settings, [](OwnSettings& all) -> void* { return &all.of<Struct>(); }};
}

}  // namespace nephroid
