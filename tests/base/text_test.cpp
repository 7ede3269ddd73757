// Text as files and people write it.
#include "hamilcar/base/text.hpp"

#include <gtest/gtest.h>

namespace hamilcar {
namespace {

TEST(NumberInText, IsDecimalWithAnExponentOrWithout) {
    EXPECT_EQ(number_in("1.5"), 1.5);
    EXPECT_EQ(number_in("-.5"), -0.5);
    EXPECT_EQ(number_in("+3."), 3.0);
    EXPECT_EQ(number_in(" 2e3\t"), 2000.0);
    EXPECT_EQ(number_in("1.5D-3"), 1.5e-3);  // Fortran
    EXPECT_EQ(number_in("1E+2"), 100.0);
    EXPECT_EQ(number_in("1e-999"), 0.0);
}

TEST(NumberInText, IsNothingElse) {
    for (const char* text : {"", " ", "-", "+", "+-1", "--1", "e5", "inf", "-inf", "nan", "0x10", "1,5", "1 2", "1e",
                             "1m", "1e999", "."}) {
        EXPECT_FALSE(number_in(text)) << "'" << text << "'";
    }
}

TEST(NumberAsText, ReadsBackToTheSameBits) {
    for (const double number : {0.1, 1.0 / 3, -1e-300, 6.02214076e23, 0.0}) {
        std::string text;
        append_number(text, number);
        EXPECT_EQ(number_in(text), number);
    }
    EXPECT_EQ(number_text(1.0 / 3), "0.333333");
}

TEST(FixedText, HasNoMinusBeforeZero) {
    EXPECT_EQ(fixed_text(-0.0004, 3), "0.000");
    EXPECT_EQ(fixed_text(-0.0006, 3), "-0.001");
    EXPECT_EQ(fixed_text(-0.0, 1), "0.0");
    EXPECT_EQ(fixed_text(12.345, 1), "12.3");
    EXPECT_EQ(fixed_text(-7, 0), "-7");
}

TEST(Quoted, IsShortAndHasNothingThatATerminalObeys) {
    EXPECT_EQ(quoted_text("abc"), "'abc'");
    EXPECT_EQ(quoted_text("\x1b]0;x\x07"), "'?]0;x?'");
    EXPECT_EQ(quoted_text(std::string(50, 'a')), "'" + std::string(40, 'a') + "...'");
}

TEST(Text, IsTrimmedAndFoldedInAscii) {
    EXPECT_EQ(trimmed(" \t a b\r"), "a b");
    EXPECT_EQ(trimmed("  "), "");
    EXPECT_EQ(trimmed(",a,", ","), "a");
    EXPECT_EQ(lower_case("Mm_\xC3\x84"), "mm_\xC3\x84");
    EXPECT_EQ(upper_case("mm2"), "MM2");
    EXPECT_TRUE(same_word("kPa", "KPA"));
    EXPECT_FALSE(same_word("kPa", "kP"));
    EXPECT_EQ(without_byte_order_mark("\xEF\xBB\xBF"
                                      "a"),
              "a");
    EXPECT_EQ(without_byte_order_mark("a"), "a");
}

}  // namespace
}  // namespace hamilcar
