// Settings. Each owner declares its settings once, in a list. The command line, the viewer's panels, the
// help, the attributes of images and the stats are all made from these lists.
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

// whole: a whole number. real: any number. fraction: a number above 0, which users may also give in percent.
// choice: one of several names.
enum class SettingKind { whole, real, fraction, choice };

// One setting: a member of its owner's struct. Values are passed as doubles: whole numbers up to 2^53; a
// choice as its index among the names.
struct Setting {
  const char* flag;  // without its dashes
  const char* help;  // one sentence, with the unit
  SettingKind kind = SettingKind::whole;
  double least = 0;  // smallest and largest value of a number
  double most = 0;
  std::span<const char* const> names{};  // of a choice
  double (*get)(const void* owner) = nullptr;
  void (*set)(void* owner, double value) = nullptr;
  const char* wordForZero =
      nullptr;           // a word that users may write for 0 where a sensor is measured; null: none
  bool isBaked = false;  // a file of `nephroid bake` depends on it
};

// The value as it is written on the command line.
std::string textOf(const Setting& setting, const void* owner);

// Whether the present value is one that a user can choose, so that the help can show it as the default. (0
// passes, for example, means that no number of passes was given.)
bool hasDefault(const Setting& setting, const void* owner);

// The values that are accepted: "1 to 256", "0 to 1", or the names of a choice with | between them.
std::string rangeOf(const Setting& setting);

// Sets the value from the text of the command line. Returns an empty text, or an error message where `text`
// is wrong. With `takesWord` it accepts the word for zero.
std::string setFromText(const Setting& setting, void* owner, std::string_view text, bool takesWord = false);

// The settings of one owner, and the struct that holds their values.
struct SettingsView {
  const char* owner = "";  // a heading: "Transport", "light-volumes"
  std::span<const Setting> settings;
  void* values = nullptr;
};

// {flag, value} of each setting, as they are written on the command line.
std::vector<std::pair<std::string, std::string>> textsOf(const SettingsView& view);

template <class Member>
struct MemberTraits;
template <class OwnerType, class ValueType>
struct MemberTraits<ValueType OwnerType::*> {
  using Owner = OwnerType;
  using Value = ValueType;
};

// Makes a setting from a member of its owner's struct, such as &BeamSettings::refineDepth. For a choice, the
// function namesOf(Enum) gives the users' names of the enumerators, in order.
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

// The users' name of an enumerator.
template <class Choice>
constexpr const char* nameOf(Choice choice) {
  return namesOf(choice)[static_cast<std::size_t>(choice)];
}

// The settings of techniques and other plug-ins: one struct for each type. A struct that was never changed
// has its default values.
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

// The list of settings of a plug-in, and how its struct is found.
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
