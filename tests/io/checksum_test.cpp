// Against the values that the authors of FNV publish.
#include "hamilcar/io/checksum.hpp"

#include <gtest/gtest.h>

namespace hamilcar::io {
namespace {

std::uint64_t sum_of(std::string_view text) {
    Checksum sum;
    sum.add(text);
    return sum.value();
}

TEST(Checksum, IsThatOfFnv1a) {
    EXPECT_EQ(sum_of(""), 0xcbf29ce484222325u);
    EXPECT_EQ(sum_of("a"), 0xaf63dc4c8601ec8cu);
    EXPECT_EQ(sum_of("foobar"), 0x85944171f73967e8u);
}

TEST(Checksum, IsThatOfAllPartsTogether) {
    Checksum sum;
    sum.add("foo"), sum.add(""), sum.add("bar");
    EXPECT_EQ(sum.value(), sum_of("foobar"));
}

}  // namespace
}  // namespace hamilcar::io
