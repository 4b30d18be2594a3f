#include "core/settings.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace nephroid {
namespace {

enum class Shape { round, square };
constexpr std::array<const char*, 2> kShapeNames{"round", "square"};
constexpr const auto& namesOf(Shape) {
  return kShapeNames;
}

struct Choices {
  uint32_t count = 4;
  float part = 0.5f;
  double error = 0;
  Shape shape = Shape::round;
  bool operator==(const Choices&) const = default;
};

constexpr Setting withWord(Setting setting) {
  setting.wordForZero = "sensor";
  return setting;
}

constexpr Setting kSettings[] = {
    withWord(wholeSetting<&Choices::count>("count", 1, 256, "How many")),
    realSetting<&Choices::part>("part", 0, 1, "Which part"),
    fractionSetting<&Choices::error>("error", std::numeric_limits<double>::infinity(), "How wrong"),
    choiceSetting<&Choices::shape>("shape", "Which shape"),
};

TEST(Settings, AreReadFromWhatUsersWrite) {
  Choices choices;
  EXPECT_EQ(setFromText(kSettings[0], &choices, "16"), "");
  EXPECT_EQ(setFromText(kSettings[1], &choices, "0.25"), "");
  EXPECT_EQ(setFromText(kSettings[2], &choices, "1%"), "");
  EXPECT_EQ(setFromText(kSettings[3], &choices, "square"), "");
  EXPECT_EQ(choices, (Choices{16, 0.25f, 0.01, Shape::square}));
  EXPECT_EQ(setFromText(kSettings[2], &choices, "0.02"), "");
  EXPECT_EQ(choices.error, 0.02);
}

TEST(Settings, SayWhatIsWrongAndWhatWouldBeRight) {
  Choices choices;
  const auto wrong = [&](int setting, const char* text) {
    return setFromText(kSettings[setting], &choices, text);
  };
  EXPECT_EQ(wrong(0, "257"), "'257' is not a whole number from 1 to 256");
  EXPECT_EQ(wrong(0, "sensor"), "'sensor' is not a whole number from 1 to 256");
  for (const char* text : {"", "-1", "1.5", "nan", "4x", " 4", "1e400"})
    EXPECT_NE(wrong(0, text), "") << text;
  EXPECT_EQ(wrong(1, "1.01"), "'1.01' is not a number from 0 to 1");
  for (const char* text : {"0", "-1%", "nan", "inf", "%"})
    EXPECT_EQ(wrong(2, text), "'" + std::string(text) + "' is not a fraction above 0, such as 0.01 or 1%");
  EXPECT_EQ(wrong(3, "squar"),
            "there is no 'squar' in this version; did you mean 'square'? There are: round, square");
  EXPECT_EQ(choices, Choices{});
}

TEST(Settings, TakeTheWordForZeroWhereItMeansSomething) {
  Choices choices;
  EXPECT_EQ(setFromText(kSettings[0], &choices, "sensor", true), "");
  EXPECT_EQ(choices.count, 0u);
  EXPECT_EQ(textOf(kSettings[0], &choices), "sensor");
  EXPECT_EQ(setFromText(kSettings[0], &choices, "x", true),
            "'x' is not a whole number from 1 to 256, or sensor");
}

TEST(Settings, AreWrittenAsTheyAreRead) {
  Choices choices{7, 0.125f, 0.01, Shape::square}, read;
  const auto texts = textsOf({"choices", kSettings, &choices});
  ASSERT_EQ(texts.size(), 4u);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_EQ(texts[i].first, kSettings[i].flag);
    EXPECT_EQ(setFromText(kSettings[i], &read, texts[i].second), "") << texts[i].second;
  }
  EXPECT_EQ(read, choices);
}

TEST(Settings, OfEveryTypeHaveTheirDefaultsUntilTheyAreChanged) {
  OwnSettings changed, untouched;
  const OwnSettings& asked = untouched;
  EXPECT_EQ(asked.of<Choices>(), Choices{});
  changed.of<Choices>();
  EXPECT_EQ(changed, untouched);
  changed.of<Choices>().count = 5;
  EXPECT_NE(changed, untouched);
  EXPECT_NE(untouched, changed);
  OwnSettings copy = changed;
  EXPECT_EQ(copy, changed);
  copy.of<Choices>().count = 4;
  EXPECT_NE(copy, changed);
  EXPECT_EQ(changed.of<Choices>().count, 5u);
}

}  // namespace
}  // namespace nephroid
