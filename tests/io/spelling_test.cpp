// A misspelled word finds the one that was meant, and a different one finds none.
#include "hamilcar/io/spelling.hpp"

#include <gtest/gtest.h>

#include <array>

namespace hamilcar::io {
namespace {

constexpr std::array<std::string_view, 5> words{"mass_kg", "center_of_mass_m", "macpherson", "ab3", "road"};

TEST(NearestWord, IsWithinTwoEdits) {
    EXPECT_EQ(nearest_word("mas_kg", words), "mass_kg");
    EXPECT_EQ(nearest_word("centre_of_mass_m", words), "center_of_mass_m");
    EXPECT_EQ(nearest_word("MacPherson", words), "macpherson");
    EXPECT_EQ(nearest_word("mcphersen", words), "macpherson");
    EXPECT_EQ(nearest_word("mcfersen", words), std::nullopt);
}

TEST(NearestWord, OfAShortWordIsWithinOne) {
    EXPECT_EQ(nearest_word("AB33", words), "ab3");
    EXPECT_EQ(nearest_word("rod", words), "road");
    EXPECT_EQ(nearest_word("rk4", words), std::nullopt);
}

TEST(NearestWord, ForgivesTheUnit) {
    EXPECT_EQ(nearest_word("mass", words), "mass_kg");
    EXPECT_EQ(nearest_word("mass_N_s_per_m", words), "mass_kg");
}

TEST(QuotedList, ReadsLikeASentence) {
    EXPECT_EQ(quoted_list(std::span(words).first(1)), "'mass_kg'");
    EXPECT_EQ(quoted_list(std::span(words).last(3)), "'macpherson', 'ab3' or 'road'");
}

}  // namespace
}  // namespace hamilcar::io
